import json
import re
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

import hri.core.event_bus
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import OWN_SUBJECTS, EventBus, matches
from hri.core.event_log import EventLog, read_events
from hri.core.latest import Board, Latest
from hri.core.origin import BRIDGE
from hri.core.signals import Event


def test_listeners_hear_what_fits_in_the_order_they_came():
    clock = FakeClock()
    bus, heard = EventBus(clock), []
    bus.subscribe("head.*", lambda event: heard.append(("first", event.name)))
    second = bus.subscribe("*", lambda event: heard.append(("second", event.name)))
    bus.raise_event("head.nodded")
    bus.raise_event("speech.heard", text="hello")
    second.cancel()
    second.cancel()
    bus.raise_event("speech.heard")
    assert heard == [
        ("first", "head.nodded"),
        ("second", "head.nodded"),
        ("second", "speech.heard"),
    ]


def test_patterns():
    assert matches("*", "a.b")
    assert matches("a.*", "a.b")
    assert not matches("a.*", "b.a")
    assert matches("speech.heard", "speech.heard")


def test_the_log_has_an_object_a_line_and_knows_no_infinity(tmp_path):
    clock = FakeClock()
    bus = EventBus(clock)
    log = EventLog(tmp_path / "events.jsonl", bus)
    clock.advance(1.25)
    bus.raise_event("range.read", distance=float("inf"), tags={"n": 10.0}, who=("a", "b"))
    log.close()
    bus.raise_event("too.late")
    line = (tmp_path / "events.jsonl").read_text()
    assert json.loads(line) == {
        "t": 1.25,
        "event": "range.read",
        "distance": None,
        "tags": {"n": 10.0},
        "who": ["a", "b"],
    }
    assert len(read_events(tmp_path / "events.jsonl")) == 1


def test_the_newest_value_wins_and_slots_are_shared_by_name():
    latest: Latest[int] = Latest()
    assert latest.get() == (None, 0.0)
    latest.set(1, 0.5)
    latest.set(2, 0.7)
    assert latest.get() == (2, 0.7)
    board = Board()
    board.slot("gaze").set("left", 1.0)
    assert board.slot("gaze").value == "left"


@pytest.mark.proves("T14")
@pytest.mark.parametrize(
    ("pattern", "name", "fits"),
    [
        ("a.*.c", "a.b.c", True),
        ("a.*.c", "a.c", False),
        ("*.End", "Examples.PhotoEvent.End", True),
        ("*b*b*", "abab", True),
        ("ab*ba", "aba", False),
        ("what?", "whatx", False),
        ("what?", "what?", True),
        ("[ab]", "a", False),
        ("[ab]*", "[ab].c", True),
        ("", "", True),
        ("", "a", False),
    ],
)
def test_only_the_asterisk_is_special(pattern, name, fits):
    assert matches(pattern, name) is fits


@pytest.mark.proves("T14")
@given(st.text("ab*?[", max_size=8), st.text("ab?[", max_size=10))
def test_patterns_mean_what_a_regular_expression_would(pattern, name):
    expression = ".*".join(map(re.escape, pattern.split("*")))
    assert matches(pattern, name) == bool(re.fullmatch(expression, name, re.DOTALL))


@pytest.mark.proves("T15")
def test_properties_are_typed():
    event = Event("photo.taken", 1.0, {"count": 3, "name": "a_", "sharp": True})
    assert event.get_property("count", float) == 3.0
    assert event.get_property("count", int) == 3
    assert event.get_property("name", str) == "a_"
    assert event.get_property("sharp", bool) is True
    with pytest.raises(HriError, match=r'"name" is a str, no float'):
        event.get_property("name", float)
    with pytest.raises(HriError, match=r'"sharp" is a bool, no float'):
        event.get_property("sharp", float)
    with pytest.raises(HriError, match=r'no property "cuont" - did you mean "count"'):
        event.get_property("cuont", float)


def test_a_second_cancel_leaves_an_equal_listener_alone():
    bus, heard = EventBus(FakeClock()), []
    first, second = (bus.subscribe("*", heard.append) for _ in range(2))
    first.cancel()
    first.cancel()
    bus.raise_event("door.opened")
    assert len(heard) == 1
    second.cancel()
    bus.raise_event("door.opened")
    assert len(heard) == 1


def test_a_listener_that_fails_keeps_nobody_from_hearing_and_is_told_once(caplog):
    bus, heard = EventBus(FakeClock()), []
    bus.subscribe("door.*", lambda event: 1 / 0)
    bus.subscribe("*", heard.append)
    for _ in range(3):
        bus.raise_event("door.opened")
    assert len(heard) == 3
    assert caplog.text.count('a listener to "door.*" failed at door.opened') == 1
    assert "ZeroDivisionError" in caplog.text


HOUSE = Path(hri.core.event_bus.__file__).parents[2]
LITERAL = re.compile(r'(?:raise_event|subscribe|queue|wait_for)\(\s*"([a-z]+)[.*]')


def test_every_event_of_the_house_is_one_that_nobody_outside_may_raise():
    """Also those of next year: their first word belongs into OWN_SUBJECTS."""
    files = [*(HOUSE / "hri").rglob("*.py"), *(HOUSE / "apps").rglob("*.py")]
    examples = ("bench", "templates")
    found = {
        subject
        for path in files
        if not set(examples) & set(path.parts)
        for subject in LITERAL.findall(path.read_text())
    }
    assert len(found) > 15
    assert found <= OWN_SUBJECTS


def test_an_event_from_outside_is_marked_and_has_the_time_of_now():
    clock = FakeClock()
    bus, heard = EventBus(clock), []
    bus.subscribe("*", heard.append)
    clock.advance(2.0)
    raised = bus.raise_from_outside(Event("Examples.Door", 99.0, {"side": "left"}))
    assert (
        heard == [raised] == [Event("Examples.Door", clock.now(), {"side": "left"}, True, BRIDGE)]
    )
    assert not bus.raise_event("door.opened").is_from_outside
    with pytest.raises(HriError, match=r'only the robot itself raises "speech\.heard"'):
        bus.raise_from_outside(Event("speech.heard"))
    assert len(heard) == 2


def test_an_event_is_made_empty_given_its_properties_and_raised():
    bus = EventBus(FakeClock())
    heard = []
    bus.subscribe("*", heard.append)
    shoot = Event("Examples.Shoot")
    shoot.set_property("count", "3.0")
    shoot.set_property("name", "a_")
    assert shoot.get_property("count", float) == 3.0
    raised = bus.raise_event(shoot.name, **shoot.properties)
    assert heard == [raised]
    with pytest.raises(HriError, match="has been raised and does not change - make an event"):
        raised.set_property("count", 4)
    with pytest.raises(HriError, match="give a finite number or a text"):
        shoot.set_property("count", [1])
    with pytest.raises(HriError, match="leave out white space"):
        shoot.set_property("a count", 1)
