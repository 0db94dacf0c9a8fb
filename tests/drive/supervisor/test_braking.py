import math

import pytest
from hypothesis import given, strategies as st

from hri.drive.supervisor.braking import stopping_speed


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
