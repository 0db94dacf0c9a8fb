import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.signals import Pose2D, RangeReading
from hri.drive.mechanics import Mechanics
from hri.drive.polar_histogram import (
    DIRECTIONS,
    SECTORS,
    Histogram,
    Memory,
    free_ways,
    sector,
    valleys,
)

ONE_BEAM = Mechanics(0.2, {"front": Pose2D(0.1, 0.0, 0.0)})
HERE = Pose2D()
coordinates = st.floats(-2, 2)


def seen(distance: float, time: float = 0.0) -> dict[str, RangeReading]:
    return {"front": RangeReading("front", distance, time)}


def remembering(*readings: tuple[float, float], keep: float = 10.0) -> Memory:
    """A memory that looked ahead from the origin: (time, distance) each."""
    memory = Memory(keep)
    for time, distance in readings:
        memory.see(time, HERE, seen(distance, time), ONE_BEAM)
    return memory


def test_a_beam_leaves_a_point_where_it_ends_and_one_behind() -> None:
    assert remembering((0.0, 0.5)).points == pytest.approx(np.array([[0.6, 0.0], [0.9, 0.0]]))


def test_a_point_is_forgotten_in_time() -> None:
    memory = remembering((0.0, 0.5), keep=2.0)
    memory.see(1.9, HERE, {}, ONE_BEAM)
    assert len(memory.points)
    memory.see(2.1, HERE, {}, ONE_BEAM)
    assert not len(memory.points)


def test_a_beam_that_passes_through_a_point_removes_it() -> None:
    memory = remembering((0.0, 0.4), (0.1, math.inf))
    assert not len(memory.points)


def test_what_someone_leaves_who_walks_by_is_soon_forgotten() -> None:
    walker, thing = remembering((0.0, 0.5)), remembering((0.0, 0.5))
    walker.pass_by(0.1, [(0.8, 0.3)])
    thing.pass_by(0.1, [(0.8, 1.3)])
    for memory in (walker, thing):
        memory.see(1.2, HERE, {}, ONE_BEAM)
    assert not len(walker.points)
    assert len(thing.points)


def test_what_has_stood_there_for_long_stays_though_someone_walks_by() -> None:
    memory = remembering(*((step / 2, 0.5) for step in range(20)), keep=60.0)
    memory.pass_by(9.6, [(0.6, 0.1)])
    memory.see(15.0, HERE, {}, ONE_BEAM)
    assert len(memory.points)


def test_a_beam_that_ends_before_a_point_leaves_it() -> None:
    assert len(remembering((0.0, 0.5), (0.1, 0.3)).points) == 4


def test_a_wall_along_the_way_stays_remembered() -> None:
    memory = Memory(60.0)
    aside = Mechanics(0.2, {"left": Pose2D(0.0, 0.0, math.pi / 2)})
    for step in range(100):
        reading = {"left": RangeReading("left", 0.5, step * 0.05)}
        memory.see(step * 0.05, Pose2D(step * 0.015, 0.0, 0.0), reading, aside)
    xs = memory.points[:, 0]
    assert xs.min() < 0.02
    assert xs.max() > 1.45


@pytest.mark.parametrize("distance", [math.nan, -1.0])
def test_a_reading_that_is_no_distance_is_left_out(distance: float) -> None:
    assert not len(remembering((0.0, distance)).points)


def test_what_was_felt_stays_though_a_beam_passes_through_it() -> None:
    memory = remembering((0.0, math.inf))
    memory.feel(0.3, 0.0, 0.0, 0.0)
    memory.see(1.0, HERE, seen(math.inf), ONE_BEAM)
    assert len(memory.points)
    memory.see(16.0, HERE, {}, ONE_BEAM)
    assert not len(memory.points)


def test_what_was_felt_just_now_is_as_sure_as_what_was_seen() -> None:
    memory = Memory(60.0)
    memory.feel(0.3, 0.0, 100.0, 0.0)
    memory.see(110.0, HERE, {}, ONE_BEAM)
    assert len(memory.since(99.0))
    memory.see(116.0, HERE, {}, ONE_BEAM)
    assert not len(memory.points)


def test_what_is_in_the_same_place_for_longer_than_people_stay_counts_as_furniture() -> None:
    memory = remembering((0.0, 0.5), (9.0, 0.5))
    memory.add(3.0, 0.0, 9.0, 0.0)
    assert memory.since(50.0) == pytest.approx(np.array([(0.6, 0.0), (0.9, 0.0)]))


def test_memory_does_not_grow_for_ever() -> None:
    memory = Memory(1e9)
    for number in range(2000):
        memory.add(number * 0.1, 0.0, float(number), 0.0)
    assert len(memory.points) <= 1200


def test_nothing_in_the_way_leaves_all_ways_free() -> None:
    assert np.isinf(free_ways(HERE, np.zeros((0, 2)), 0.3)).all()


def test_a_way_ends_where_the_body_touches() -> None:
    ways = free_ways(HERE, np.array([[1.0, 0.0]]), 0.3)
    assert ways[0] == pytest.approx(0.7)
    assert np.isinf(ways[sector(math.pi / 2)])


def test_people_need_more_room_than_things() -> None:
    ways = free_ways(HERE, np.zeros((0, 2)), 0.3, [(2.0, 0.0, 0.75)])
    assert ways[0] == pytest.approx(2.0 - 0.3 - 0.75)


def test_beside_a_wall_that_is_too_near_the_ways_that_lead_off_it_are_free() -> None:
    wall = np.array([[x, 0.25] for x in np.linspace(-1, 1, 80)])
    ways = free_ways(HERE, wall, 0.3)
    assert ways[sector(-0.6)] == math.inf
    assert ways[sector(math.pi / 2)] < 0.01


@given(st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=20))
def test_no_way_leads_through_a_point(points: list[tuple[float, float]]) -> None:
    obstacles = np.array(points)
    reach = 0.3
    ways = free_ways(HERE, obstacles, reach)
    allowed = np.minimum(reach, np.maximum(np.hypot(*obstacles.T) - 0.002, 0.0))
    for direction, way in zip(DIRECTIONS, ways, strict=True):
        for part in np.linspace(0.0, min(way, 3.0), 7):
            x, y = part * math.cos(direction), part * math.sin(direction)
            apart = np.hypot(obstacles[:, 0] - x, obstacles[:, 1] - y)
            assert (apart >= allowed - 1e-6).all()


def test_a_direction_does_not_flicker_between_its_thresholds() -> None:
    histogram = Histogram(0.25, 0.4)
    ways = np.full(SECTORS, math.inf)
    for way, free in ((0.3, True), (0.2, False), (0.3, False), (0.5, True)):
        ways[0] = way
        assert histogram.update(ways)[0] == free


def test_a_way_that_is_as_long_as_needed_is_free() -> None:
    histogram = Histogram(0.25, 0.4)
    ways = np.full(SECTORS, 0.15)
    assert not histogram.update(ways).any()
    assert histogram.update(ways, 0.1).all()


def test_valleys_are_the_free_runs_also_across_the_first_sector() -> None:
    is_free = np.zeros(SECTORS, np.bool_)
    is_free[[70, 71, 0, 1, 30]] = True
    assert sorted(valleys(is_free)) == [(30, 1), (70, 4)]
    assert valleys(np.ones(SECTORS, np.bool_)) == [(0, SECTORS)]
    assert valleys(np.zeros(SECTORS, np.bool_)) == []
