"""Critically damped springs in closed form: they turn jumps into glides.

x(t) = (x0 + (v0 + w x0) t) exp(-w t) is the fastest motion to rest that does not swing. There are
two ways to use it. A `Follower` goes after goals that jump, such as expressions. A `Spring` stays
on a goal that moves by itself, such as the lips' track, and glides only where the goal leaps.
Both are exact for any time step, and neither the value nor its speed ever jumps.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]

ARRIVAL = 3.9
"""90 % of the way takes ARRIVAL / stiffness seconds."""
_SHIFT = 0.04
"""Seconds in which a new stiffness takes over: at once, the speed would jump."""


class Follower:
    """Goes after its goal, and never beyond what goals have been so far.

    A critically damped spring is two low-pass filters in a row, y after the goal and x after y.
    Each step is a weighted mean of the current state and the goal, at any stiffness, even one that
    changes on the way.
    """

    def __init__(self, start: float | Values, shares: float | Values = 1.0) -> None:
        """`shares` is how stiff each value is, of the stiffness of all."""
        self.value: Values = np.asarray(start, float)
        self._leader = self.value
        self._shares = np.asarray(shares, float)
        self._stiffness: float | None = None

    def follow(self, goal: float | Values, dt: float, stiffness: float) -> Values:
        """The value `dt` seconds later; `stiffness` in radians a second."""
        way = self._shares * self._travel(dt, stiffness)
        fade = np.exp(-way)
        behind, ahead = self.value - goal, self._leader - goal
        self.value = goal + (behind + ahead * way) * fade
        self._leader = goal + ahead * fade
        return self.value

    def _travel(self, dt: float, stiffness: float) -> float:
        """The integral of the stiffness over the step."""
        if self._stiffness is None:
            self._stiffness = stiffness
        excess = self._stiffness - stiffness
        fade = float(np.exp(-dt / _SHIFT))
        self._stiffness = stiffness + excess * fade
        return stiffness * dt + excess * _SHIFT * (1 - fade)


class Spring:
    """Stays on a goal that moves smoothly; after a leap it glides there from where it was."""

    def __init__(self, size: int, stiffness: float) -> None:
        """`stiffness` in radians a second."""
        self._w = stiffness
        self._offset: Values = np.zeros(size)
        self._offset_speed: Values = np.zeros(size)
        self._goal: Values = np.zeros(size)
        self._goal_speed: Values = np.zeros(size)

    def follow(self, goal: Values, dt: float, *, leaps: bool = False) -> Values:
        """The value `dt` seconds after the last call.

        `leaps`: this goal has nothing to do with the last one; it should begin at rest.
        """
        if leaps:
            self._offset = self._offset + self._goal - goal
            self._offset_speed = self._offset_speed + self._goal_speed
        if leaps or dt <= 0:
            self._goal_speed = np.zeros_like(self._goal)
        else:
            self._goal_speed = (goal - self._goal) / dt
        self._goal = goal
        pull = self._offset_speed + self._w * self._offset
        fade = float(np.exp(-self._w * dt))
        self._offset = (self._offset + pull * dt) * fade
        self._offset_speed = (self._offset_speed - self._w * pull * dt) * fade
        value: Values = goal + self._offset
        return value
