"""Touches between a robot and people, by cause: who moved, from which side, and the sensors' view.

A `Witness` gets, at each tick, the positions of the robot and all people, and who is covered by
which sensor. It records one `Collision` for each touch, and its cause, as far as known. Meters,
seconds.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from hri.core.geometry import seen_from
from hri.core.signals import Pose2D
from hri.simulation.people.person import RADIUS as PERSON

CONTACT = 0.01
"""Meters between two bodies that touch."""
PARTED = 3 * CONTACT
"""Meters between two bodies that touch no more."""
MOVING = 0.01
"""Meters a second; slower stands."""
COVERED_S = 0.5
"""Seconds before a touch in which a sensor that covered the person counts."""
HIT_TOLERANCE = 0.03
"""Meters between the end of a beam and the surface of the person it ends at: its noise."""
SIDES = ("ahead", "left", "behind", "right")
"""Quarters around the robot, 90 degrees each, that are counted to the left."""

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Collision:
    """One touch between the robot and a person."""

    time: float
    robot_speed: float
    """The greatest of the tick in which they touched, m/s, without its sign."""
    robot_approach: float
    """The part of its velocity that led toward the person, m/s; below 0 away from them."""
    person_speed: float
    """Meters a second."""
    bearing: float
    """Radians to the left of straight ahead at which the person was."""
    covered_by: tuple[str, ...]
    """Sensors that covered the person in the last COVERED_S, by name."""
    warning: float
    """Seconds from the first of these sights to the touch; 0 without any."""

    @property
    def is_moving(self) -> bool:
        """Whether the robot moved."""
        return self.robot_speed > MOVING

    @property
    def side(self) -> str:
        """On which side of the robot it was; one of SIDES."""
        return SIDES[round(self.bearing / (math.pi / 2)) % 4]

    @property
    def cause(self) -> str:
        """Which of the two moved, whether a sensor covered the person, and on which side."""
        if not self.is_moving:
            return f"a person walked into the standing robot, {self.side}"
        seen = "covered by a sensor" if self.covered_by else "covered by no sensor"
        who = "a person who walked" if self.person_speed > MOVING else "a person who stood"
        goes = "toward" if self.robot_approach > MOVING else "along or away from"
        return f"the robot moved {goes} {who}, {seen}, {self.side}"


class Witness:
    """Watches one robot and the people around it."""

    def __init__(self, radius: float) -> None:
        """`radius`: of the robot's round body."""
        self.collisions: list[Collision] = []
        self._radius = radius
        self._touching: set[int] = set()
        self._sights: dict[int, list[tuple[float, str]]] = {}
        self._before: tuple[float, Sequence[Point]] | None = None

    def see(self, now: float, sensor: str, people: Sequence[int]) -> None:
        """A sensor covers these people, by their numbers."""
        for number in people:
            self._sights.setdefault(number, []).append((now, sensor))

    def watch(self, now: float, pose: Pose2D, speed: float, people: Sequence[Point]) -> None:
        """Where the robot and everyone are now; `speed` is the robot's, m/s, below 0 backward."""
        for number, place in enumerate(people):
            sights = self._sights.get(number, [])
            sights[:] = [sight for sight in sights if now - sight[0] <= COVERED_S + 1e-6]
            gap = math.dist((pose.x, pose.y), place) - self._radius - PERSON
            if gap >= PARTED:
                self._touching.discard(number)
            elif gap < CONTACT and number not in self._touching:
                self._touching.add(number)
                walked = self._speed(now, number, place)
                self.collisions.append(_collision(now, pose, speed, place, walked, sights))
        self._before = now, tuple(people)

    def _speed(self, now: float, number: int, place: Point) -> float:
        if self._before is None or now <= self._before[0]:
            return 0.0
        return math.dist(place, self._before[1][number]) / (now - self._before[0])


def hit_by(ends: Mapping[str, Point], people: Sequence[Point]) -> dict[str, list[int]]:
    """The people, by number, on whom the beams of sensors end, by the names of the sensors."""
    return {
        sensor: [n for n, place in enumerate(people) if _ends_at(end, place)]
        for sensor, end in ends.items()
    }


def _ends_at(end: Point, place: Point) -> bool:
    return abs(math.dist(end, place) - PERSON) <= HIT_TOLERANCE


def _collision(
    now: float,
    pose: Pose2D,
    speed: float,
    place: Point,
    walked: float,
    sights: Sequence[tuple[float, str]],
) -> Collision:
    ahead, left = seen_from(pose, *place)
    sensors = tuple(sorted({sensor for _, sensor in sights}))
    warning = now - min((time for time, _ in sights), default=now)
    approach = speed * ahead / math.hypot(ahead, left)
    bearing = math.atan2(left, ahead)
    return Collision(now, abs(speed), approach, walked, bearing, sensors, warning)
