"""What the real recognizers make of the simulated person."""

from collections.abc import Iterator

import pytest

from hri.core.clock import FakeClock
from hri.core.paths import house
from hri.core.signals import HeadGesture
from hri.hal.camera import Camera
from hri.hal.microphone import Microphone
from hri.hal.recognizer import Recognizer
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.world import SimulatedWorld
from hri.speech.grammar import load_grammar
from hri.speech.turn import Turn
from hri.vision.detectors.detector_choice import load_detectors
from hri.vision.gestures.gesture_patterns import answer_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer
from hri.vision.tracking.people import PeopleTracker

from .conftest import Build


@pytest.fixture
def manager() -> Iterator[ResourceManager]:
    pytest.importorskip("pocketsphinx", reason="it has no wheels for this Python")
    descriptions = [
        Description("world", "Hri.SimulatedWorld"),
        Description("microphone", "Hri.SimulatedMicrophone", bus="world"),
        Description("recognizer", "Hri.PocketSphinx"),
    ]
    manager = ResourceManager(descriptions, FakeClock())
    yield manager
    manager.close()


@pytest.mark.slow
def test_what_the_person_says_is_heard_and_small_talk_is_not(manager: ResourceManager) -> None:
    world = manager.obtain("world", SimulatedWorld)
    microphone = manager.obtain("microphone", Microphone)
    recognizer = manager.obtain("recognizer", Recognizer)
    companion = load_grammar(house() / "grammars" / "companion.jsgf")
    recognizer.start(companion)
    world.say("go forward ten meters", 0.5)
    world.say("my sister went to Lisbon for the summer", 4.0)
    segments = []
    for tick in range(1, 9 * 30):
        segments += recognizer.listen(microphone.read(tick / 30), tick / 30)
    rules = Turn().rules(companion)
    hypotheses = [recognizer.decode(segment, rules) for segment in segments]
    assert len(segments) == 2
    assert segments[0].start == pytest.approx(0.2, abs=0.1)
    assert hypotheses[0].text == "go forward ten meters"
    assert hypotheses[0].confidence > 0.5 > hypotheses[1].confidence


def gestures(build: Build, movement: str) -> list[HeadGesture]:
    manager = build(None, camera={"rate": "15"})
    camera = manager.obtain("camera", Camera)
    getattr(manager.obtain("world", SimulatedWorld).person, movement)(1.5)
    tracker = PeopleTracker(load_detectors("haar"))
    recognizer = GestureRecognizer(answer_patterns())
    found = []
    for tick in range(4 * 15):
        if (frame := camera.read(tick / 15)) is None:
            continue
        for person in tracker.see(frame).persons:
            if (gesture := recognizer.update(person.pose)) is not None:
                found.append(gesture)
    return found


@pytest.mark.parametrize("kind", ["nod", "shake"])
def test_a_nod_and_a_shake_are_seen(build: Build, kind: str) -> None:
    first = gestures(build, kind)[0]
    assert first.kind == kind
    assert 1.5 < first.time < 3.3


def test_a_glance_is_no_gesture(build: Build) -> None:
    assert gestures(build, "look_aside") == []
