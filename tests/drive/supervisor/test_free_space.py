import math

import pytest

from hri.core.signals import Pose2D
from hri.drive.supervisor.free_space import Body, room

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
    assert room({"front": math.inf}, FRONT, BODY).ahead == math.inf
