import pytest
from hypothesis import given, strategies as st

from hri.core.signals import Event
from hri.task.conditions import (
    ANYWHERE,
    Condition,
    all_of,
    any_of,
    raise_when,
    sequence,
    when,
    without,
)
from tests.task.stage import Stage

pytestmark = pytest.mark.proves("T18")


def met(condition: Condition, text: str) -> int | None:
    """`text`: the names of events, a letter each, a second apart; a dot is a second of nothing."""
    events = [Event(name, float(at)) for at, name in enumerate(text) if name != "."]
    match = condition.match()
    return next((int(event.time) for event in events if match(event, ANYWHERE)), None)


@pytest.mark.parametrize(
    ("condition", "text", "expected"),
    [
        (all_of("a", "b"), "xbya", 3),
        (all_of("a", "b"), "aaa", None),
        (any_of("a", "b"), "xba", 1),
        (sequence("a", "b"), "baxb", 3),
        (sequence("a", "b"), "ba", None),
        (without("a", "b"), "ba", 1),
        (without(sequence("a", "c"), "b"), "abc", None),
        (without(sequence("a", "c"), "b"), "abcac", 4),
        (all_of("a", "b", within=2), "a..b", None),
        (all_of("a", "b", within=2), "a..b.a", 5),
        (sequence("a", all_of("b", "c"), within=3), "acb", 2),
        (any_of(sequence("a", "b"), "c"), "ac", 1),
        (all_of("*", "a"), "a", 0),
        (without(sequence("a", "c"), sequence("b", "d")), "badcac", 5),
        (sequence("a", without("b", "c"), "d", within=3), "abad", 3),
        (sequence("a", without("b", "c"), "d", within=3), "abacd", None),
        (sequence(all_of("a", "b", within=1), "c", within=3), "a.babc", 5),
    ],
)
def test_when_conditions_are_met(condition, text, expected):
    assert met(condition, text) == expected


TEXTS = st.text("abc.", max_size=12)


@given(TEXTS)
def test_the_logic_of_events(text):
    first, second = (met(any_of(name), text) for name in "ab")
    both, either = met(all_of("a", "b"), text), met(any_of("a", "b"), text)
    known = [end for end in (first, second) if end is not None]
    assert either == min(known, default=None)
    assert both == (max(known) if len(known) == 2 else None)
    assert met(all_of("b", "a"), text) == both
    assert met(without("a", "d"), text) == first
    assert met(sequence("a"), text) == first


@given(TEXTS, st.integers(0, 12))
def test_less_time_never_meets_more(text, seconds):
    loose, tight = met(sequence("a", "b"), text), met(sequence("a", "b", within=seconds), text)
    assert tight is None or (loose is not None and loose <= tight)


@given(TEXTS, TEXTS)
def test_what_is_met_stays_met(text, more):
    condition = sequence(all_of("a", "b"), "c", within=4)
    if (end := met(condition, text)) is not None:
        assert met(condition, text + more) == end


def test_a_task_waits_for_a_condition():
    async def main(context):
        for at, name in enumerate(["door.opened", "person.seen", "light.on", "door.closed"]):
            context.clock.call_at(at, lambda name=name: context.events.raise_event(name))
        last = await when(context, sequence("door.opened", any_of("light.*", "radio.on")))
        assert (last.name, last.time) == ("light.on", 2.0)

    Stage().run(main)


def test_an_event_of_its_own_each_time():
    async def main(context):
        context.manager.install(raise_when, sequence("a", "b"), "ab")
        await context.clock.sleep(1)
        for name in "abaxbab":
            context.events.raise_event(name)
        await context.clock.sleep(1)
        context.manager.shutdown()

    stage = Stage()
    stage.run(main)
    assert stage.names().count("ab") == 3


def test_mistakes():
    with pytest.raises(ValueError, match="condition of nothing"):
        all_of()
    with pytest.raises(ValueError, match="itself - choose another name"):
        Stage().run(raise_when, "a*", "again")


NAMES = st.sampled_from("abc*")
TIMES = st.sampled_from([float("inf"), 0.0, 1.0, 2.0, 5.0])
PARTS = st.recursive(
    NAMES,
    lambda parts: st.one_of(
        st.tuples(st.just(all_of), st.lists(parts, min_size=1, max_size=3), TIMES),
        st.tuples(st.just(any_of), st.lists(parts, min_size=1, max_size=3), st.none()),
        st.tuples(st.just(sequence), st.lists(parts, min_size=1, max_size=3), TIMES),
    ),
    max_leaves=6,
)


def built(part):
    if isinstance(part, str):
        return part
    kind, parts, within = part
    limit = {} if within is None else {"within": within}
    return kind(*map(built, parts), **limit)


def met_from(part, events, start):
    """What the words say, spelt out over all events: the index of the one that completes it."""
    if isinstance(part, str):
        fit = (at for at in range(start, len(events)) if part in (events[at].name, "*"))
        return next(fit, None)
    kind, parts, within = part
    if within not in (None, float("inf")):
        ends = []
        for begin in range(start, len(events)):
            end = met_from((kind, parts, None), events, begin)
            if end is not None and events[end].time - events[begin].time <= within:
                ends.append(end)
        return min(ends, default=None)
    if kind is sequence:
        end = start - 1
        for each in parts:
            if (end := met_from(each, events, end + 1)) is None:
                return None
        return end
    ends = [end for each in parts if (end := met_from(each, events, start)) is not None]
    if kind is all_of and len(ends) < len(parts):
        return None
    return (max if kind is all_of else min)(ends, default=None)


@given(PARTS.filter(lambda part: not isinstance(part, str)), TEXTS)
def test_looking_at_each_event_once_finds_what_looking_at_all_finds(part, text):
    events = [Event(name, float(at)) for at, name in enumerate(text) if name != "."]
    end = met_from(part, events, 0)
    assert met(built(part), text) == (None if end is None else int(events[end].time))


def test_it_does_not_matter_how_long_ago_a_part_came():
    assert met(all_of("s", sequence("x", "e")), "s" + 5000 * "x" + "e") == 5001


def test_times_within_times_take_no_longer_the_more_events_came():
    once = sequence("a", "b", within=5)
    thrice = sequence(sequence(once, "b", within=5), "b", within=5)
    assert met(thrice, 5000 * "a" + "bbb") == 5002
