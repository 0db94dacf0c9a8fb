import math
from itertools import pairwise

import pytest
from hypothesis import given, strategies as st

from hri.core.geometry import along_arc
from hri.core.signals import Pose2D
from hri.drive.bases.create2 import METERS_PER_COUNT, TRACK
from hri.drive.bases.odometer import Encoders, Odometer

ENCODERS = Encoders(METERS_PER_COUNT, TRACK, 16, 0.5)
PERIOD = 0.015
steps = st.lists(st.tuples(st.integers(-20, 20), st.integers(-20, 20)), max_size=60)


@given(st.integers(0, 65_535), st.integers(0, 65_535), steps)
def test_ways_add_up_wherever_the_counters_run_over(left, right, ways):
    odometer = Odometer(ENCODERS)
    odometer.add(left, right, 0.0)
    for index, (more_left, more_right) in enumerate(ways, 1):
        left, right = left + more_left, right + more_right
        odometer.add(left & 0xFFFF, right & 0xFFFF, index * PERIOD)
    lefts, rights = sum(a for a, _ in ways), sum(b for _, b in ways)
    rolled = odometer.rolled
    assert rolled.linear == pytest.approx((lefts + rights) / 2 * METERS_PER_COUNT)
    assert rolled.angular == pytest.approx((rights - lefts) * METERS_PER_COUNT / TRACK)


@given(st.lists(st.tuples(st.integers(), st.integers(), st.floats(0, 1e6)), max_size=20))
def test_it_never_leaps_farther_than_wheels_can_roll(readings):
    odometer = Odometer(ENCODERS)
    before, last = 0.0, 0.0
    for left, right, now in readings:
        odometer.add(left, right, now)
        most = 0.75 * (max(0.0, now - last) + 0.1)
        assert abs(odometer.rolled.linear - before) <= most * 1.0001
        before, last = odometer.rolled.linear, now


times = st.one_of(st.floats(0, 1e6), st.sampled_from([0.0, PERIOD, 0.1, 1.0]))
counts = st.one_of(st.integers(-300, 300), st.integers(0, 65_535), st.integers())


@given(st.lists(st.tuples(counts, counts, times, st.booleans()), max_size=30))
def test_whatever_counts_come_nothing_moves_faster_than_wheels_can(readings):
    """Times are steps, a few of them back."""
    odometer, now, fastest = Odometer(ENCODERS), 0.0, 1.5 * 0.5 * 1.0001
    before = odometer.rolled
    for left, right, step, is_back in readings:
        now += -step if is_back else step
        odometer.add(left, right, now)
        rolled, way = odometer.rolled, 0.0 if is_back else fastest * step + 1e-6
        linear, aside = rolled.linear - before.linear, (rolled.angular - before.angular) * TRACK / 2
        assert max(abs(linear - aside), abs(linear + aside)) <= way + 1e-9 * abs(rolled.linear)
        before = rolled
        if odometer.velocity is not None and step >= 1e-3:
            linear, aside = odometer.velocity.linear, odometer.velocity.angular * TRACK / 2
            assert max(abs(linear - aside), abs(linear + aside)) <= 1.01 * fastest


@pytest.mark.parametrize("counts", [200, 480, 1000, 20_000, 65_000])
@pytest.mark.parametrize("pause", [0.02, 0.35, 0.5, 2.0, 10.0])
@pytest.mark.parametrize("after", [0, 3])
def test_counters_that_restart_move_nothing(counts, pause, after):
    odometer, now = Odometer(Encoders(0.000142, 0.2, 32, 0.4)), 0.0
    for index in range(counts // 20 + 1):
        now = 0.01 * index
        odometer.add(20 * index, 20 * index, now)
    for _ in range(5):
        now += 0.01
        odometer.add(counts, counts, now)
    before = odometer.rolled.linear
    for index in range(40):
        odometer.add(after + 10 * index, after + 10 * index, now + pause + 0.01 * index)
        velocity = odometer.velocity
        assert velocity is None or 0.0 <= velocity.linear < 0.3
    assert odometer.rolled.linear - before == pytest.approx(390 * 0.000142, abs=0.001)


def test_wheels_that_roll_back_over_zero_are_followed():
    odometer = Odometer(ENCODERS)
    for index in range(60):
        odometer.add(300 - 10 * index, 300 - 10 * index, index * PERIOD)
    assert odometer.rolled.linear == pytest.approx(-590 * METERS_PER_COUNT)


def test_a_number_that_was_damaged_on_the_way_is_made_up_for():
    odometer, ways = Odometer(ENCODERS), []
    for index in range(100):
        count = 245 if index == 50 else 100 + 5 * index
        odometer.add(count, count, index * PERIOD)
        ways.append(odometer.rolled.linear)
    assert min(b - a for a, b in pairwise(ways)) > -0.012
    assert odometer.rolled.linear == pytest.approx(495 * METERS_PER_COUNT)


def test_velocity_is_measured_over_a_tenth_of_a_second():
    odometer = Odometer(ENCODERS)
    assert odometer.velocity is None
    for index in range(40):
        odometer.add(index * 10, index * 10, index * PERIOD)
    assert odometer.velocity.linear == pytest.approx(10 * METERS_PER_COUNT / PERIOD)
    for index in range(40, 50):
        odometer.add(390, 390, index * PERIOD)
    assert odometer.velocity.linear == 0.0


def test_reports_that_come_in_one_burst_do_not_upset_the_velocity():
    odometer = Odometer(ENCODERS)
    for index in range(60):
        late = (index // 4) * 4 * PERIOD
        odometer.add(index * 10, index * 10, late)
    assert odometer.velocity.linear == pytest.approx(10 * METERS_PER_COUNT / PERIOD, rel=0.5)


def test_twenty_meters_of_arcs_end_where_they_should():
    """Against the closed form of a circle; counts are whole numbers."""
    radius, speed = 1.0, 0.4
    odometer, pose = Odometer(ENCODERS), Pose2D()
    before = odometer.rolled
    for index in range(round(20 / speed / PERIOD) + 1):
        way = speed * index * PERIOD
        rims = (way * (1 - TRACK / 2 / radius), way * (1 + TRACK / 2 / radius))
        odometer.add(*(int(rim / METERS_PER_COUNT) & 0xFFFF for rim in rims), index * PERIOD)
        rolled = odometer.rolled
        pose = along_arc(pose, rolled.linear - before.linear, rolled.angular - before.angular)
        before = rolled
    angle = 20 / radius
    end = radius * math.sin(angle), radius * (1 - math.cos(angle))
    assert math.dist((pose.x, pose.y), end) < 0.01 * 20
    assert pose.heading == pytest.approx(angle, rel=0.01)
