"""Gestures of hands in looks at them, some a second; and in a network."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Output
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Event, Hand, HandGesture, HeadPose, People, Person
from hri.hal.resource_manager import ResourceManager
from hri.vision.gestures.gesture_file import HAND_GESTURE, chosen
from hri.vision.hands.hand_behaviors import HandGestures
from hri.vision.hands.hand_gestures import PeopleHands
from hri.vision.hands.hand_patterns import load_hand_patterns
from tests.vision.hands.test_hand_shape import hand

RATE = 6.0
"""Looks a second."""
ALL = (0, 1, 2, 3, 4)
Doing = Callable[[float], Hand | None]


def seen(time: float, *hands: Hand) -> People:
    return People(time, (Person("p1", HeadPose(time, 0.0, 0.0), hands=hands),))


def told(doing: Doing, seconds: float = 3.0, rate: float = RATE) -> list[HandGesture]:
    recognizer = PeopleHands(load_hand_patterns().values())
    found = []
    for number in range(round(seconds * rate)):
        time = number / rate
        shown = doing(time)
        found += recognizer.update(seen(time, *([shown] if shown else [])))
    return found


def kinds(doing: Doing, seconds: float = 3.0, rate: float = RATE) -> list[str]:
    return [gesture.kind for gesture in told(doing, seconds, rate) if gesture.kind != "count"]


def waving(hertz: float, degrees: float = 20.0) -> Doing:
    def wave(time: float) -> Hand:
        swing = math.sin(math.tau * hertz * time)
        return hand(time, *ALL, turn=math.radians(degrees) * swing, x=15 * swing)

    return wave


@pytest.mark.parametrize("hertz", [0.8, 1.2, 1.6, 2.0])
def test_a_hand_that_swings_waves_and_does_not_say_stop(hertz: float) -> None:
    assert kinds(waving(hertz)) == ["wave"]


@pytest.mark.parametrize(
    ("fingers", "turn", "kind"),
    [
        (ALL, 0, ["stop"]),
        (ALL, 90, []),
        (ALL, 180, []),
        ((0,), 40, ["thumb_up"]),
        ((0,), -130, ["thumb_down"]),
        ((0,), -50, []),
        ((1,), 80, ["point"]),
        ((1,), -120, ["point"]),
        ((1,), 0, []),
        ((), 0, []),
        ((1, 2), 0, []),
    ],
)
def test_what_a_hand_shows_for_a_while(
    fingers: tuple[int, ...], turn: float, kind: list[str]
) -> None:
    assert kinds(lambda time: hand(time, *fingers, turn=math.radians(turn))) == kind


def test_fingers_that_are_held_up_are_counted() -> None:
    (gesture,) = told(lambda time: hand(time, 1, 2))
    assert (gesture.kind, gesture.hand.fingers) == ("count", 2)


def test_what_is_shown_for_a_moment_says_nothing() -> None:
    assert kinds(lambda time: hand(time, *(ALL if 1 < time < 1.3 else ()))) == []


def test_the_back_of_a_hand_does_not_say_stop() -> None:
    def back(time: float) -> Hand:
        shown = hand(time, *ALL)
        return Hand("left", time, shown.landmarks, shown.shape, shown.straight, number=1)

    assert kinds(back) == []


def test_a_thumb_counts_once_until_it_is_taken_down() -> None:
    def twice(time: float) -> Hand:
        is_down = 2.0 < time < 3.4
        return hand(time, *(() if is_down else (0,)), turn=math.radians(40))

    assert kinds(twice, seconds=5.0) == ["thumb_up", "thumb_up"]


def test_one_wrong_look_of_some_does_not_matter() -> None:
    def doubtful(time: float) -> Hand:
        is_wrong = round(time * 15) % 7 == 3
        return hand(time, *((1, 2) if is_wrong else (0,)), turn=math.radians(40))

    assert "thumb_up" in kinds(doubtful, rate=15)


def test_pictures_between_looks_change_nothing() -> None:
    recognizer = PeopleHands(load_hand_patterns().values())
    shown = hand(1.0, *ALL)
    assert not any(recognizer.update(seen(1.0 + n / 15, shown)) for n in range(60))


def test_hands_are_told_apart() -> None:
    recognizer, found = PeopleHands(load_hand_patterns().values()), []
    for number in range(20):
        time = number / RATE
        one, other = hand(time, 0, turn=math.radians(40)), hand(time)
        two = Hand("right", time, other.landmarks, other.shape, other.straight, number=2)
        found += recognizer.update(seen(time, one, two))
    assert [(gesture.kind, gesture.hand.side) for gesture in found if gesture.kind != "count"] == [
        ("thumb_up", "left")
    ]


@settings(max_examples=40)
@given(st.lists(st.tuples(st.floats(), st.floats(-1e6, 1e6), st.sets(st.integers(0, 4)))))
def test_no_looks_crash_it_or_make_it_grow(
    looks: list[tuple[float, float, set[int]]],
) -> None:
    recognizer = PeopleHands(load_hand_patterns().values())
    for time, x, fingers in looks:
        for gesture in recognizer.update(seen(0.0, hand(time, *sorted(fingers), x=x))):
            assert math.isfinite(gesture.latency)
    assert len(recognizer._hands) <= 1


@given(st.floats(0.5, 2.2), st.floats(12, 30), st.floats(0, math.tau))
@settings(max_examples=30)
def test_a_wave_of_any_kind_never_points_nor_answers(
    hertz: float, degrees: float, phase: float
) -> None:
    def later(time: float) -> Hand:
        shown = waving(hertz, degrees)(time + phase)
        return replace(shown, time=time)

    assert not {*kinds(later)} & {"point", "thumb_up", "thumb_down"}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "0 hand gestures"),
        ('[a]\nevent = "head.nodded"\nshape = "open"\nhold_s = 1', 'begin it with "hand."'),
        ('[a]\nevent = "hand.a"\nshape = "claw"\nhold_s = 1', "claw"),
        ('[a]\nevent = "hand.a"\nshape = "open"', "write hold_s, or swings"),
        ('[a]\nevent = "hand.a"\nshape = "open"\nhold_s = 1\nswings = 3', "hold_s, or swings"),
        ('[a]\nevent = "hand.a"\nshape = "open"\nswings = 1.5', "whole number"),
        ('[a]\nevent = "hand.a"\nshape = "open"\nhold_s = nan', "hold_s"),
        ('[a]\nevent = "hand.a"\nshape = "open"\nhold_s = 1\nhight = 2', "hight"),
    ],
)
def test_a_mistake_in_the_file_has_a_place(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "hands.toml").write_text(text)
    with pytest.raises(AuthoringError, match=message):
        load_hand_patterns(tmp_path / "hands.toml")


def test_an_unknown_gesture_has_a_remedy() -> None:
    with pytest.raises(HriError, match="did you mean"):
        chosen(load_hand_patterns(), ["thumb_upp"], HAND_GESTURE)


class Script(Behavior):
    """Sends people whose hand does something."""

    people = Output[People]("people", "them")
    doing: Doing

    def compute(self, now: float, dt: float) -> None:
        shown = self.doing(now)
        self.people.send(seen(now, *([shown] if shown else [])))


def events(doing: Doing, **parameters: str) -> list[Event]:
    clock = FakeClock()
    bus = EventBus(clock)
    found: list[Event] = []
    bus.subscribe("*", found.append)
    script, gestures = Script(), HandGestures(**parameters)
    script.doing = doing
    gestures.people.sources.append(script.people)
    gestures.start(Context(clock, bus, ResourceManager([], clock)))
    for _ in range(20):
        script.compute(clock.now(), 1 / RATE)
        gestures.compute(clock.now(), 1 / RATE)
        clock.advance(1 / RATE)
    return [event for event in found if event.name.startswith(("hand.", "person."))]


@pytest.mark.parametrize(
    ("fingers", "turn", "name", "properties"),
    [
        ((0,), 40, "hand.thumb", {"direction": "up"}),
        ((0,), -130, "hand.thumb", {"direction": "down"}),
        ((1,), 90, "person.pointed", {"bearing": 0.0, "elevation": 0.0}),
        ((1, 2, 3), 0, "hand.counted", {"fingers": 3}),
        (ALL, 0, "hand.opened", {}),
    ],
)
def test_the_event_says_whose_hand_it_was_and_what_it_showed(
    fingers: tuple[int, ...], turn: float, name: str, properties: dict[str, object]
) -> None:
    found = events(lambda time: hand(time, *fingers, turn=math.radians(turn)))
    event = next(event for event in found if event.name == name)
    assert event.properties["person"] == "p1"
    assert event.properties["hand"] == "left"
    assert 0 < event.properties["latency"] < 2
    assert {key: event.properties[key] for key in properties} == properties


def test_only_the_chosen_gestures_are_reported() -> None:
    assert events(lambda time: hand(time, *ALL), gestures="wave") == []


def test_hands_of_no_number_are_left_out() -> None:
    def broken(time: float) -> Hand:
        points = np.full((21, 3), math.nan, np.float32)
        return Hand("left", time, points, "open", (True,) * 5, number=1)

    assert told(broken) == []
