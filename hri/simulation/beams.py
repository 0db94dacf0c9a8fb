"""The beams of all range sensors, cast together: one call costs hardly more than one beam."""

from __future__ import annotations

import math

import numpy as np

from hri.core.signals import Pose2D
from hri.simulation.room import Array, Room


class Beams:
    """Beams that are fixed to the base, by the order in which they were mounted."""

    def __init__(self) -> None:
        self._mounts = np.zeros((3, 0))
        self._key: tuple[Room, Pose2D] | None = None
        self._lengths: Array = np.zeros(0)

    def mount(self, pose: Pose2D) -> int:
        """Fix one more beam to the base, at a pose seen from there; its number."""
        self._mounts = np.column_stack((self._mounts, (pose.x, pose.y, pose.heading)))
        self._key = None
        return self._mounts.shape[1] - 1

    def length(self, number: int, room: Room, base: Pose2D) -> float:
        """How far a beam gets; infinity for never. Asked again for the same, nothing is cast."""
        if self._key != (room, base):
            self._lengths = self._cast(room, base)
            self._key = (room, base)
        return float(self._lengths[number])

    def _cast(self, room: Room, base: Pose2D) -> Array:
        cos, sin = math.cos(base.heading), math.sin(base.heading)
        x, y, heading = self._mounts
        return room.cast(
            base.x + cos * x - sin * y, base.y + sin * x + cos * y, base.heading + heading
        )
