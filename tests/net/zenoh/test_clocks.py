"""What time it is on another machine."""

import math

import pytest
from hypothesis import given, strategies as st

from hri.net.zenoh.clocks import OtherClock, RoundTrip


def test_the_shortest_round_trip_counts():
    clock = OtherClock()
    clock.take(RoundTrip(10.0, 11.0, 500.9))
    clock.take(RoundTrip(20.0, 20.002, 510.001))
    assert clock.ours(510.001) == pytest.approx(20.001)
    assert clock.uncertainty == pytest.approx(0.001)


def test_before_a_round_trip_nothing_is_known():
    assert math.isinf(OtherClock().uncertainty)
    with pytest.raises(ValueError, match="no round trip"):
        OtherClock().ours(1.0)


@given(
    st.floats(-1e6, 1e6),
    st.lists(st.tuples(st.floats(0, 1), st.floats(0, 1)), min_size=1, max_size=20),
)
def test_it_is_never_wrong_by_more_than_it_says(offset, ways):
    clock = OtherClock()
    for number, (there, back) in enumerate(ways):
        asked = 10.0 * number
        clock.take(RoundTrip(asked, asked + there + back, asked + there + offset))
    error = abs(clock.ours(1000.0 + offset) - 1000.0)
    assert error <= clock.uncertainty + 1e-6
