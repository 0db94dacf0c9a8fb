"""Which values came from other programs is told, within limits."""

import pytest

from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.net.receipts import A_SECOND, AT_ONCE, LONGEST, RECEIVED, Receipts

TICK = 0.05


@pytest.fixture
def told():
    """What is told of the values of some ticks."""
    bus, heard = EventBus(FakeClock()), []
    bus.subscribe("*", heard.append)
    receipts = Receipts("tag", bus)

    def told(*ticks):
        del heard[:]
        for values in ticks:
            receipts.take(values, TICK)
        assert {(event.name, event.origin) for event in heard} <= {(RECEIVED, "bridge")}
        return [(event.properties["port"], event.properties["value"]) for event in heard]

    return told


def test_a_value_is_told_when_it_comes_and_again_when_it_is_another_or_sent_again(told):
    one, two = {"text": "hello"}, {"text": "go", "speed": 2.0}
    assert told(one, one, two, two, {}, one) == [
        ("tag.text", "hello"),
        ("tag.text", "go"),
        ("tag.speed", 2.0),
        ("tag.text", "hello"),
    ]


def test_a_stream_of_values_does_not_fill_a_recording_and_its_last_value_is_told(told):
    seconds = 60
    count = round(seconds / TICK)
    values = told(*({"speed": float(number)} for number in range(count)))
    assert len(values) == pytest.approx(AT_ONCE + seconds * A_SECOND, abs=2)
    last = {"speed": -1.0}
    assert told(*[last] * 20) == [("tag.speed", -1.0)]


def test_what_is_long_is_cut(told):
    texts = told({"text": "x" * 9999, "scan": (1.0,) * 9999})
    assert [len(value) for _, value in texts] == [LONGEST, LONGEST]
