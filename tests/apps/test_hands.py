"""What the companion does when a hand shows something."""

import math
from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from apps.companion.hands import BESIDE, pointed_at
from hri.core.models import folder_of
from hri.core.signals import FoundObject, Hand
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.vision.face_models import FACE, HAND, PALM
from tests.apps.test_companion import SMALL_SCREEN, Visit

FACE_MODELS = folder_of(FACE.name)


def showing(*shown: tuple[float, str, dict[str, object]]) -> Callable[[Robot], None]:
    """Lets hands show things at their times."""

    def prepare(robot: Robot) -> None:
        for time, name, properties in shown:
            told = {"person": "p1", "hand": "left", "latency": 0.5, **properties}
            robot.clock.call_at(time, partial(robot.events.raise_event, name, **told))

    return prepare


def test_it_greets_back_who_waves_but_not_at_each_wave_and_no_hand_drives_it() -> None:
    visit = Visit(
        9,
        {},
        prepare=showing(
            (1.5, "hand.waved", {}),
            (4.5, "hand.waved", {}),
            (5.0, "hand.thumb", {"direction": "up"}),
            (5.5, "person.pointed", {"bearing": 0.5, "elevation": 0.0}),
            (6.0, "hand.counted", {"fingers": 2}),
        ),
    )
    assert len(visit.said()) == 1
    assert visit.said()[0][:2] in ("Hi", "He")
    first, last = visit.pose_at(1.0), visit.poses[-1][1]
    assert math.hypot(last.x - first.x, last.y - first.y) < 0.02


@pytest.mark.skipif(
    not all((FACE_MODELS / part.name).is_file() for part in (PALM, HAND)),
    reason="the networks of hands are not here: hri models fetch face",
)
def test_it_sees_a_hand_that_waves_and_greets_back() -> None:
    def wave(robot: Robot) -> None:
        robot.resources.obtain("world", SimulatedWorld).person.show("wave", 7.0)

    visit = Visit(11, {}, prepare=wave, devices=(SMALL_SCREEN,))
    (seen,) = visit.named("hand.waved")
    assert 7.0 < seen.time < 9.5
    said = [one.properties["text"] for one in visit.named("speech.said") if one.time > seen.time]
    assert said[0][:2] in ("Hi", "He")


def test_an_open_hand_stops_it_while_it_drives() -> None:
    visit = Visit(9, {1: "go forward"}, prepare=showing((5.0, "hand.opened", {})))
    moved, last = visit.pose_at(4.9), visit.poses[-1][1]
    assert moved.x - visit.poses[0][1].x > 0.05
    assert math.hypot(last.x - moved.x, last.y - moved.y) < 0.15


def thing(name: str, x: float, y: float) -> FoundObject:
    return FoundObject(name, x, y, (), 0.9)


def pointing(degrees: float) -> Hand:
    points = np.zeros((21, 3), np.float32)
    angle = math.radians(degrees)
    points[8, :2] = 40 * math.cos(angle), 40 * math.sin(angle)
    return Hand("left", 0.0, points, "pointing")


def test_of_several_things_that_on_the_line_is_pointed_at() -> None:
    things = (thing("cup", 300, 10), thing("book", 10, 300), thing("ball", -300, 0))
    assert pointed_at(pointing(0), things) is things[0]
    assert pointed_at(pointing(90), things) is things[1]
    assert pointed_at(pointing(180), things) is things[2]
    assert pointed_at(pointing(math.degrees(BESIDE) + 20), things) is None
    assert pointed_at(pointing(0), ()) is None
