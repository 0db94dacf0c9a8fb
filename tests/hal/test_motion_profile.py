"""Profiles against the closed form of a trapezoid, and braking against the way that it takes."""

import itertools
import math

import pytest
from hypothesis import given, settings, strategies as st

from hri.hal.motion_profile import Trapezoid, stopping_speed, toward, velocity_for

pytestmark = pytest.mark.proves("H25")

ways = st.floats(-10, 10).filter(lambda way: abs(way) > 1e-3)
positive = st.floats(0.01, 3)
profiles = st.builds(Trapezoid, ways, positive, positive)


def test_a_trapezoid() -> None:
    profile = Trapezoid(0.5, 0.2, 0.4)  # the guide's half meter
    assert profile.duration == pytest.approx(0.2 / 0.4 + 0.5 / 0.2)
    assert profile.position(0.5) == pytest.approx(0.2**2 / 2 / 0.4)
    assert profile.position(1.5) == pytest.approx(0.05 + 0.2)
    assert profile.position(3.0) == 0.5


def test_a_triangle() -> None:
    profile = Trapezoid(-0.1, 1.0, 0.4)
    assert profile.peak == pytest.approx(math.sqrt(0.4 * 0.1))
    assert profile.duration == pytest.approx(2 * math.sqrt(0.1 / 0.4))
    assert profile.position(profile.duration / 2) == pytest.approx(-0.05)


def test_no_way_takes_no_time() -> None:
    assert Trapezoid(0.0, 0.2, 0.4).duration == 0
    assert Trapezoid(0.0, 0.2, 0.4).position(1.0) == 0
    assert Trapezoid(5e-324, 0.2, 0.4).duration == 0  # its root is none


@given(profiles)
def test_it_begins_at_rest_ends_at_the_goal_and_is_symmetric(profile: Trapezoid) -> None:
    end = profile.duration
    assert profile.position(-1.0) == 0
    assert profile.position(end) == profile.position(end + 9) == profile.distance
    for part in (0.1, 0.3, 0.45):
        there, back = profile.position(part * end), profile.position((1 - part) * end)
        assert there + back == pytest.approx(profile.distance, abs=1e-9)


@given(profiles, st.floats(0, 1), st.floats(0.001, 0.1))
def test_it_never_exceeds_velocity_or_acceleration(
    profile: Trapezoid, part: float, dt: float
) -> None:
    time = part * profile.duration
    before, now, after = (profile.position(time + step * dt) for step in (-1, 0, 1))
    assert abs(after - now) <= profile.velocity * dt + 1e-9
    assert abs(after - 2 * now + before) <= profile.acceleration * dt**2 + 1e-9


@given(st.floats(-9, 9), st.floats(-9, 9), st.floats(0, 5))
def test_a_step_never_passes_the_goal(value: float, goal: float, change: float) -> None:
    stepped = toward(value, goal, change)
    assert min(value, goal) <= stepped <= max(value, goal)
    assert abs(stepped - value) <= change + 1e-9


@settings(deadline=None)
@given(
    goal=st.floats(-20, 20),
    max_velocity=st.floats(0.05, 1.0),
    deceleration=st.floats(0.1, 2.0),
)
def test_it_arrives_without_going_too_far(
    goal: float, max_velocity: float, deceleration: float
) -> None:
    dt, position, ticks = 0.05, 0.0, 0
    while abs(goal - position) > 0.005:
        velocity = velocity_for(goal - position, max_velocity, deceleration, dt)
        assert abs(velocity) <= max_velocity
        position += velocity * dt
        ticks += 1
    assert abs(position) <= abs(goal) + 1e-9
    ideal = abs(goal) / max_velocity + max_velocity / deceleration
    assert ticks * dt <= ideal + 1.0


def test_it_slows_down_evenly() -> None:
    dt, position, passed = 0.01, 0.0, []
    for _ in range(1000):
        passed.append(velocity_for(2.0 - position, 0.4, 0.5, dt))
        position += passed[-1] * dt
    steps = [before - after for before, after in itertools.pairwise(passed)]
    assert max(steps) == pytest.approx(0.5 * dt, rel=0.02)


def test_it_goes_where_the_goal_is() -> None:
    assert velocity_for(-3.0, 0.3, 0.5, 0.05) == -0.3
    assert velocity_for(0.0, 0.3, 0.5, 0.05) == 0.0
    assert math.isnan(velocity_for(math.nan, 0.3, 0.5, 0.05))


@given(st.floats(0.0, 2.0), st.floats(0.0, 0.3), st.floats(0.3, 3.0), st.floats(0.0, 1.5))
def test_from_the_stopping_speed_it_stands_before_anybody_is_there_and_no_sooner(
    gap: float, reaction: float, deceleration: float, approach: float
) -> None:
    speed = stopping_speed(gap, reaction, deceleration, approach)
    time = reaction + speed / deceleration
    way = speed * reaction + speed**2 / (2 * deceleration)
    if speed > 0.0:
        assert approach * time + way == pytest.approx(gap)
    else:
        assert approach * reaction >= gap - 1e-9


def test_nothing_to_stop_for_is_no_limit_and_an_unknown_gap_is_a_stop() -> None:
    assert stopping_speed(math.inf, 0.1, 1.0) == math.inf
    assert stopping_speed(math.nan, 0.1, 1.0) == 0.0
