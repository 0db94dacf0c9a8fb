"""Which objects of the room a camera sees."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from hri.core.geometry import seen_from
from hri.core.signals import Pose2D
from hri.simulation.room import Room
from hri.simulation.world_file import Item


@dataclass(frozen=True, slots=True)
class Sighting:
    """An object in the picture."""

    item: Item
    distance: float
    """Meters from the camera."""
    bearing: float
    """Radians from where the camera looks to the left."""

    @property
    def name(self) -> str:
        """Of the object."""
        return self.item.name


def seen(items: Iterable[Item], room: Room, camera: Pose2D, field_of_view: float) -> list[Sighting]:
    """The objects within the field of view (radians) that nothing hides, the nearest first."""
    found = []
    for item in items:
        ahead, left = seen_from(camera, item.x, item.y)
        distance, bearing = math.hypot(ahead, left), math.atan2(left, ahead)
        if abs(bearing) <= field_of_view / 2:
            free = room.cast(camera.x, camera.y, camera.heading + bearing)
            if float(free) >= distance:
                found.append(Sighting(item, distance, bearing))
    return sorted(found, key=lambda sighting: sighting.distance)
