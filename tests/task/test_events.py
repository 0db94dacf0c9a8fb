import string
from datetime import UTC

import pytest
from hypothesis import given, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Event
from hri.task.events import event, parse_event, parse_query, write_event, write_query
from tests.task.stage import Stage

SHOOT = (
    '{Event Examples.PhotoEvent.Shoot [time 0] (count: 3.000000) (delay: 1.000000) (name: "a_")}'
)

NAMES = st.text(string.ascii_letters + string.digits + "._-*?&=%äöü", min_size=1, max_size=20)
VALUES = st.one_of(
    st.text(st.characters(), max_size=30),  # halves of letters, too
    st.floats(allow_nan=False, allow_infinity=False),
    st.integers(-(10**9), 10**9),
)
EVENTS = st.builds(
    lambda name, properties: event(name, **properties),
    NAMES,
    st.dictionaries(NAMES, VALUES, max_size=5),
)


@pytest.mark.proves("T16")
def test_the_text_form_of_2003():
    shoot = event("Examples.PhotoEvent.Shoot", name="a_", count="3.0", delay="1.0")
    assert write_event(shoot) == SHOOT
    assert parse_event(SHOOT) == shoot
    assert write_event(event("Examples.PhotoEvent.End")) == (
        "{Event Examples.PhotoEvent.End [time 0]}"
    )


@pytest.mark.proves("T16")
def test_a_raised_event_has_the_seconds_since_1970():
    clock = FakeClock()
    clock.advance(5.0)
    done = EventBus(clock).raise_event("Examples.PhotoEvent.Done", name="a_")
    clock.advance(7.0)
    written = '{Event Examples.PhotoEvent.Done [time 1.05593e+09] (name: "a_")}'
    assert write_event(done) == write_event(done, clock) == written
    assert done.since_1970 == pytest.approx(clock.wall().replace(tzinfo=UTC).timestamp() - 7.0)


@pytest.mark.proves("T16")
def test_an_event_that_a_task_receives_has_the_seconds_since_1970():
    stage = Stage()

    async def received(context) -> str:
        context.clock.call_at(2.0, lambda: context.manager.raise_event(event("Mine.Done", n=1)))
        return write_event(await context.wait_for("Mine.*"))

    assert stage.run(received) == "{Event Mine.Done [time 1.05593e+09] (n: 1.000000)}"


@pytest.mark.proves("T16")
def test_an_event_of_another_program_has_the_seconds_since_1970():
    raised = EventBus(FakeClock()).raise_from_outside(parse_query("Door.Opened"))
    assert write_event(raised) == "{Event Door.Opened [time 1.05593e+09]}"


@pytest.mark.proves("T15", "E2")
def test_a_text_that_looks_like_a_number_becomes_one():
    raised = event("x", count="3.0", huge="1e999", name="3a", flag=True)
    assert raised.get_property("count", float) == 3.0
    assert raised.get_property("huge", str) == "1e999"
    assert raised.get_property("name", str) == "3a"
    assert raised.get_property("flag", float) == 1.0


@pytest.mark.proves("T23")
def test_the_query_form_of_2003():
    shoot = parse_query("Examples.PhotoEvent.Shoot?count=5&name=b_&delay=1")
    assert shoot == event("Examples.PhotoEvent.Shoot", count=5.0, name="b_", delay=1.0)
    assert write_query(shoot) == "Examples.PhotoEvent.Shoot?count=5&name=b_&delay=1"
    assert parse_query("Examples.PhotoEvent.End") == event("Examples.PhotoEvent.End")
    assert parse_query("A?share=50%&x=a%26b").properties == {"share": "50%", "x": "a&b"}


@pytest.mark.proves("T23")
@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is not a valid name"),
        ("?a=1", "is not a valid name"),
        ("A B?a=1", "is not a valid name"),
        ("A?a", "is not like property=value"),
        ("A?=1", "is not like property=value"),
        ("A?a=1&a=2", "is there twice"),
        ("A?" + "a" * 70_000, "70002 characters"),
        ("A?" + "&".join(f"p{n}=1" for n in range(1001)), "1001 properties"),
    ],
)
def test_what_is_no_query_is_told(text, message):
    with pytest.raises(HriError, match=message):
        parse_query(text)


@pytest.mark.proves("T16")
@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "does not begin"),
        ("{Event A}", "does not begin"),
        ("{Event A [time soon]}", "is not a time"),
        ("{Event A [time 0] (a: b)}", "is not a number and has no quotes"),
        ("{Event A [time 0] (a: 1) (a: 2)}", "is there twice"),
        ('{Event A [time 0] (a: "b)}', "is not understood at character 18"),
        ("{Event A [time 0]", "is not understood"),
        ("{Event A [time 0]}}", "is not understood"),
    ],
)
def test_what_is_no_event_is_told(text, message):
    with pytest.raises(HriError, match=message):
        parse_event(text)


def test_what_cannot_be_written_is_refused():
    with pytest.raises(HriError, match="is not a valid name"):
        event("two words")
    with pytest.raises(HriError, match="give a finite number or a text"):
        write_event(Event("a", 0.0, {"tags": {}}))
    with pytest.raises(HriError, match="give a finite number or a text"):
        event("a", count=10**400)


@pytest.mark.proves("T23")
@given(EVENTS)
def test_the_query_form_loses_nothing(raised):
    assert parse_query(write_query(raised)) == raised


@pytest.mark.proves("T16")
@given(EVENTS)
def test_the_text_form_loses_nothing(raised):
    assert parse_event(write_event(raised)) == raised


PIECES = st.lists(
    st.sampled_from(["{Event ", "A", " [time ", "0", "]", " (", "a: ", '"', "\\", ")", "}", "1e9"]),
    max_size=20,
).map("".join)


@pytest.mark.proves("T16", "T23")
@given(st.one_of(st.text(), PIECES))
def test_any_text_gives_an_event_or_one_error(text):
    for parse in (parse_event, parse_query):
        told = "an event - read"
        try:
            assert isinstance(parse(text), Event)
        except HriError as error:
            told = str(error)
        assert " - " in told
        assert len(told) < 300
