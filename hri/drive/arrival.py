"""Notices that a goal is reached, as near as there is room: pure arithmetic."""

from __future__ import annotations

import math

from hri.core.geometry import wrapped
from hri.core.signals import Pose2D, Twist
from hri.drive.avoidance import FACING, turn_to
from hri.drive.progress import Patience
from hri.hal.motion import REST

SETTLING_S = 3.0
"""Seconds without gain, near the goal, after which it counts as reached."""
GAINED, GAINED_ANGLE = 0.002, 0.005
"""Meters and radians that count as a gain."""
PUSHED = 0.05
"""Meters from where it arrived; a robot that is so far away was moved."""
EXACTLY = 0.01
"""Radians off a heading that count as facing it exactly."""


class Arrival:
    """The end of the way to one goal: there, and then turning to its heading."""

    def __init__(self, goal: Pose2D, close: float) -> None:
        """`close`: meters that count as there where it gets no nearer; 0 for none."""
        self._goal, self._close = goal, close
        self._patience = Patience(SETTLING_S, GAINED)
        self._turning = Patience(SETTLING_S, GAINED_ANGLE)
        self._spot: Pose2D | None = None

    def is_at(self, now: float, pose: Pose2D, *, is_reached: bool, is_open: bool) -> bool:
        """Whether it is there, and no one has moved it away since.

        `is_reached`: as near as it is meant to come; `is_open`: nothing stands on the way.
        """
        distance = _apart(pose, self._goal)
        is_over = self._patience.is_over(now, distance)
        if self._spot is not None and _apart(pose, self._spot) > PUSHED:
            self._spot = None
        if is_reached or (distance <= self._close and (is_over or not is_open)):
            self._spot = self._spot or pose
        return self._spot is not None

    def turn(self, now: float, pose: Pose2D, rate: float) -> Twist:
        """The turn on the spot to the heading of the goal, `rate` rad/s at most; then rest."""
        off = abs(wrapped(self._goal.heading - pose.heading))
        if self._turning.is_over(now, off) and off <= FACING:
            return REST
        return turn_to(pose, self._goal.heading, rate, EXACTLY)


def _apart(one: Pose2D, other: Pose2D) -> float:
    return math.hypot(one.x - other.x, one.y - other.y)
