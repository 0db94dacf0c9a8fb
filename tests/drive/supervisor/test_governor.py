import math

import pytest
from hypothesis import given, strategies as st

from hri.core.signals import Pose2D
from hri.drive.supervisor.governor import PRUDENCE, REACTION, Body, room, safe_speed

FRONT = {"front": Pose2D(0.17, 0.0, 0.0)}
BODY = Body()


def test_what_is_ahead_counts_from_the_body() -> None:
    assert room({"front": 0.4}, FRONT, BODY).ahead == pytest.approx(0.4)
    assert room({"front": 0.4}, FRONT, BODY).behind == math.inf


def test_what_lies_beside_the_way_does_not_matter() -> None:
    aside = {"left": Pose2D(0.1, 0.1, math.pi / 4)}
    assert room({"left": 0.5}, aside, BODY).ahead == math.inf
    assert room({"left": 0.1}, aside, BODY).ahead == pytest.approx(0.1 + 0.0707 - 0.17, abs=0.001)


def test_what_is_behind_bounds_the_way_back() -> None:
    back = {"back": Pose2D(-0.17, 0.0, math.pi)}
    assert room({"back": 0.3}, back, BODY).behind == pytest.approx(0.3)


@pytest.mark.parametrize("reading", [{}, {"front": math.nan}, {"front": -1.0}])
def test_a_sensor_without_a_believable_reading_frees_nothing(reading) -> None:
    assert room(reading, FRONT, BODY).ahead == 0.0
    assert room({"front": math.inf}, FRONT, BODY, {"front"}).ahead == 0.0


def test_nothing_in_range_frees_the_way() -> None:
    assert safe_speed(room({"front": math.inf}, FRONT, BODY).ahead, 0.1, 1.0, True) == math.inf


@given(st.floats(0, 10), st.floats(0.1, 3))
def test_it_can_always_stop_before_the_clearance(free, deceleration) -> None:
    speed = safe_speed(free, 0.1, deceleration, is_moving=True)
    way = speed * REACTION + speed**2 / (2 * deceleration * PRUDENCE)
    assert way <= max(0.0, free - 0.1) + 1e-9


def test_a_resting_base_does_not_creep_before_an_obstacle() -> None:
    assert safe_speed(0.13, 0.1, 1.0, is_moving=True) > 0
    assert safe_speed(0.13, 0.1, 1.0, is_moving=False) == 0.0
    assert safe_speed(math.nan, 0.1, 1.0, is_moving=False) == 0.0
