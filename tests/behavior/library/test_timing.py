import pytest
from hypothesis import given, strategies as st

from hri.behavior.library.timing import Counter, Delay, Latch, Threshold, Timer
from hri.core.errors import HriError
from tests.behavior.library.ticking import Links, tick

TICKS = st.lists(st.none() | st.integers(0, 9), max_size=30)


@given(values=TICKS, lag=st.integers(0, 8))
def test_a_delay_sends_the_same_later_gaps_included(values, lag):
    delay = Delay(delay_s=lag * 0.1)
    sent = [tick(delay, now=k * 0.1, input=v).get("delayed") for k, v in enumerate(values)]
    assert sent == ([None] * lag + values)[: len(values)]


def test_of_values_that_are_due_at_once_the_newest_counts():
    delay = Delay(delay_s=0.1)
    for k in range(4):
        assert tick(delay, now=k * 0.01, input=k) == {}
    assert tick(delay, now=0.5) == {"delayed": 3}
    assert tick(delay, now=0.6) == {}


def test_a_latch_keeps_the_last_value_until_it_is_reset():
    latch = Latch()
    assert tick(latch) == {}
    assert tick(latch, input=0.0) == {"latched": 0.0}
    assert tick(latch) == {"latched": 0.0}
    assert tick(latch, input="new", reset=False) == {"latched": "new"}
    assert tick(latch, input="lost", reset=True) == {}
    assert tick(latch) == {}


def test_a_threshold_does_not_flicker_between_its_limits():
    threshold = Threshold(upper=1.0, lower=0.5)
    values = [0.7, 0.99, 1.0, 0.7, 0.51, 0.5, 0.7, 1.2]
    sent = [tick(threshold, input=value)["is_high"] for value in values]
    assert sent == [False, False, True, True, True, False, False, True]
    assert tick(threshold) == {}
    assert tick(threshold, input=0.7) == {"is_high": True}


@given(st.lists(st.floats(0, 2), max_size=30))
def test_beyond_its_limits_a_threshold_depends_on_the_number_alone(values):
    threshold = Threshold(upper=1.0, lower=0.5)
    for value in values:
        is_high = tick(threshold, input=value)["is_high"]
        assert is_high or value < 1.0
        assert not is_high or value > 0.5


def test_threshold_limits_the_wrong_way_round_are_refused():
    with pytest.raises(HriError, match="swap them"):
        Threshold(upper=0.0, lower=1.0).check()


@given(st.lists(st.none() | st.booleans(), max_size=30))
def test_a_counter_counts_how_often_its_input_becomes_true(truths):
    counter, expected, before = Counter(), 0, False
    for truth in truths:
        expected += bool(truth) and not before
        before = bool(truth)
        assert tick(counter, input=truth) == {"count": expected}


def test_a_counter_takes_any_link_and_begins_again_after_a_reset():
    counter = Counter()
    assert tick(counter, input=Links([None, False, True])) == {"count": 1.0}
    assert tick(counter, input=False, reset=True) == {"count": 0.0}
    assert tick(counter, input=True) == {"count": 1.0}


@pytest.mark.parametrize("interval", [0.01, 0.1, 0.25])
def test_a_timer_tells_the_same_whatever_the_rate(interval):
    timer = Timer(duration=1.0)
    over = [
        step
        for step in range(round(2 / interval) + 1)
        if tick(timer, now=step * interval, input=True)["is_over"]
    ]
    assert over[0] * interval == pytest.approx(1.0)
    assert tick(timer, now=2.0, input=True)["elapsed"] == pytest.approx(2.0)


def test_a_timer_begins_again_after_each_break():
    timer = Timer(duration=0.2)
    assert tick(timer, now=0.0, input=True) == {"elapsed": 0.0, "is_over": False}
    assert tick(timer, now=0.2, input=True) == {"elapsed": 0.2, "is_over": True}
    assert tick(timer, now=0.3) == {"elapsed": 0.0, "is_over": False}
    assert tick(timer, now=0.4, input=True)["elapsed"] == 0.0
