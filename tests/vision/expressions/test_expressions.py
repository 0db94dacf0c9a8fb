"""Facial expressions in what the parts of a face do, some times a second; and in a network."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Output
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Countenance, Event, HeadPose, People, Person
from hri.hal.resource_manager import ResourceManager
from hri.vision.expressions.expression_behaviors import FacialExpressions
from hri.vision.expressions.expression_patterns import load_expression_patterns
from hri.vision.expressions.expression_recognizer import PeopleExpressions

RATE = 15.0
Doing = Callable[[float], Countenance | None]


def seen(time: float, face: Countenance | None, yaw: float = 0.0) -> People:
    return People(time, (Person("p1", HeadPose(time, 0.0, yaw), countenance=face),))


def between(begin: float, end: float, **parts: float) -> Doing:
    return lambda time: Countenance(**parts) if begin <= time < end else Countenance()


def told(doing: Doing, seconds: float = 5.0, yaw: float = 0.0) -> list[tuple[str, bool]]:
    recognizer = PeopleExpressions(load_expression_patterns().values())
    times = (number / RATE for number in range(round(seconds * RATE)))
    return [
        (one.kind, one.is_over)
        for time in times
        for one in recognizer.update(seen(time, doing(time), yaw))
    ]


@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("smile", {"smile": 0.8}),
        ("brows_raised", {"brows": 0.8}),
        ("brows_lowered", {"brows": -0.8}),
        ("eyes_shut", {"blink": 0.9}),
    ],
)
def test_what_lasts_is_told_when_it_shows_and_when_it_is_over(
    name: str, parts: dict[str, float]
) -> None:
    assert told(between(1.0, 3.0, **parts)) == [(name, False), (name, True)]


def test_a_blink_is_told_once_and_eyes_that_stay_shut_are_none() -> None:
    assert told(between(1.0, 1.2, blink=0.9)) == [("blink", True)]
    assert told(between(1.0, 3.0, blink=0.9)) == [("eyes_shut", False), ("eyes_shut", True)]


def test_a_twitch_is_not_a_smile() -> None:
    assert told(between(1.0, 1.2, smile=1.0)) == []


def test_a_smile_that_flickers_at_its_edge_is_told_once() -> None:
    def flickers(time: float) -> Countenance:
        return Countenance(smile=0.4 + 0.1 * math.sin(40 * time) if 1 < time < 4 else 0.0)

    assert told(flickers) == [("smile", False), ("smile", True)]


def test_a_face_that_is_turned_aside_or_has_no_mesh_shows_nothing() -> None:
    assert told(between(1.0, 3.0, smile=1.0), yaw=math.radians(40)) == []
    assert told(lambda time: None) == []


def test_what_shows_when_the_face_goes_is_over_soon_and_a_blink_then_does_not_count() -> None:
    assert told(lambda time: Countenance(smile=1.0) if time < 2 else None) == [
        ("smile", False),
        ("smile", True),
    ]
    assert told(lambda time: Countenance(blink=1.0) if 2 < time < 2.2 else None) == []


def test_who_leaves_shows_nothing() -> None:
    recognizer = PeopleExpressions(load_expression_patterns().values())
    for number in range(10):
        recognizer.update(seen(number / RATE, Countenance(smile=1.0)))
    assert recognizer.shown_by("p1") == ("smile",)
    (over,) = recognizer.update(People(1.0))
    assert (over.kind, over.is_over, over.person) == ("smile", True, "p1")
    assert recognizer.shown_by("p1") == ()


@given(
    st.lists(
        st.tuples(
            st.floats(-1.0, 2.0),
            st.none() | st.builds(Countenance, *[st.floats(-1.0, 1.0)] * 3),
        ),
        max_size=40,
    )
)
def test_what_lasts_begins_and_ends_in_turns(steps: list[tuple[float, Countenance | None]]) -> None:
    patterns = load_expression_patterns()
    recognizer, time = PeopleExpressions(patterns.values()), 0.0
    shown: set[str] = set()
    for step, face in steps:
        time += step  # also backward, as in a film that begins again
        for one in recognizer.update(seen(time, face)):
            if patterns[one.kind].is_brief:
                continue
            assert (one.kind in shown) == one.is_over
            shown ^= {one.kind}
        assert set(recognizer.shown_by("p1")) == shown


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "0 facial expressions"),
        ('[a]\nmeasure = "ears"\nbegins = 1\nends = 0\nhold_s = 1', "ears"),
        ('[a]\nmeasure = "smile"\nbegins = 0.5\nends = 0.6\nhold_s = 1', "from 0 to below 0.5"),
        ('[a]\nmeasure = "brows"\nbegins = -0.5\nends = 0.2\nhold_s = 1', "from 0 to below -0.5"),
        ('[a]\nmeasure = "smile"\nbegins = 0.5\nends = 0.2', "write hold_s, or within_s"),
        ('[a]\nmeasure = "smile"\nbegins = nan\nends = 0.2\nhold_s = 1', "begins"),
        ('[a]\nmeasure = "smile"\nbegins = 0.5\nends = 0\nhold_s = 1\nhold = 2', "hold"),
    ],
)
def test_a_mistake_in_the_file_has_a_place(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "expressions.toml").write_text(text)
    with pytest.raises(AuthoringError, match=message):
        load_expression_patterns(tmp_path / "expressions.toml")


class Script(Behavior):
    """Sends people whose face does something."""

    people = Output[People]("people", "them")

    def compute(self, now: float, dt: float) -> None:
        people = seen(now, between(1.0, 2.0, smile=0.9)(now))
        self.people.send(People(now, people.persons, attended="p1"))


def events(**parameters: str) -> tuple[list[Event], set[str]]:
    """What is raised while someone smiles for a second, and all that was said to show."""
    clock = FakeClock()
    bus = EventBus(clock)
    found: list[Event] = []
    bus.subscribe("person.*", found.append)
    script, expressions = Script(), FacialExpressions(**parameters)
    expressions.people.sources.append(script.people)
    expressions.start(Context(clock, bus, ResourceManager([], clock)))
    shown = set()
    for _ in range(45):
        script.compute(clock.now(), 1 / RATE)
        expressions.compute(clock.now(), 1 / RATE)
        shown.add(expressions.shown.value)
        clock.advance(1 / RATE)
    return found, shown


def test_events_say_whose_face_shows_what_and_for_how_long() -> None:
    (begun, over), shown = events()
    assert (begun.name, over.name) == ("person.expressed", "person.relaxed")
    assert begun.properties == {"person": "p1", "expression": "smile", "seconds": 0.333}
    assert over.properties["seconds"] == pytest.approx(1.0, abs=0.1)
    assert shown == {"", "smile"}


def test_only_the_chosen_expressions_are_reported() -> None:
    assert events(expressions="blink eyes_shut") == ([], {""})
    with pytest.raises(HriError, match='did you mean "smile"'):
        events(expressions="smlie")
