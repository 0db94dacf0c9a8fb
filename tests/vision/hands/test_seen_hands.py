"""Hands that a simulated person shows, seen through the camera by the networks."""

import hashlib
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import astuple
from pathlib import Path

import pytest

from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.signals import Frame, HandGesture, People
from hri.hal.camera import Camera
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.people.person import SimulatedPerson
from hri.simulation.world import SimulatedWorld
from hri.vision.camera_view import CameraView
from hri.vision.engagement import Zones
from hri.vision.face_models import HAND, PALM
from hri.vision.hands.hand_gestures import PeopleHands
from hri.vision.hands.hand_patterns import load_hand_patterns
from hri.vision.tracking.people import Seeing

RATE = 15
GESTURES = ("wave", "stop", "thumb_up", "thumb_down", "point")


@pytest.fixture(scope="module", autouse=True)
def _networks(face_models: Path) -> None:
    if not all((face_models / part.name).is_file() for part in (PALM, HAND)):
        pytest.skip("the networks of hands are not here: hri models fetch face")


class Stage:
    """A simulated room with a camera, in fake time."""

    def __init__(self) -> None:
        shape = {"width": "640", "height": "480", "rate": str(RATE)}
        devices = [
            Description("world", "Hri.SimulatedWorld"),
            Description("camera", "Hri.SimulatedCamera", shape, bus="world"),
        ]
        self._clock = FakeClock()
        resources = ResourceManager(devices, self._clock, lambda _: None)
        self.camera = resources.obtain("camera", Camera)
        self.person: SimulatedPerson = resources.obtain("world", SimulatedWorld).person

    def frames(self, seconds: float) -> Iterator[Frame]:
        while self._clock.now() < seconds:
            frame = self.camera.read(self._clock.now())
            if frame is not None:
                yield frame
            self._clock.advance(1 / RATE)

    def seen(self, seconds: float) -> list[People]:
        see = Seeing("auto", CameraView.of(self.camera), Zones(), hands=True)()
        return [see(frame) for frame in self.frames(seconds)]


def told(seen: list[People]) -> list[HandGesture]:
    recognizer = PeopleHands(load_hand_patterns().values())
    return [gesture for people in seen for gesture in recognizer.update(people)]


@pytest.mark.parametrize("name", GESTURES)
def test_what_a_person_shows_is_told_once_and_soon(name: str) -> None:
    stage = Stage()
    stage.person.show(name, 1.5)
    made = [gesture for gesture in told(stage.seen(4.5)) if gesture.kind in GESTURES]
    assert [(gesture.kind, gesture.hand.side, gesture.person) for gesture in made] == [
        (name, "left", "p1")
    ]
    assert 1.5 < made[0].time < 3.8


def test_joints_lie_on_the_hand() -> None:
    stage = Stage()
    stage.person.show("stop", 1.0)
    last = stage.seen(2.8)[-1].persons[0]
    (hand,) = last.hands
    box = last.pose.box
    assert box is not None
    meter = box.height / 0.2  # about; the palm is drawn 0.26 m beside the head's middle
    middle = hand.landmarks[[0, 5, 17], :2].mean(axis=0)
    assert abs(middle[0] - (box.x + box.width / 2) - 0.26 * meter) < 0.08 * meter
    assert hand.landmarks[[8, 12, 16, 20], 1].max() < middle[1]
    assert (hand.shape, hand.is_palm) == ("open", True)


def film() -> str:
    """A sum over who is seen in a film in fake time, with their ids, places and hands: someone
    raises a hand, leaves, and comes back.
    """
    stage = Stage()
    stage.person.show("stop", 0.6, seconds=1.2)
    stage.person.leave(2.6)
    stage.person.enter(3.6)
    seen = stage.seen(5.4)
    assert told(seen)
    found = hashlib.sha256()
    for people in seen:
        found.update(repr((people.time, people.attended)).encode())
        for person in people.persons:
            found.update(repr((person.id, person.is_visible, astuple(person.pose))).encode())
            for hand in person.hands:
                found.update(repr((hand.number, hand.side, hand.shape, hand.time)).encode())
                found.update(hand.landmarks.tobytes())
    return found.hexdigest()


def test_one_film_gives_the_same_people_ids_and_hands_in_one_process_and_in_two() -> None:
    words = "from tests.vision.hands.test_seen_hands import film; print(film())"
    first, second = film(), film()
    other = subprocess.run(
        [sys.executable, "-c", words],
        cwd=paths.house(),
        capture_output=True,
        text=True,
        timeout=300,
        check=True,
    )
    assert second == first
    assert other.stdout.strip() == first
