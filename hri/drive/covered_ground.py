"""How far a robot can back off over ground that it has just driven over itself.

Few bases see behind themselves. Where they came from a moment ago there is floor, and most often
nothing else. Pure arithmetic; meters, radians, seconds.
"""

from __future__ import annotations

import math
from collections import deque

from hri.core.geometry import wrapped
from hri.core.signals import Pose2D

REMEMBERED_S = 30.0
"""People and things move: ground that was free longer ago may not be free anymore."""
ASIDE = 0.02
"""Meters that a place may lie beside the way back."""
ASKEW = math.radians(8)
"""How far the robot may have been turned there from how it stands now."""
STEP = 0.01
"""Meters from one remembered place to the next."""
JUMP = 0.2
"""Meters between two looks that it cannot have driven: it was carried."""


class CoveredGround:
    """The places where the robot was, the newest last."""

    def __init__(self) -> None:
        self._places: deque[tuple[float, Pose2D]] = deque()
        self._pose: Pose2D | None = None

    def see(self, now: float, pose: Pose2D) -> None:
        """Where the robot is; to be called often on the way, at least four times a second."""
        if self._pose is not None and _apart(self._pose, pose) > JUMP:
            self._places.clear()
        self._pose = pose
        while self._places and now - self._places[0][0] > REMEMBERED_S:
            self._places.popleft()
        if not self._places or _apart(self._places[-1][1], pose) >= STEP:
            self._places.append((now, pose))

    def forget(self) -> None:
        """It was lifted, or may have been: nothing is known of the ground."""
        self._places.clear()

    def behind(self) -> float:
        """Meters straight back over such ground, 0 or more."""
        here = self._pose
        if here is None:
            return 0.0
        ahead, left = math.cos(here.heading), math.sin(here.heading)
        farthest = 0.0
        for _, place in reversed(self._places):
            back = -(place.x - here.x) * ahead - (place.y - here.y) * left
            aside = (place.y - here.y) * ahead - (place.x - here.x) * left
            if abs(aside) > ASIDE or abs(wrapped(place.heading - here.heading)) > ASKEW:
                break
            farthest = max(farthest, back)
        return farthest


def _apart(one: Pose2D, other: Pose2D) -> float:
    return math.hypot(one.x - other.x, one.y - other.y)
