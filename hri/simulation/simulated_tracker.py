"""A simulated camera and person tracker, without pictures."""

from __future__ import annotations

import math
import random
from collections import deque

from hri.core.geometry import seen_from
from hri.core.signals import HeadPose, People, Person
from hri.hal.camera import FIELD_OF_VIEW
from hri.simulation.world import SimulatedWorld

FARTHEST = 4.0
"""Meters at which a face is still found."""
PICTURE_S = 0.1
"""Seconds between two pictures."""
DELAY = 1
"""Pictures after which one has been looked through."""
DISTANCE_ERROR = 0.05
"""Standard deviation of a distance, as a part of it: it is guessed from the size of a face."""


class Lookout:
    """Looks straight ahead from the middle of the base; furniture hides people as walls do."""

    def __init__(self, world: SimulatedWorld, seed: int) -> None:
        self._world, self._dice = world, random.Random(f"lookout {seed}")
        self._pictures: deque[People] = deque()
        self._next = 0.0
        self._last: frozenset[int] = frozenset()
        self.in_sight: frozenset[int] = frozenset()
        """Numbers of those in the two newest pictures that have been looked through."""
        self.covered: frozenset[int] = frozenset()
        """Numbers of those in the picture that was taken last, looked through or not."""

    def look(self, now: float) -> People | None:
        """What the tracker says now; None when it says nothing new."""
        if now < self._next - 1e-6:
            return None
        self._next = now + PICTURE_S
        taken = self._taken(now)
        self.covered = _numbers(taken)
        self._pictures.append(taken)
        if len(self._pictures) <= DELAY:
            return None
        people = self._pictures.popleft()
        newest = _numbers(people)
        self.in_sight, self._last = newest & self._last, newest
        return people

    def _taken(self, now: float) -> People:
        found = []
        for number, person in enumerate(self._world.people):
            ahead, left = seen_from(self._world.base.pose, *person.place(now))
            distance, bearing = math.hypot(ahead, left), math.atan2(left, ahead)
            error = 1 + DISTANCE_ERROR * self._dice.gauss(0.0, 1.0)
            if self._is_in_view(distance, bearing):
                head = HeadPose(now, 0.0, 0.0)
                found.append(Person(f"p{number}", head, distance=distance * error, bearing=bearing))
        return People(now, tuple(found))

    def _is_in_view(self, distance: float, bearing: float) -> bool:
        if distance > FARTHEST or abs(bearing) > FIELD_OF_VIEW[0] / 2:
            return False
        pose = self._world.base.pose
        free = self._world.room.cast(pose.x, pose.y, pose.heading + bearing)
        return float(free) >= distance


def _numbers(people: People) -> frozenset[int]:
    return frozenset(int(person.id[1:]) for person in people.persons)
