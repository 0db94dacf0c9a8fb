import math

import numpy as np
import pytest

from hri.core.errors import AuthoringError, HriError
from hri.core.signals import Pose2D, Twist
from hri.hal.resource import Description
from hri.simulation.acoustics import RATE
from hri.simulation.world import BUMP_TIME, MOST_ITEMS, OBSTACLE, SimulatedWorld

from .conftest import Build


def loudness(world: SimulatedWorld, start: float, end: float) -> float:
    heard = world.sound.between(round(start * RATE), round(end * RATE))
    return float(np.sqrt(np.mean(heard.astype(float) ** 2)))


def test_a_voice_is_heard_when_it_speaks(world: SimulatedWorld) -> None:
    spoken = world.say("hello robot", 1.0)
    assert spoken is not None
    assert loudness(world, 0.0, 0.99) < 40
    assert loudness(world, 1.0, spoken.end) > 1000
    assert loudness(world, spoken.end + 0.01, 3.0) < 40


def test_a_voice_is_quieter_from_far_away(world: SimulatedWorld) -> None:
    world.say("hello", 1.0)
    near = loudness(world, 1.0, 1.3)
    for tick in range(20 * 50):
        world.command(Twist(0.5), 2.0 + tick / 50)
    world.say("hello", 23.0)
    assert loudness(world, 23.0, 23.3) < near / 4


def test_somebody_who_pushes_presses_the_bumper_for_a_moment(world: SimulatedWorld) -> None:
    world.bump(1.0)
    assert [world.is_bumped(t) for t in (0.9, 1.0, 1.0 + BUMP_TIME - 0.01, 1.0 + BUMP_TIME)] == [
        False,
        True,
        True,
        False,
    ]


def test_time_and_motion_empty_the_battery(build: Build) -> None:
    world = build({"battery": "0.5"}).obtain("world", SimulatedWorld)
    assert world.battery_level(0.0) == 0.5
    rested = 0.5 - world.battery_level(10.0)
    for tick in range(10 * 50):
        world.command(Twist(0.5), 10.0 + tick / 50)
    assert 0 < 2 * rested < 0.5 - world.battery_level(20.0)
    world.set_battery(0.1, 20.0)
    assert world.battery_level(20.0) == 0.1
    assert world.battery_level(1e6) == 0.0
    for level in (-0.1, 24.3, math.nan):
        with pytest.raises(HriError, match="from 0 to 1"):
            world.set_battery(level, 20.0)


def test_the_person_stops_the_base_only_while_there(build: Build) -> None:
    def end(is_there: bool) -> float:
        world = build().obtain("world", SimulatedWorld)
        world.person.starts_present = is_there
        for tick in range(8 * 50):
            world.command(Twist(0.3, 0.12 if tick < 300 else 0.0), tick / 50)
        return world.base.way

    assert end(True) < end(False) - 0.3


@pytest.mark.parametrize(
    ("parameters", "said"),
    [
        ({"file": "hom"}, 'did you mean "home"'),
        ({"battery": "2"}, "from 0 to 1"),
        ({"batery": "1"}, 'did you mean "battery"'),
        ({"seed": "many"}, "write a number"),
    ],
)
def test_wrong_parameters_are_refused_before_anything_starts(
    parameters: dict[str, str], said: str
) -> None:
    with pytest.raises(AuthoringError, match=said):
        SimulatedWorld.check(Description("world", "Hri.SimulatedWorld", parameters))


def test_an_obstacle_is_in_the_way_until_it_is_taken_away(world: SimulatedWorld) -> None:
    ahead = world.beams.mount(Pose2D(0.0, 0.0, 0.0))
    free = world.beam_length(ahead, 0.0)
    world.put_obstacle("box", 0.8, 0.0, 0.0)
    assert world.beam_length(ahead, 0.0) == pytest.approx(0.8 - OBSTACLE)
    world.put_obstacle("box", 0.8, 1.5, 0.0)
    assert world.beam_length(ahead, 0.0) == pytest.approx(free)
    world.put_obstacle("box", 0.6, 0.0, 0.0)
    world.take_away("box")
    assert world.beam_length(ahead, 0.0) == pytest.approx(free)
    with pytest.raises(HriError, match='nothing here is called "box"'):
        world.take_away("box")


def test_an_obstacle_is_not_put_onto_the_robot_nor_without_end(world: SimulatedWorld) -> None:
    with pytest.raises(HriError, match="the robot stands there"):
        world.put_obstacle("box", 0.1, 0.0, 0.0)
    for number in range(MOST_ITEMS):
        world.put_obstacle(f"box {number}", 50.0, 0.0, 0.0)
    for number in range(MOST_ITEMS - len(world.items)):
        world.place(f"cup {number}", 50.0, 0.0)
    for put in (lambda: world.put_obstacle("box", 50.0, 0.0, 0.0), lambda: world.place("c", 0, 0)):
        with pytest.raises(HriError, match="take one away first"):
            put()
    world.place("cup 3", 1.0, 0.0)
