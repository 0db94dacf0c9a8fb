"""A drawn hand: it is where it should be, whatever its size, and rises and sinks."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.simulation.people.drawn_hand import DrawnHand
from hri.simulation.people.hand_motion import HAND_MOTIONS, RISE
from hri.simulation.people.person import SimulatedPerson

GRAY = np.full((240, 320, 3), 90, np.uint8)


def painted(hand: DrawnHand) -> np.ndarray:
    image = GRAY.copy()
    hand.paint(image)
    return (image != GRAY).any(axis=2)


def test_a_hand_covers_its_palm_and_its_straight_fingers() -> None:
    is_open, fist = (
        painted(DrawnHand((160, 120), 30, 90, (straight,) * 5)) for straight in (True, False)
    )
    assert is_open[105:135, 150:170].all()
    assert is_open[80:100].any()
    assert not fist[80:95].any()


def test_a_right_hand_is_the_mirror_image_of_a_left_one() -> None:
    left, right = (painted(DrawnHand((159.5, 120), 30, 90, is_left=it)) for it in (True, False))
    assert (left != right[:, ::-1]).mean() < 0.005
    assert (left != right).mean() > 0.005


@settings(max_examples=12, deadline=None)
@given(
    st.tuples(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4)),
    st.floats(0.01, 1e5),
    st.floats(-10, 10),
    st.tuples(*(st.booleans(),) * 5),
)
def test_it_may_be_anywhere_and_of_any_size(
    center: tuple[float, float], palm: float, turn: float, straight: tuple[bool, ...]
) -> None:
    painted(DrawnHand(center, palm, 90, straight, turn))


@pytest.mark.parametrize("name", HAND_MOTIONS)
def test_a_hand_rises_is_held_and_sinks(name: str) -> None:
    person = SimulatedPerson()
    person.show(name, 1.0, seconds=2.0)
    assert person.hand(1.0) is None
    assert person.hand(1.0 + 2 * RISE + 2.0) is None
    low, high, sinking = (person.hand(time) for time in (1.05, 1 + RISE, 3 + 1.8 * RISE))
    assert low
    assert high
    assert sinking
    assert high.down == HAND_MOTIONS[name].down < sinking.down < low.down
    assert all(math.isfinite(value) for value in (high.turn, high.aside))
