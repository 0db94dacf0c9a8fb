"""Notices that someone pushes or kicks a robot that stands. Pure arithmetic; meters, seconds."""

from __future__ import annotations

import math

from hri.core.signals import Pose2D

STOOD_S = 1.0
"""It must have stood for so long: the last centimeters of a motion are its own."""
LEAST = 0.25
"""m/s below which it was moved aside by hand, or the floor slopes."""
OVER = 0.02
"""m/s below which a push is over."""


class PushDetector:
    """Watches where the wheels say the robot is."""

    def __init__(self) -> None:
        self._driven_at = -math.inf
        self._last: tuple[float, Pose2D] | None = None
        self._is_pushed = False

    def see(self, now: float, pose: Pose2D, is_driven: bool) -> float:
        """How fast someone pushes the robot, m/s, when that begins; else 0.

        `is_driven` is whether the base is told to move.
        """
        last, self._last = self._last, (now, pose)
        if is_driven:
            self._driven_at = now
        if last is None or now <= last[0] or now - self._driven_at < STOOD_S:
            return 0.0
        speed = math.hypot(pose.x - last[1].x, pose.y - last[1].y) / (now - last[0])
        begins = speed >= LEAST and not self._is_pushed
        self._is_pushed = speed >= LEAST or (self._is_pushed and speed >= OVER)
        return speed if begins else 0.0
