import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Pose2D
from hri.drive.path_planner import find_route, narrow_way

REACH = 0.3
EMPTY = np.zeros((0, 2))


def wall(x: float, start: float, end: float) -> np.ndarray:
    """Points across the way."""
    return np.array([[x, y] for y in np.arange(start, end, 0.05)])


def nearest(points: tuple[tuple[float, float], ...], obstacles: np.ndarray) -> float:
    return min(float(np.hypot(*(obstacles - np.array(point)).T).min()) for point in points)


def test_with_nothing_in_the_way_it_is_straight() -> None:
    route = find_route((0.0, 0.0), (3.0, 0.0), EMPTY, REACH)
    assert route.is_free
    assert route.length == pytest.approx(3.0, abs=0.15)
    assert route.ahead(Pose2D(), EMPTY, REACH, 1.2) == pytest.approx((1.2, 0.0), abs=0.12)


def test_it_leads_around_a_wall_and_keeps_away_from_it() -> None:
    obstacles = wall(1.5, -1.0, 2.0)
    route = find_route((0.0, 0.0), (3.0, 0.0), obstacles, REACH)
    assert route.is_free
    assert min(y for _, y in route.points) < -1.0, "the near end"
    assert nearest(route.points, obstacles) >= REACH - 0.01


def test_it_leads_out_of_a_dead_end() -> None:
    sides = np.array([[x, y] for x in np.arange(-0.5, 1.5, 0.05) for y in (-0.8, 0.8)])
    obstacles = np.vstack((wall(1.5, -0.8, 0.85), sides))
    route = find_route((0.5, 0.0), (3.0, 0.0), obstacles, REACH)
    assert route.is_free
    assert min(x for x, _ in route.points) < -0.5


def test_a_goal_that_is_walled_in_has_no_free_way() -> None:
    ring = np.array([[3 + 0.6 * math.cos(a), 0.6 * math.sin(a)] for a in np.arange(0, 6.3, 0.05)])
    assert not find_route((0.0, 0.0), (3.0, 0.0), ring, REACH).is_free


def test_a_way_is_clear_until_something_stands_on_it() -> None:
    route = find_route((0.0, 0.0), (3.0, 0.0), EMPTY, REACH)
    assert route.is_clear(np.array([[1.5, 1.0]]), REACH)
    assert not route.is_clear(np.array([[1.5, 0.1]]), REACH)


def test_what_is_left_of_a_way_gets_shorter() -> None:
    route = find_route((0.0, 0.0), (3.0, 0.0), EMPTY, REACH)
    assert route.rest(Pose2D(2.0, 0.0)).length == pytest.approx(1.0, abs=0.15)


def test_a_goal_far_beyond_the_grid_gives_a_way_toward_it() -> None:
    route = find_route((0.0, 0.0), (500.0, 0.0), EMPTY, REACH)
    x, y = route.ahead(Pose2D(), EMPTY, REACH, 1.2)
    assert x > 0.9
    assert abs(y) < 0.2


@pytest.mark.parametrize("goal", [(8.0, 0.0), (500.0, 0.0), (1e308, 0.0)])
def test_a_thing_on_the_border_of_the_grid_is_gone_around(goal: tuple[float, float]) -> None:
    thing = np.array(
        [[x, y] for x in np.arange(5.6, 6.4, 0.05) for y in np.arange(-0.8, 0.8, 0.05)]
    )
    route = find_route((0.0, 0.0), goal, thing, REACH)
    assert route.is_free
    assert nearest(route.points[:-1], thing) >= REACH - 0.01
    assert route.points[-1] == goal


@settings(max_examples=30, deadline=None)
@given(st.floats(-math.pi, math.pi), st.floats(6.0, 1000.0), st.floats(-math.pi, math.pi))
def test_a_far_goal_behind_something_far_away_has_a_free_way(
    direction: float, way: float, other: float
) -> None:
    ring = [
        (5.8 * math.cos(direction + a), 5.8 * math.sin(direction + a))
        for a in np.arange(-0.3, 0.3, 0.01)
    ]
    aside = [
        (2.0 * math.cos(other + a), 2.0 * math.sin(other + a)) for a in np.arange(-0.3, 0.3, 0.02)
    ]
    goal = (way * math.cos(direction), way * math.sin(direction))
    things = np.array(ring + aside)
    far = things[np.hypot(things[:, 0] - goal[0], things[:, 1] - goal[1]) > REACH + 0.2]
    assert find_route((0.0, 0.0), goal, far, REACH).is_free


points = st.tuples(st.floats(-3, 3), st.floats(-3, 3))


@settings(max_examples=30, deadline=None)
@given(points, points, st.lists(points, max_size=30))
def test_there_is_always_a_way_from_here_to_there(
    start: tuple[float, float], goal: tuple[float, float], things: list[tuple[float, float]]
) -> None:
    obstacles = np.array(things).reshape(-1, 2)
    route = find_route(start, goal, obstacles, REACH)
    assert (route.points[0], route.points[-1]) == (start, goal)
    steps = [math.dist(a, b) for a, b in zip(route.points[1:-1], route.points[2:-1], strict=False)]
    assert max(steps, default=0.0) < 0.15


def box(left: float, right: float, side: float) -> np.ndarray:
    """Points all around."""
    long = [[x, y] for x in np.arange(left, right, 0.05) for y in (-side, side)]
    return np.vstack((long, wall(left, -side, side), wall(right, -side, side)))


@pytest.mark.parametrize(("width", "aside"), [(0.35, 0.0), (0.45, 0.27), (0.55, -0.33)])
def test_the_widest_way_is_as_wide_as_the_door(width: float, aside: float) -> None:
    """The middles of cells may lie half a cell beside that of the door."""
    door = wall(1.5, -1.5, aside - width / 2), wall(1.5, aside + width / 2, 1.5)
    obstacles = np.vstack((box(-0.6, 3.6, 1.5), *door))
    found = narrow_way((0.0, 0.0), (3.0, 0.0), obstacles, REACH)
    assert width - 0.15 <= found <= width + 0.1


def test_a_way_that_is_wide_enough_is_as_wide_as_the_robot_needs() -> None:
    assert narrow_way((0.0, 0.0), (3.0, 0.0), EMPTY, REACH) == 2 * REACH


def test_there_is_no_way_through_a_wall() -> None:
    obstacles = np.vstack((box(-0.6, 3.6, 1.5), wall(1.5, -1.5, 1.5)))
    assert narrow_way((0.0, 0.0), (3.0, 0.0), obstacles, REACH) < 0.15
