import math

import pytest
from hypothesis import given, strategies as st

from hri.behavior.behavior import Behavior
from hri.behavior.library.constant import Constant
from hri.behavior.network import Network
from hri.behavior.ports import Output
from hri.core.errors import AuthoringError, HriError
from hri.core.signals import RangeReading
from hri.task.thresholds import Edge, Threshold, parse_threshold, raising
from tests.task.stage import Stage

pytestmark = pytest.mark.proves("T19")


class Approach(Behavior):
    """Comes nearer by ten a second from a hundred, and begins anew at zero."""

    distance = Output[float]("double", "the distance")
    reading = Output[RangeReading]("range", "the same in meters")
    name = Output[str]("string", "a text")

    def compute(self, now: float, dt: float) -> None:
        distance = 100 - 10 * (round(now, 3) % 10)
        self.distance.send(distance)
        self.reading.send(RangeReading("front", distance / 100, now))
        self.name.send("front")


def events_of(text, seconds=15.0, network="sensors"):
    stage = Stage()

    async def main(context):
        context.networks.start(Network(network, 0.1, [Approach("front")]))
        with raising(context, text, "person.near"):
            await context.clock.sleep(seconds)

    stage.run(main)
    return [
        (round(event.time, 3), round(event.properties["value"], 3))
        for event in stage.events
        if event.name == "person.near"
    ]


def test_an_event_at_the_rising_edge():
    assert events_of("front.distance < 30") == [(7.1, 29.0)]
    assert events_of("front.distance < 30", 30.0) == [(7.1, 29.0), (17.1, 29.0), (27.1, 29.0)]


def test_only_when_it_has_held_for_so_long():
    assert events_of("sensors:front.distance < 30 for 0.5 s") == [(7.6, 24.0)]
    assert events_of("front.distance < 30 for 2900 ms", 9.95) == []


def test_fields_of_a_value():
    assert events_of("front.reading.distance<=0.5") == [(5.0, 0.5)]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", '-:1:1: "" is not a port - write behavior.port'),
        ("front < 3", '-:1:1: "front < 3" is not a port'),
        ("front.distance = 3", '-:1:15: "= 3" is not a comparison'),
        ("front.distance < far", '-:1:17: "far" is not a number - write such as 30'),
        ("front.distance < 3m", "is not a number"),
        ("front.distance < 3 for", '-:1:19: "for" is not understood - write such as'),
        ("front.distance < 3 for 2 parsecs", 'unknown unit of time "parsecs"'),
        ("front.distance < 3 and more", "is not understood"),
        ("f.d < " + "1" * 600, "606 characters"),
    ],
)
def test_mistakes_are_told_with_their_place(text, message):
    with pytest.raises(AuthoringError) as error:
        parse_threshold(text)
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("frnt.distance < 3", 'no behavior "frnt" runs - did you mean "front"'),
        ("front.distanc < 3", 'no output "distanc" - did you mean "distance"'),
        ("sensor:front.distance < 3", 'no network "sensor" runs - did you mean "sensors"'),
    ],
)
def test_what_does_not_run_is_told(text, message):
    with pytest.raises(HriError) as error:
        events_of(text, 0.5)
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a.b.distanc < 3", "did you mean"),
        ("a.b < 3", "compare a number"),
        ("a.b.sensor < 3", "str"),
    ],
)
def test_what_cannot_be_compared_is_told(text, message):
    with pytest.raises(HriError, match=message):
        parse_threshold(text).holds(RangeReading("x", 1.0, 0.0))


@given(st.lists(st.booleans(), max_size=50), st.integers(0, 5))
def test_an_edge_comes_once_a_run_that_is_long_enough(values, hold):
    edge = Edge(float(hold))
    told = [edge.update(value, float(now)) for now, value in enumerate(values)]
    runs, length = [], 0
    for value in [*values, False]:
        if value:
            length += 1
        elif length:
            runs.append(length)
            length = 0
    assert sum(told) == sum(run > hold for run in runs)


@given(
    st.sampled_from(["<", "<=", ">", ">=", "==", "!="]),
    st.floats(-1e9, 1e9),
    st.floats(0, 1e4),
)
def test_what_is_written_is_read(sign, limit, seconds):
    read = parse_threshold(f"n:a.b.c {sign} {limit!r} for {seconds!r} s")
    assert read == Threshold("n", "a", "b", "c", sign, limit, seconds)
    assert not math.isnan(read.limit)


@given(st.text(max_size=80))
def test_any_text_is_read_or_told(text):
    told = ""
    try:
        parse_threshold(text)
    except AuthoringError as error:
        told = str(error)
    assert len(told) < 200


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("front.name < 3", "front.name sends a str - compare a number of it"),
        ("front.reading < 3", "front.reading sends a RangeReading - compare a number of it"),
        ("front.reading.sensor < 3", "front.reading sends a str"),
        ("front.reading.distanc < 3", 'no field "distanc" - did you mean "distance"'),
        ("front.distance.distance < 3", 'no field "distance"'),
        ("said.value < 3", "said.value sends a str"),
    ],
)
def test_what_a_port_declares_is_looked_at_before_it_is_watched(text, message, caplog):
    stage = Stage()

    async def main(context):
        behaviors = [Approach("front"), Constant("said", parsed_value="hello")]
        context.networks.start(Network("sensors", 0.1, behaviors))
        with pytest.raises(HriError, match=message), raising(context, text, "person.near"):
            await context.clock.sleep(1.0)
        assert context.clock.now() == 0
        await context.clock.sleep(1.0)

    stage.run(main)
    assert not caplog.records


def test_a_field_that_may_be_none_is_compared_when_it_is_a_number():
    async def main(context):
        context.networks.start(Network("sensors", 0.1, [Approach("front")]))
        with raising(context, "front.reading.raw < 3", "person.near"):
            await context.clock.sleep(1.0)

    Stage().run(main)


def test_a_swap_that_ends_a_watch_is_told(caplog):
    stage = Stage()

    async def main(context):
        networks = context.networks
        networks.start(Network("sensors", 0.1, [Approach("front")]))
        with raising(context, "front.distance < 30", "person.near"):
            networks.swap("sensors", Network("sensors", 0.1, [Approach("front")]))
            await context.clock.sleep(9.0)

    stage.run(main)
    assert "person.near" not in stage.names()
    assert "sensors was swapped, and those who watched it see no more" in caplog.text
