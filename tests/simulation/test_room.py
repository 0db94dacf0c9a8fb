import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.simulation.room import Box, Circle, Room, Wall

WALL_AHEAD = Wall(2.0, -5.0, 2.0, 5.0)


@pytest.mark.parametrize("angle", [0.0, 0.3, -0.7, 1.1])
def test_a_ray_meets_a_wall_where_trigonometry_says(angle: float) -> None:
    assert Room([WALL_AHEAD]).cast(0, 0, angle) == pytest.approx(2.0 / math.cos(angle))


def test_a_ray_away_from_or_beside_or_along_a_wall_never_meets_it() -> None:
    assert Room([WALL_AHEAD]).cast(0, 0, [math.pi, math.pi / 2, 1.5]).tolist() == [math.inf] * 3


def test_a_ray_meets_the_near_side_of_a_circle() -> None:
    room = Room([Circle(3.0, 0.5, 1.0)])
    assert room.cast(0, 0, 0.0) == pytest.approx(3.0 - math.sqrt(1 - 0.25))
    assert room.cast(0, 0, [0.8, math.pi]).tolist() == [math.inf, math.inf]
    assert room.cast(3.0, 0.6, 0.0) == 0.0


def test_the_nearest_of_many_things_counts() -> None:
    room = Room([WALL_AHEAD, Circle(1.5, 0.0, 0.2), Box(0.0, 3.0, 2.0, 2.0)])
    assert room.cast(0, 0, [0.0, math.pi / 2]) == pytest.approx([1.3, 2.0])


def test_a_turned_box_is_met_at_its_corner() -> None:
    room = Room([Box(3.0, 0.0, 1.0, 1.0, heading=math.pi / 4)])
    assert room.cast(0, 0, 0.0) == pytest.approx(3.0 - math.sqrt(0.5))
    assert room.clearance(0, 0) == pytest.approx(3.0 - math.sqrt(0.5))


def test_a_room_with_more_in_it_is_the_same_as_one_made_of_all() -> None:
    things, more = [WALL_AHEAD, Circle(1.5, 0.0, 0.2), Box(0.0, 3.0, 2.0, 2.0)], Circle(1, 1, 0.22)
    at_once, later = Room([*things, more]), Room(things).with_more([more])
    angles = np.linspace(-3.0, 3.0, 200)
    assert later.obstacles == at_once.obstacles
    assert later.cast(0.1, 0.2, angles).tolist() == at_once.cast(0.1, 0.2, angles).tolist()
    assert later.clearance(0.7, 0.6) == at_once.clearance(0.7, 0.6)


def test_an_empty_room_has_no_end() -> None:
    assert Room().clearance(0, 0) == math.inf
    assert Room().cast(0, 0, [0.0, 1.0]).tolist() == [math.inf, math.inf]


coordinates = st.floats(-5, 5)


@given(coordinates, coordinates, st.floats(-math.pi, math.pi))
def test_no_ray_ends_nearer_than_the_clearance(x: float, y: float, angle: float) -> None:
    room = Room([Circle(20, 1, 2), Box(-9, 3, 4, 1, 0.3), Wall(-8, -7, 8, -7)])
    assert room.cast(x, y, angle) >= room.clearance(x, y) - 1e-9
