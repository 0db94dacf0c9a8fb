import pytest
from hypothesis import given, strategies as st

from hri.hal.wheels import WheelPair

small = st.floats(-2, 2)


@pytest.mark.proves("H06")
@given(st.floats(0.05, 0.5), st.floats(-0.5, -0.05), small, small)
def test_wheels_and_base_undo_each_other(
    left: float, right: float, linear: float, angular: float
) -> None:
    pair = WheelPair(left, right)
    for wheels in (pair, WheelPair(right, left)):
        base = wheels.base(*wheels.rolling(linear, angular))
        assert (base.linear, base.angular) == pytest.approx((linear, angular), abs=1e-9)


def test_turning_left_rolls_the_left_wheel_back() -> None:
    left, right = WheelPair(0.19, -0.19).rolling(0.0, 1.0)
    assert (left, right) == pytest.approx((-0.19, 0.19))
