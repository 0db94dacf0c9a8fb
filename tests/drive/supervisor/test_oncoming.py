import math

import pytest
from hypothesis import given, strategies as st

from hri.core.geometry import along_arc, placed
from hri.core.signals import Pose2D
from hri.drive.supervisor.oncoming import NEAR_PEOPLE, Oncoming
from hri.hal.motion import Way
from hri.simulation.room import Box, Circle, Obstacle, Room, Wall

BODY = 0.2
PERSON = 0.22
REACH = 0.8
TICK = 0.05
BRAKES = 1.0
MOUNTS = {
    "front": Pose2D(0.18, 0.0, 0.0),
    "left": Pose2D(0.13, 0.13, math.pi / 4),
    "right": Pose2D(0.13, -0.13, -math.pi / 4),
}


class Watched:
    """A robot that slows down for who comes, and somebody who looks at nothing."""

    def __init__(self, things: list[Obstacle], person: tuple[float, float] = (99.0, 99.0)) -> None:
        self.things, self.person = things, person
        self.oncoming = Oncoming(MOUNTS, BODY)
        self.pose, self.rolled, self.now, self.speed = Pose2D(), Way(), 0.0, 0.0

    def tick(self, wanted: float, turn: float = 0.0, walk: tuple[float, float] = (0, 0)) -> None:
        self.now += TICK
        self.person = self.person[0] + walk[0] * TICK, self.person[1] + walk[1] * TICK
        self.oncoming.see(self.now, self.rolled, self.ranges())
        allowed = min(wanted, self.oncoming.speed(self.now, BRAKES))
        self.speed = max(allowed, self.speed - BRAKES * TICK)
        self.pose = along_arc(self.pose, self.speed * TICK, turn * TICK)
        self.rolled = Way(self.rolled.linear + self.speed * TICK, self.rolled.angular + turn * TICK)

    def ranges(self) -> dict[str, float]:
        room = Room([*self.things, Circle(*self.person, PERSON)])
        found = {}
        for name, mount in MOUNTS.items():
            x, y = placed(self.pose, mount.x, mount.y)
            length = float(room.cast(x, y, self.pose.heading + mount.heading))
            found[name] = length if length <= REACH else math.inf
        return found

    @property
    def gap(self) -> float:
        return math.dist((self.pose.x, self.pose.y), self.person) - BODY - PERSON


@pytest.mark.parametrize("bearing", [0.0, math.pi / 4, -math.pi / 4])
@pytest.mark.parametrize("cruise", [0.1, 0.2, 0.3])
@pytest.mark.parametrize("walk", [0.8, 0.9, 1.0])
def test_it_stands_when_somebody_who_walked_in_along_a_beam_touches_it(
    bearing: float, cruise: float, walk: float
) -> None:
    way = 2.0
    watched = Watched([], (way * math.cos(bearing), way * math.sin(bearing)))
    for _ in range(200):
        x, y = watched.pose.x - watched.person[0], watched.pose.y - watched.person[1]
        apart = math.hypot(x, y)
        watched.tick(cruise, walk=(walk * x / apart, walk * y / apart))
        if watched.gap <= 0.0:
            break
    assert watched.gap <= 0.0
    assert watched.speed == 0.0


@pytest.mark.parametrize("turn", [0.0, 0.3, -0.3])
@pytest.mark.parametrize(
    "thing",
    [Wall(-5.0, 0.4, 9.0, 0.4), Wall(-5.0, 0.6, 9.0, -0.6), Box(1.5, 0.9, 0.5, 0.8, 0.4)],
)
def test_what_stands_still_is_nobody(thing: Obstacle, turn: float) -> None:
    watched = Watched([thing])
    for tick in range(60):
        watched.tick(0.25, turn * math.sin(tick * TICK * 2.5))
        if Room([thing]).clearance(watched.pose.x, watched.pose.y) < BODY + 0.05:
            break
        assert watched.oncoming.pace(watched.now) == math.inf


def test_after_somebody_came_near_it_goes_slowly_for_a_while() -> None:
    watched = Watched([], (1.5, 0.0))
    for _ in range(20):
        watched.tick(0.0, walk=(-0.8, 0.0))
    assert watched.oncoming.speed(watched.now, BRAKES) < 0.3
    assert watched.oncoming.pace(watched.now) == NEAR_PEOPLE
    for _ in range(120):
        watched.tick(0.0)
    assert watched.oncoming.speed(watched.now, BRAKES) == math.inf
    assert watched.oncoming.pace(watched.now) == math.inf


@given(st.lists(st.floats(allow_nan=True, allow_infinity=True), min_size=1, max_size=30))
def test_whatever_sensors_say_it_is_a_speed(lengths: list[float]) -> None:
    oncoming = Oncoming(MOUNTS, BODY)
    for tick, length in enumerate(lengths):
        oncoming.see(tick * TICK, Way(tick * 0.01, 0.0), {"front": length, "else": length})
        assert oncoming.speed(tick * TICK, BRAKES) >= 0.0
