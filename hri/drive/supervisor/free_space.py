"""How much room the base has by what its range sensors see: pure geometry.

Each reading is a point in the robot's frame; what counts lies in the corridor that the body sweeps
straight ahead, or straight back.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from hri.core.signals import Pose2D

SIDE_ROOM = 0.03
"""Meters left free beside the body."""


@dataclass(frozen=True, slots=True)
class Body:
    """What the base sweeps, meters from the middle of its axle; the defaults are a Create 2's."""

    front: float = 0.17
    back: float = 0.17
    half_width: float = 0.17
    clearance: float = 0.1
    """Kept free ahead and behind."""

    @property
    def reach(self) -> float:
        """Meters from the middle to what it sweeps at most in any direction, as of a round body."""
        return max(self.front, self.back, self.half_width)


@dataclass(frozen=True, slots=True)
class Room:
    """Meters free before the body; infinite where no sensor sees anything."""

    ahead: float = math.inf
    behind: float = math.inf


def room(
    ranges: Mapping[str, float],
    mounts: Mapping[str, Pose2D],
    body: Body,
    faulty: Collection[str] = (),
) -> Room:
    """What is free by readings in meters, of sensors mounted in the robot's frame.

    A sensor that is faulty, or that has no reading, might look at anything: nothing is free where
    it looks. Readings of sensors that are not mounted say nothing.
    """
    ahead = behind = math.inf
    for name, mount in mounts.items():
        distance = ranges.get(name, math.nan)
        looks_ahead = math.cos(mount.heading) > 0
        if name in faulty or math.isnan(distance) or distance < 0:
            ahead, behind = (0.0, behind) if looks_ahead else (ahead, 0.0)
        elif math.isfinite(distance):
            x = mount.x + distance * math.cos(mount.heading)
            y = mount.y + distance * math.sin(mount.heading)
            if abs(y) > body.half_width + SIDE_ROOM:
                continue
            if looks_ahead:
                ahead = min(ahead, max(0.0, x - body.front))
            else:
                behind = min(behind, max(0.0, -x - body.back))
    return Room(ahead, behind)
