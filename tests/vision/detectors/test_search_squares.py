"""Which parts of a picture a search for faces looks at, and when."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.vision.detectors.search_squares import BUDGET, FINEST, SearchPlan, all_squares

SIDES = st.integers(32, 800)
INTERVAL = 0.1


@given(SIDES, SIDES)
def test_the_squares_of_each_size_cover_the_picture(width: int, height: int) -> None:
    squares = all_squares(width, height)
    assert squares[0].side == min(width, height)
    for side in {square.side for square in squares}:
        covered = np.zeros((height, width), bool)
        for square in squares:
            if square.side == side:
                top, left = max(0, square.top), max(0, square.left)
                covered[top : square.top + side, left : square.left + side] = True
        if max(width, height) <= 3 * min(width, height):
            assert covered.all()
    assert len(squares) <= 130
    assert min(square.side for square in squares) <= max(FINEST, 32)


@given(SIDES, SIDES, st.integers(0, 8), st.sampled_from([5, 15, 30]))
def test_every_square_has_its_turn(width: int, height: int, fits: int, rate: int) -> None:
    squares = all_squares(width, height)
    plan = SearchPlan(squares)
    seen = {square for n in range(40 * rate) for square in plan.due(n / rate, INTERVAL, fits)}
    assert seen == set(squares)


@pytest.mark.parametrize(("rate", "fits", "most"), [(15, 0, 5), (15, 1, 3), (30, 4, 1)])
def test_large_squares_come_soon_and_the_work_in_a_picture_is_bounded(
    rate: int, fits: int, most: int
) -> None:
    squares = all_squares(640, 480)
    plan = SearchPlan(squares)
    chosen = [plan.due(n / rate, INTERVAL, fits) for n in range(40 * rate)]
    assert max(map(len, chosen)) <= most
    for square in squares[:2]:
        looks = [n / rate for n, some in enumerate(chosen) if square in some]
        assert max(np.diff(looks)) <= 4 * INTERVAL


def test_a_missing_face_is_looked_for_first_where_it_should_be() -> None:
    def first_look(missing: list[tuple[float, float, float]]) -> int:
        plan = SearchPlan(all_squares(640, 480))
        for n in range(300):
            plan.due(n / 10, INTERVAL, fits=2)
        for n in range(300, 400):
            if any(one.shows(500, 300, 30) for one in plan.due(n / 10, INTERVAL, 2, missing)):
                return n - 300
        raise AssertionError

    assert 3 * first_look([(500.0, 300.0, 30.0)]) < first_look([])


def test_nothing_is_due_before_its_time() -> None:
    plan = SearchPlan(all_squares(320, 240))
    while plan.due(1.0, INTERVAL):
        pass
    assert plan.due(1.05, INTERVAL) == []
    assert plan.due(1.11, INTERVAL) != []


def test_what_is_spent_on_other_things_is_not_there_for_the_search() -> None:
    plan = SearchPlan(all_squares(640, 480))
    for index in range(30):
        assert len(plan.due(index / 15, INTERVAL, spent=BUDGET)) <= 1
