from collections.abc import Callable

import numpy as np
import pytest

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output
from hri.core.clock import FakeClock
from hri.core.events import EventBus
from hri.core.signals import Event, FaceBox, Frame, Gaze, HeadGesture, HeadPose
from hri.hal.manager import ResourceManager
from hri.simulation.motion import nod_angles, shake_angles
from hri.vision.behaviors import HeadGestures, HeadTracker, gaze_at
from tests.vision.film import Motion, film, still

TICK = 1 / 15


class Projector(Behavior):
    """Shows a film, one frame a tick."""

    image = Output[Frame]("image", "the frames")
    prompted = Output[bool]("boolean", "whether an answer is expected")
    frames: list[Frame] = []

    def compute(self, now: float, dt: float) -> None:
        self.prompted.send(True)
        if self.frames:
            self.image.send(self.frames.pop(0))


class Notes(Behavior):
    """Writes down what the others send."""

    pose = Input[HeadPose]("headpose", "poses")
    gaze = Input[Gaze]("gaze", "gazes")
    is_seen = Input[bool]("boolean", "whether somebody is there")
    gesture = Input[HeadGesture]("gesture", "gestures")

    def start(self, context: Context) -> None:
        self.rows: list[tuple[float, bool | None, Gaze | None, HeadPose | None]] = []
        self.gestures: list[str] = []

    def compute(self, now: float, dt: float) -> None:
        self.rows.append((now, self.is_seen.value, self.gaze.value, self.pose.value))
        if self.gesture.value is not None:
            self.gestures.append(self.gesture.value.kind)


class Theater:
    """A tracker and a recognizer that watch a film."""

    def __init__(self) -> None:
        self.clock = FakeClock()
        events = EventBus(self.clock)
        self.events: list[Event] = []
        events.subscribe("*", self.events.append)
        self.projector, self.tracker = Projector(), HeadTracker()
        self.recognizer, self.notes = HeadGestures(), Notes()
        self.tracker.image.sources.append(self.projector.image)
        self.recognizer.pose.sources.append(self.tracker.pose)
        self.recognizer.prompted.sources.append(self.projector.prompted)
        self.notes.pose.sources.append(self.tracker.pose)
        self.notes.gaze.sources.append(self.tracker.gaze)
        self.notes.is_seen.sources.append(self.tracker.is_seen)
        self.notes.gesture.sources.append(self.recognizer.gesture)
        self.behaviors = (self.projector, self.tracker, self.recognizer, self.notes)
        context = Context(self.clock, events, ResourceManager([], self.clock))
        for behavior in self.behaviors:
            behavior.start(context)

    def show(self, frames: list[Frame], silence: float = 0.0) -> "Theater":
        """Show frames from now on, then nothing for some seconds."""
        begin = self.clock.now()
        count = len(frames) + round(silence / TICK)
        self.projector.frames = [Frame(f.image, f.time + begin, f.sequence) for f in frames]
        for _ in range(count):
            for behavior in self.behaviors:
                for name in behavior.outputs:
                    getattr(behavior, name).value = None
                behavior.compute(self.clock.now(), TICK)
            self.clock.advance(TICK)
        return self

    def names(self) -> list[str]:
        return [event.name for event in self.events]


def room(seconds: float) -> list[Frame]:
    return list(film(duration=seconds, place=lambda t: (2000.0, 120.0)))


@pytest.mark.parametrize(
    ("angles", "kind", "event"),
    [(nod_angles, "nod", "head.nodded"), (shake_angles, "shake", "head.shaken")],
)
def test_a_gesture_is_sent_and_told(angles: Motion, kind: str, event: str) -> None:
    theater = Theater().show(list(film(lambda t: angles(t - 0.8), duration=2.5)))
    assert theater.notes.gestures == [kind]
    assert theater.names() == ["person.seen", event]
    assert 0.5 <= theater.events[1].properties["confidence"] <= 1


def test_a_person_is_seen_remembered_and_lost() -> None:
    theater = Theater().show(list(film(duration=1.0)), silence=5.0)
    seen = [now for now, is_seen, _, _ in theater.notes.rows if is_seen]
    assert seen[-1] == pytest.approx(2.0, abs=0.3), "a second after the last frame"
    assert [gaze is not None for _, _, gaze, _ in theater.notes.rows] == [
        is_seen for _, is_seen, _, _ in theater.notes.rows
    ]
    assert theater.names() == ["person.seen", "person.lost"]
    assert theater.events[1].time == pytest.approx(4.0, abs=0.3)


def test_who_is_away_for_a_moment_is_not_seen_anew() -> None:
    theater = Theater().show(list(film(duration=1.0)))
    theater.show([*room(1.5), *list(film(duration=1.0))])
    assert theater.names() == ["person.seen"]


def test_nobody_is_seen_in_an_empty_room() -> None:
    theater = Theater().show(room(2.0))
    assert theater.names() == []
    assert not any(is_seen for _, is_seen, _, _ in theater.notes.rows)


def test_broken_frames_are_ignored() -> None:
    odd = [Frame(np.zeros(shape, np.uint8), 0.0, 0) for shape in ((1, 1, 3), (5,), (9, 9))]
    theater = Theater().show(odd).show(list(film(duration=1.0)))
    assert theater.names() == ["person.seen"]


def gaze_of(place: Callable[[float], tuple[float, float]]) -> Gaze:
    theater = Theater().show(list(film(still, duration=1.0, place=place)), silence=0.2)
    gaze = theater.notes.rows[-1][2]
    assert gaze is not None
    return gaze


def test_the_robot_looks_where_the_person_is() -> None:
    # Who stands at the left of the picture stands at the robot's left: the viewer's right.
    left = gaze_of(lambda t: (100.0, 120.0))
    right = gaze_of(lambda t: (220.0, 120.0))
    assert left.x == pytest.approx(0.375, abs=0.06)
    assert right.x == pytest.approx(-0.375, abs=0.06)
    assert gaze_of(lambda t: (160.0, 80.0)).y > 0.15 > -0.15 > gaze_of(lambda t: (160.0, 150.0)).y


def test_the_gaze_stays_within_its_range() -> None:
    assert gaze_at(FaceBox(-200, 900, 80, 80), 320, 240) == Gaze(1.0, -1.0)
    assert gaze_at(FaceBox(120, 80, 80, 80), 320, 240) == Gaze(0.0, 0.0)


def test_two_showings_are_alike() -> None:
    def told() -> list[object]:
        theater = Theater().show(list(film(lambda t: nod_angles(t - 0.8), duration=2.0)))
        return [theater.notes.rows, theater.events]

    assert told() == told()
