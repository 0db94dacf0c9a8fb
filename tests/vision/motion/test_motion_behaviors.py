"""Motion in networks: who walks is noticed, by a robot that stands and by one that turns."""

import math

import numpy as np
import pytest

from hri.core.signals import Frame, Pose2D
from hri.hal.camera import Camera
from hri.hal.resource import Description
from hri.simulation.world import SimulatedWorld
from hri.testing import context
from hri.vision.motion.motion_behaviors import MotionDetector, MotionFlow
from tests.behavior.library.ticking import tick


@pytest.fixture
def lent():
    made = context(Description("world", "Hri.SimulatedWorld", {"voice": "mute"}))
    made.resources.declare(Description("mute", "Hri.EspeakVoice"))
    made.resources.declare(Description("camera", "Hri.SimulatedCamera", bus="world"))
    yield made
    made.resources.close()


def started(behavior, lent):
    behavior.start(lent)
    lent.resources.obtain("camera", Camera).look_ahead(True)
    return behavior


def watched(behavior, lent, seconds, step=lambda number: None, pose=lambda: None):
    """What it sends, tick by tick; `step` is done before each."""
    camera = lent.resources.obtain("camera", Camera)
    sent = []
    for number in range(round(seconds / 0.1)):
        step(number)
        lent.clock.advance(0.1)
        inputs = {"image": camera.read(lent.clock.now()), "place": pose()}
        inputs = {name: value for name, value in inputs.items() if value is not None}
        sent.append(tick(behavior, now=lent.clock.now(), **inputs))
    return sent


def events_of(lent):
    happened = []
    for name in ("motion.started", "motion.ended"):
        lent.events.subscribe(name, lambda event: happened.append(event.name))
    return happened


@pytest.mark.proves("R09")
def test_a_thing_that_is_carried_by_starts_and_ends_motion(lent):
    world = lent.resources.obtain("world", SimulatedWorld)
    happened = events_of(lent)
    detector = started(MotionDetector("motion"), lent)
    world.place("cup", 1.2, -0.4)
    assert not any(one["is_moving"] for one in watched(detector, lent, 1.0))
    moved = watched(
        detector, lent, 1.5, lambda number: world.place("cup", 1.2, -0.4 + 0.05 * number)
    )
    assert happened == ["motion.started"]
    bearings = [one["bearing"] for one in moved if "bearing" in one]
    assert bearings[0] < 0 < bearings[-1]
    assert all(0 < one["width"] < 320 for one in moved if "width" in one)
    assert not watched(detector, lent, 2.0)[-1]["is_moving"]
    assert happened == ["motion.started", "motion.ended"]


@pytest.mark.proves("R09")
@pytest.mark.parametrize("turn", [-0.04, 0.01, 0.05])
def test_a_robot_that_turns_notices_only_what_moves(lent, turn):
    world = lent.resources.obtain("world", SimulatedWorld)
    happened = events_of(lent)
    detector = started(MotionDetector("motion"), lent)
    world.place("cup", 2.0, 0.0)

    def turning(number):
        world.base.pose = Pose2D(0.0, 0.0, turn * number)

    watched(detector, lent, 1.0, turning, lambda: world.base.pose)
    assert happened == []

    def carried_by(number):
        world.base.pose = Pose2D(0.0, 0.0, turn * (10 + number))
        bearing = turn * (10 + number) - 0.03 * number
        world.place("cup", 1.2 * math.cos(bearing), 1.2 * math.sin(bearing))

    watched(detector, lent, 1.0, carried_by, lambda: world.base.pose)
    assert happened == ["motion.started"]


@pytest.mark.proves("R09")
def test_the_flow_says_when_the_robot_will_be_there(lent):
    world = lent.resources.obtain("world", SimulatedWorld)
    flow = started(MotionFlow("flow"), lent)
    world.place("cup", 1.5, 0.0)

    def drive(number):
        world.base.pose = Pose2D(0.03 * number, 0.0, 0.0)

    sent = watched(flow, lent, 2.5, drive, lambda: world.base.pose)
    assert np.median([one["expansion"] for one in sent if "expansion" in one]) > 0
    assert math.isfinite(np.median([one.get("time_to_contact", math.inf) for one in sent[-10:]]))


def test_a_still_picture_flows_nowhere(lent):
    flow = started(MotionFlow("flow"), lent)
    sent = [one for one in watched(flow, lent, 1.0) if "x" in one]
    assert len(sent) >= 8
    assert [math.hypot(one["x"], one["y"]) for one in sent] == pytest.approx([0] * len(sent), abs=9)


def test_nothing_is_sent_for_a_picture_that_cannot_be_compared(lent):
    flow = started(MotionFlow("flow"), lent)
    for number, shape in enumerate([(1, 1), (240, 320), (5, 400)]):
        frame = Frame(np.zeros((*shape, 3), np.uint8), 0.1 * number, number)
        assert tick(flow, now=0.1 * number, image=frame) == {}
