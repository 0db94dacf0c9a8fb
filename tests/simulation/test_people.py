"""Several people in one world: what the camera shows of them, and what a visit makes them do."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Image
from hri.hal.camera import Camera
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource_manager import ResourceManager
from hri.simulation.people.person import SimulatedPerson
from hri.simulation.visit_script import load_visit
from hri.simulation.world import SimulatedWorld
from hri.simulation.world_file import load_layout

from .conftest import Build

Write = Callable[[str], Path]

TWO = """
[robot]
start = [0, 0]
[[person]]
name = "anna"
at = [1.3, 0.0]
[[person]]
name = "ben"
actor = "bruno"
at = [1.3, -0.3]
"""
WIDE = {"field_of_view": "1.05", "noise": "0"}


@pytest.fixture
def pair(build: Build, write: Write) -> ResourceManager:
    return build({"file": str(write(TWO))}, camera=WIDE, range={"noise": "0", "max_range": "9"})


def picture(manager: ResourceManager, time: float) -> Image:
    frame = manager.obtain("camera", Camera).read(time)
    assert frame is not None
    return frame.image


def middle_of_change(one: Image, other: Image) -> float:
    """The middle column of where two pictures differ above the shoulders."""
    changed = np.abs(one[80:140].astype(int) - other[80:140]).max(axis=2) > 40
    return float(np.median(np.nonzero(changed)[1]))


def test_both_are_in_the_picture_each_at_their_place(pair: ResourceManager) -> None:
    world = pair.obtain("world", SimulatedWorld)
    anna, ben = world.people
    assert (anna.name, ben.name, ben.actor) == ("anna", "ben", "bruno")
    both = picture(pair, 0.0)
    ben.starts_present = False
    alone = picture(pair, 0.1)
    focal = 160 / math.tan(1.05 / 2)
    middle = middle_of_change(both, alone)
    assert middle == pytest.approx(160 + focal * 0.3 / 1.3, abs=6)


def test_the_world_company_shows_all_of_its_people(build: Build) -> None:
    manager = build({"file": "company"}, camera={"width": "640", "height": "480"})
    world = manager.obtain("world", SimulatedWorld)
    all_of_them = picture(manager, 0.0)
    for person in world.people:
        person.starts_present = False
    empty = picture(manager, 0.1)
    changed = np.abs(all_of_them.astype(int) - empty).max(axis=2) > 25
    heads = changed[215:245].mean(axis=0) > 0.4
    wide_gaps = np.diff(np.flatnonzero(heads)) > 40
    assert 1 + wide_gaps.sum() == len(world.people) == 3


def test_the_camera_follows_the_place_of_the_first(pair: ResourceManager) -> None:
    world, camera = pair.obtain("world", SimulatedWorld), pair.obtain("camera", Camera)
    assert camera.pan(0.0) == pytest.approx(0.0)
    world.person.go(1.0, 1.0, at=1.0)
    assert camera.pan(9.0) == pytest.approx(math.pi / 4)


def test_who_comes_nearer_grows_and_is_nearer_for_range_sensors(pair: ResourceManager) -> None:
    world, sensor = pair.obtain("world", SimulatedWorld), pair.obtain("range", RangeSensor)
    far = sensor.read(0.0).distance
    world.stand_at(world.person, 0.8, now=0.0)
    assert sensor.read(5.0).distance == pytest.approx(far - 0.5, abs=0.02)
    assert world.distance_to(world.person, 5.0) == pytest.approx(0.8)
    halfway = world.distance_to(world.person, 0.35)
    assert 0.8 < halfway < 1.3


def test_a_visit_names_who_does_what(pair: ResourceManager, write: Write) -> None:
    world, clock = pair.obtain("world", SimulatedWorld), pair.clock
    assert isinstance(clock, FakeClock)
    events, told = EventBus(clock), []
    events.subscribe("visitor.acted", lambda event: told.append(dict(event.properties)))
    visit = load_visit(
        write(
            """
            [[step]]
            at = 1
            who = "ben"
            enter = true
            [[step]]
            approach = 0.7
            [[step]]
            at = 4
            who = "ben"
            look_down = true
            [[step]]
            at = 8
            move_away = 2.0
            """
        )
    )
    visit.start(world, clock, events)
    clock.advance(20.0)
    anna, ben = world.people
    assert [told_of.get("who") for told_of in told] == ["ben", None, "ben", None]
    assert [ben.is_present(time) for time in (0.5, 3.0)] == [False, True]
    assert anna.is_present(0.5)
    assert world.distance_to(anna, 7.0) == pytest.approx(0.7)
    assert world.distance_to(anna, 19.0) == pytest.approx(2.0)
    assert math.degrees(ben.head(5.0).pitch) > 12
    assert abs(math.degrees(anna.head(5.0).pitch)) < 4


def test_a_visit_that_names_a_stranger_is_refused(pair: ResourceManager, write: Write) -> None:
    world, clock = pair.obtain("world", SimulatedWorld), pair.clock
    visit = load_visit(write('[[step]]\nwho = "bne"\nnod = true\n'))
    with pytest.raises(HriError, match='nobody in this world is named "bne" - did you mean "ben"'):
        visit.start(world, clock, EventBus(clock))


@pytest.mark.parametrize(
    "deed", ["look_down", "look_around", "talk", "walk", "laugh", "tilt", "lean", "nod", "shake"]
)
def test_every_deed_moves_the_picture_and_ends(build: Build, deed: str) -> None:
    manager = build(None, camera={"noise": "0", "rate": "10"})
    world = manager.obtain("world", SimulatedWorld)
    world.person.move(deed, at=0.55)
    still = SimulatedPerson(seed=world.seed_for("person"))
    moved = [i for i in range(80) if world.person.posture(i / 10) != still.posture(i / 10)]
    assert moved
    assert 6 <= moved[0] < 12
    assert moved[-1] < 70


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        (TWO.replace('name = "ben"\n', ""), 7, "this person has no name"),
        (TWO.replace('"ben"', '"anna"'), 8, 'another person is named "anna"'),
        (TWO.replace('"bruno"', '"brunno"'), 9, 'did you mean "bruno"'),
        ("[robot]\nstart = [0, 0]\n[[person]]\nname = 'a'\nat = [0.1, 0]\n", 5, "inside the robot"),
    ],
)
def test_a_wrong_file_is_refused_at_its_line(write: Write, text: str, line: int, said: str) -> None:
    with pytest.raises(AuthoringError) as caught:
        load_layout(write(text))
    assert said in str(caught.value)
    assert caught.value.place.line == line
