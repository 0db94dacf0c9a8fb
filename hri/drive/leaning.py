"""Somebody leans on the robot: its bumper does not know on which side, so it looks for them.

It turns until a beam sees them close by, then until a free way that leads away from them is behind
it. Pure arithmetic; directions in the odometry frame, radians, meters, seconds.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping

import numpy as np

from hri.core.geometry import wrapped
from hri.core.signals import Pose2D, RangeReading, Twist
from hri.drive.gate import REST
from hri.drive.histogram import DIRECTIONS, WIDTH, Array

LEANS = 0.12
"""Meters of a beam that ends at somebody who leans on the robot, at most."""
AWAY = -0.2
"""Cosine of the angle to whoever leans on it that a way must have at most to lead away."""
STANDS_S, STANDING = 0.15, 0.005
"""A robot that has moved by fewer meters in so many seconds stands."""


class Leaning:
    """What presses the bumper of one robot."""

    def __init__(self, mounts: Mapping[str, Pose2D]) -> None:
        self.is_pressed = False
        self._mounts = mounts
        self._toward: float | None = None
        """The direction in which whoever leans on it was seen."""
        self._poses: deque[tuple[float, Pose2D]] = deque()

    def see(self, now: float, pose: Pose2D, readings: Mapping[str, RangeReading]) -> None:
        """Where the robot is, and what its range sensors say."""
        self._poses.append((now, pose))
        while now - self._poses[0][0] > STANDS_S:
            self._poses.popleft()
        for id, mount in self._mounts.items():
            reading = readings.get(id)
            if self.is_pressed and reading is not None and 0 <= reading.distance < LEANS:
                self._toward = pose.heading + math.atan2(mount.y, mount.x)

    def feel(self, is_pressed: bool) -> bool:
        """Take in whether something presses the bumper; whether that begins now."""
        begins, self.is_pressed = is_pressed and not self.is_pressed, is_pressed
        self._toward = self._toward if is_pressed else None
        return begins

    def stood(self, pose: Pose2D) -> bool:
        """Whether the robot has not got on for a moment."""
        return all(math.dist((pose.x, pose.y), (p.x, p.y)) < STANDING for _, p in self._poses)

    def turn(self, heading: float, ways: Array, least: float, rate: float) -> Twist | None:
        """How to turn before backing off, rad/s; None when a way that leads away is behind.

        `ways` as in `free_ways`; one of `least` meters is free. Rest where none leads away.
        """
        if self._toward is None:
            return Twist(0.0, rate)
        free = DIRECTIONS[(np.cos(DIRECTIONS - self._toward) < AWAY) & (ways > least)]
        if not len(free):
            return REST
        off = min((wrapped(float(way) + math.pi - heading) for way in free), key=abs)
        return None if abs(off) < WIDTH else Twist(0.0, math.copysign(rate, off))
