import math

import pytest
from hypothesis import given, strategies as st

from hri.behavior.library.stop_crash import StopCrash, StopCrashSelective
from tests.behavior.library.ticking import Links, tick

NOTHING = Links()


@pytest.mark.proves("B11", "B16")
@pytest.mark.parametrize(
    ("velocity", "readings", "sent"),
    [
        (NOTHING, NOTHING, 0),
        (None, NOTHING, 0),
        (None, [100.0], 0),
        (3.0, NOTHING, 3),
        (3.0, [None], 3),
        (3.0, [60.0], 3),
        (3.0, [59.999], 0),
        (-3.0, [59.999], 0),
        (3.0, [100.0, 20.0], 0),
        (3.0, [None, 20.0], 0),
        (3.0, [None, 100.0], 3),
        (-3.0, [100.0], -3),
        (3.0, [math.inf], 3),
        (3.0, [math.nan], 0),
        (3.0, [100.0, math.nan], 0),
        (math.nan, [100.0], 0),
        (Links([4.0, 5.0]), [100.0], 4),
        (Links([None, 5.0]), [100.0], 0),
    ],
)
def test_it_stops_in_both_directions_below_the_limit_and_only_there(velocity, readings, sent):
    stop_crash = StopCrash(stop_limit=60.0)
    result = tick(stop_crash, forward_velocity=velocity, range_sensor=Links(readings))
    assert result == {"velocity": sent}


@pytest.mark.proves("B18")
@pytest.mark.parametrize(
    ("velocity", "front", "rear", "sent"),
    [
        (3.0, 50.0, 100.0, 0),
        (-3.0, 50.0, 100.0, -3),
        (3.0, 100.0, 50.0, 3),
        (-3.0, 100.0, 50.0, 0),
        (3.0, 50.0, 50.0, 0),
        (-3.0, 50.0, 50.0, 0),
        (3.0, 60.0, None, 3),
        (-3.0, None, None, -3),
        (3.0, math.nan, 100.0, 0),
        (-3.0, math.nan, 100.0, -3),
        (-3.0, 100.0, math.nan, 0),
        (None, 100.0, 100.0, 0),
    ],
)
def test_the_selective_one_lets_the_robot_drive_away_from_an_obstacle(velocity, front, rear, sent):
    ports = {"forward_velocity": velocity, "front_sensor": front, "rear_sensor": rear}
    assert tick(StopCrashSelective(stop_limit=60.0), **ports) == {"velocity": sent}


@pytest.mark.proves("B16")
@given(
    velocity=st.floats(-100, 100),
    readings=st.lists(st.none() | st.floats(0, 200), max_size=5),
    limit=st.floats(0, 200),
)
def test_what_comes_out_is_the_velocity_or_rest_never_anything_else(velocity, readings, limit):
    ports = {"forward_velocity": velocity, "range_sensor": Links(readings)}
    sent = tick(StopCrash(stop_limit=limit), **ports)["velocity"]
    assert sent in (velocity, 0.0)
    is_near = min((r for r in readings if r is not None), default=math.inf) < limit
    assert not (is_near and sent)
