"""The speed from which a base can still stop."""

import math

import pytest
from hypothesis import given, strategies as st

from hri.drive.velocity_limits import PRUDENCE, REACTION, safe_speed


@given(st.floats(0, 10), st.floats(0.1, 3))
def test_it_can_always_stop_before_the_clearance(free, deceleration) -> None:
    speed = safe_speed(free, 0.1, deceleration, is_moving=True)
    way = speed * REACTION + speed**2 / (2 * deceleration * PRUDENCE)
    assert way <= max(0.0, free - 0.1) + 1e-9


def test_a_resting_base_does_not_creep_before_an_obstacle() -> None:
    assert safe_speed(0.13, 0.1, 1.0, is_moving=True) > 0
    assert safe_speed(0.13, 0.1, 1.0, is_moving=False) == 0.0
    assert safe_speed(math.nan, 0.1, 1.0, is_moving=False) == 0.0


def test_without_a_reaction_the_free_way_gives_the_speed_of_even_braking() -> None:
    speed = safe_speed(0.5, 0.25, 0.5, is_moving=True, reaction=0.0)
    assert speed == pytest.approx(math.sqrt(2 * 0.5 * PRUDENCE * 0.25))
    assert safe_speed(math.inf, 0.25, 0.5, is_moving=False) == math.inf
    assert safe_speed(0.25, 0.25, 0.5, is_moving=True) == 0.0
