import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.vision.detectors.mesh import Region
from hri.vision.tracking.appearance import blended, difference, look_of
from hri.vision.tracking.assignment import assigned
from tests.vision.stage import Player, Stage, standing
from tests.vision.tracking.test_people import ANNA, BEN, CARA

COSTS = st.integers(1, 4).flatmap(
    lambda columns: st.lists(
        st.lists(st.floats(0, 10) | st.just(math.inf), min_size=columns, max_size=columns),
        min_size=1,
        max_size=4,
    )
)


def total(costs: list[list[float]], chosen: list[int | None]) -> tuple[int, float]:
    pairs = [(row, column) for row, column in enumerate(chosen) if column is not None]
    return -len(pairs), sum(costs[row][column] for row, column in pairs)


@given(COSTS)
def test_each_gets_one_at_most_and_nothing_that_is_forbidden(costs):
    chosen = assigned(costs)
    taken = [column for column in chosen if column is not None]
    assert len(chosen) == len(costs)
    assert len(taken) == len(set(taken))
    assert all(costs[row][c] < math.inf for row, c in enumerate(chosen) if c is not None)


@given(st.lists(st.lists(st.floats(0, 10), min_size=2, max_size=2), min_size=2, max_size=2))
def test_two_are_assigned_for_the_least_cost_there_is(costs):
    ways = [list(way) for way in itertools.permutations(range(2))]
    assert total(costs, assigned(costs)) <= min(total(costs, way) for way in ways)


def test_the_obvious_ones_are_found():
    assert assigned([[0.1, 0.9], [0.2, 0.1]]) == [0, 1]
    assert assigned([[0.1, 0.2], [0.15, 0.9]]) == [1, 0], "together, that costs less"
    assert assigned([[0.5, 0.1, 0.3]]) == [1]
    assert assigned([[0.5], [0.1]]) == [None, 0]
    assert assigned([[math.inf]]) == [None]
    assert assigned([]) == []


REGION = Region(160, 100, 80)


def look(player: Player, light: float = 1.0, noise: float = 0.0, seed: int = 0):
    image = Stage([player]).image() * light
    image = image + np.random.default_rng(seed).normal(0, noise, image.shape)
    return look_of(np.clip(image, 0, 255).astype(np.uint8), REGION)


@pytest.mark.parametrize("light", [0.35, 0.8, 1.2])
def test_people_are_more_like_themselves_in_other_light_than_like_others(light):
    people = [Player(standing(), **clothes) for clothes in (ANNA, BEN, CARA)]
    for one, other in itertools.permutations(people, 2):
        same = difference(look(one), look(one, light, noise=5.0))
        assert same < 0.12
        assert difference(look(one), look(other, light, noise=5.0)) > 2 * same


def test_what_is_outside_of_the_picture_is_not_compared():
    player = Player(standing(), **ANNA)
    image = Stage([player]).image()
    whole, cut = look_of(image, REGION), look_of(image[:130], REGION)
    assert np.isnan(cut).any()
    assert difference(whole, cut) == pytest.approx(0.0, abs=0.05)
    nothing = look_of(image, Region(-500, -500, 80))
    assert difference(whole, nothing) == math.inf
    assert np.array_equal(blended(nothing, whole, 0.2), whole)


@settings(max_examples=50)
@given(st.floats(-900, 900), st.floats(-900, 900), st.floats(1, 2000), st.floats(-4, 4))
def test_any_region_of_any_picture_has_a_look(x, y, side, roll):
    image = np.zeros((40, 60, 3), np.uint8)
    assert look_of(image, Region(x, y, side, roll)).shape == look_of(image, REGION).shape
