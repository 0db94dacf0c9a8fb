"""A critically damped spring in closed form: what jumps is turned into what glides.

The value shown is `goal + offset`. When the goal jumps, the offset takes up the jump, and then
dies away without overshoot: x(t) = (x0 + (v0 + w x0) t) exp(-w t). A goal that moves smoothly,
such as the track of the lips, is followed without any lag.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]


class Spring:
    """Follows goals of any shape; stateful, but exact for any time step."""

    def __init__(self, stiffness: float | Values) -> None:
        """`stiffness` in radians a second: 90 % of the way takes 3.9 / stiffness seconds."""
        self.stiffness = np.asarray(stiffness, float)
        self._offset: Values = np.zeros(self.stiffness.shape)
        self._speed: Values = np.zeros(self.stiffness.shape)

    def jump(self, before: float | Values, after: float | Values) -> None:
        """The goal has just gone from one value to another."""
        self._offset = self._offset + np.asarray(before, float) - after

    def follow(self, goal: float | Values, dt: float) -> Values:
        """The value to show `dt` seconds after the last call, for the goal of now."""
        w = self.stiffness
        pull = self._speed + w * self._offset
        fade = np.exp(-w * dt)
        self._offset = (self._offset + pull * dt) * fade
        self._speed = (self._speed - w * pull * dt) * fade
        return np.asarray(goal, float) + self._offset
