"""Profiles against the closed form of a trapezoid."""

import math

import pytest
from hypothesis import given, strategies as st

from hri.hal.profile import Trapezoid, toward

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
