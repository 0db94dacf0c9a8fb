import itertools
import math

import pytest
from hypothesis import given, strategies as st

from hri.behavior.behavior import Behavior
from hri.behavior.device_behaviors import RangeSensorReading
from hri.behavior.library.shaping import Clamp, Deadband, RateLimit, Scale, Smooth
from hri.behavior.ports import DBL_MAX, Input
from hri.core.errors import HriError
from hri.core.signals import RangeReading
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description
from hri.testing import context, run_for
from tests.behavior.library.ticking import tick


class Recorder(Behavior):
    """Keeps what comes in."""

    input = Input[float]("double", "a number")

    def start(self, context):
        self.at = {}

    def compute(self, now, dt):
        self.at[round(now, 3)] = self.input.value


REASONABLE = st.floats(-1e6, 1e6)


@given(value=st.floats(allow_nan=False), low=REASONABLE, width=st.floats(0, 1e6))
def test_clamp_is_bounded_idempotent_and_leaves_the_rest_alone(value, low, width):
    clamp = Clamp(minimum=low, maximum=low + width)
    clamp.check()
    once = tick(clamp, input=value)["clamped"]
    assert low <= once <= low + width
    assert tick(clamp, input=once)["clamped"] == once
    if low <= value <= low + width:
        assert once == value


def test_limits_the_wrong_way_round_are_refused_before_anything_starts():
    with pytest.raises(HriError, match="minimum 2 is above maximum 1 - swap them"):
        Clamp("c", minimum=2.0).check()


def test_scale_goes_from_one_unit_to_another():
    assert tick(Scale(factor=1.8, offset=32.0), input=100.0)["scaled"] == pytest.approx(212)


@given(value=REASONABLE, other=REASONABLE, width=st.floats(0, 100))
def test_a_deadband_is_odd_rests_around_zero_and_never_jumps(value, other, width):
    def shaped(number):
        return tick(Deadband(width=width), input=number)["output"]

    assert shaped(-value) == -shaped(value)
    assert (shaped(value) == 0) == (abs(value) <= width)
    assert abs(shaped(value) - shaped(other)) <= abs(value - other) + 1e-6


@pytest.mark.parametrize("cls", [Clamp, Scale, Deadband, Smooth, RateLimit])
def test_nothing_comes_out_when_nothing_comes_in(cls):
    behavior = cls()
    assert tick(behavior) == {}
    assert tick(behavior, input=0.5)
    assert tick(behavior, now=0.1) == {}


def smoothed(steps, seconds, time_constant, begin, end):
    """The output after a jump that is followed for some seconds in so many steps."""
    smooth = Smooth(time_constant=time_constant)
    tick(smooth, now=0.0, dt=0.0, input=begin)
    for step in range(1, steps + 1):
        now = seconds * step / steps
        sent = tick(smooth, now=now, dt=seconds / steps, input=end)
    return sent["smoothed"]


@given(
    steps=st.integers(1, 40),
    seconds=st.floats(0.01, 10),
    time_constant=st.floats(0.05, 10),
    begin=REASONABLE,
    end=REASONABLE,
)
def test_smoothing_follows_the_closed_form_whatever_the_rate(
    steps, seconds, time_constant, begin, end
):
    expected = end + (begin - end) * math.exp(-seconds / time_constant)
    sent = smoothed(steps, seconds, time_constant, begin, end)
    assert sent == pytest.approx(expected, rel=1e-6, abs=1e-6 * (1 + abs(begin) + abs(end)))


@given(st.lists(st.tuples(REASONABLE, st.floats(0.001, 1)), min_size=1))
def test_smoothing_stays_between_the_extremes_that_came_in(values):
    smooth, now, seen = Smooth(time_constant=0.3), 0.0, []
    for value, dt in values:
        now += dt
        seen.append(value)
        sent = tick(smooth, now=now, dt=dt, input=value)["smoothed"]
        assert min(seen) - 1e-6 <= sent <= max(seen) + 1e-6


def test_smoothing_counts_the_time_in_which_nothing_came():
    smooth = Smooth(time_constant=1.0)
    tick(smooth, now=0.0, input=0.0)
    tick(smooth, now=0.5)
    assert tick(smooth, now=1.0, input=1.0)["smoothed"] == pytest.approx(1 - math.exp(-1))


def test_what_is_not_finite_passes_and_smoothing_begins_anew():
    smooth = Smooth(time_constant=1.0)
    tick(smooth, now=0.0, input=5.0)
    assert tick(smooth, now=0.1, input=math.inf) == {"smoothed": math.inf}
    assert tick(smooth, now=0.2, input=7.0) == {"smoothed": 7.0}


SHAPING = [
    *(Clamp(), Deadband(), RateLimit(rising=math.inf), Smooth()),
    *(Scale(factor=0.0), Scale(factor=-1e308, offset=math.inf)),
]


@given(st.lists(st.tuples(st.none() | st.floats(), st.floats(0, 1)), min_size=1))
def test_what_is_no_number_is_never_sent(ticks):
    for behavior in SHAPING:
        now = 0.0
        for value, dt in ticks:
            now += dt
            for sent in tick(behavior, now=now, dt=dt, input=value).values():
                assert not math.isnan(sent)


def test_smooth_stays_between_what_came_when_the_clock_is_set_back():
    smooth = Smooth()
    tick(smooth, now=1000.0, input=1.0)
    assert tick(smooth, now=0.0, input=3.0)["smoothed"] == 1.0
    assert 1.0 < tick(smooth, now=0.5, input=3.0)["smoothed"] < 3.0


@pytest.mark.parametrize("cls", [Clamp, Scale, Deadband, Smooth, RateLimit])
def test_what_is_no_number_counts_as_nothing(cls):
    behavior = cls()
    assert tick(behavior, input=math.nan) == {}
    assert tick(behavior, input=0.5)


@pytest.mark.parametrize("far", [DBL_MAX, -DBL_MAX, math.inf, -math.inf])
@pytest.mark.parametrize("cls", [Smooth, RateLimit])
def test_what_stands_for_infinity_passes_and_shaping_begins_anew(cls, far):
    shaping = cls()
    (port,) = shaping.outputs
    assert tick(shaping, now=0.0, input=20.0) == {port: 20.0}
    assert tick(shaping, now=0.1, input=far) == {port: far}
    assert tick(shaping, now=0.2, input=30.0) == {port: 30.0}


class Approach(RangeSensor):
    """Sees nothing in range for a second, then something 20 cm away."""

    def read(self, now):
        return RangeReading(self.id, math.inf if now < 1.0 else 0.2, now)


@pytest.mark.parametrize("cls", [Smooth, RateLimit])
@pytest.mark.parametrize("factor", [1.0, 0.01])
def test_shaping_hides_no_obstacle_that_comes_into_range(cls, factor):
    lent = context()
    lent.resources.substitute("range", Approach(Description("range", "Test.Range"), lent.resources))
    sensor, scale, shaping, seen = RangeSensorReading(), Scale(factor=factor), cls(), Recorder()
    scale.input.sources.append(sensor.distance)
    shaping.input.sources.append(scale.scaled)
    seen.input.sources.append(getattr(shaping, *shaping.outputs))
    run_for(1.2, [sensor, scale, shaping, seen], lent)
    assert seen.at[0.5] >= DBL_MAX
    assert seen.at[1.0] == pytest.approx(20.0 * factor)


def test_a_time_constant_of_zero_smooths_nothing():
    smooth = Smooth(time_constant=0.0)
    tick(smooth, now=0.0, input=1.0)
    assert tick(smooth, now=0.0, dt=0.0, input=9.0) == {"smoothed": 9.0}


@given(
    values=st.lists(REASONABLE, min_size=2),
    rising=st.floats(0, 100),
    falling=st.floats(0, 100),
    dt=st.floats(0.001, 1),
)
def test_a_rate_limit_holds_between_any_two_ticks(values, rising, falling, dt):
    limit = RateLimit(rising=rising, falling=falling)
    sent = [tick(limit, dt=dt, input=value)["limited"] for value in values]
    assert sent[0] == values[0]
    for before, after in itertools.pairwise(sent):
        assert -falling * dt - 1e-6 <= after - before <= rising * dt + 1e-6


def test_a_rate_limit_arrives_and_begins_anew_after_a_gap():
    limit = RateLimit(rising=1.0, falling=2.0)
    sent = [tick(limit, dt=0.5, input=value)["limited"] for value in (0.0, 1.0, 1.0, 1.0, -1.0)]
    assert sent == [0.0, 0.5, 1.0, 1.0, 0.0]
    tick(limit)
    assert tick(limit, input=50.0) == {"limited": 50.0}
