"""The shape of a hand, from the points of one that is drawn joint by joint."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.signals import Hand, Landmarks
from hri.vision.hands.hand_shape import FIST, OPEN, POINTING, SHAPES, THUMB, hand_shape, shows_palm

KNUCKLES = ((-0.3, -0.3), (-0.3, -0.95), (-0.1, -1.0), (0.1, -0.95), (0.3, -0.85))
"""Where the fingers of a left palm begin, the wrist at 0; x to the right, y down, palm 1 long."""
BONES = (0.45, 0.28, 0.22)


def drawn(*straight: int, turn: float = 0.0, size: float = 80.0) -> Landmarks:
    """The 21 points of a hand with these fingers straight, fingers up, its palm to the camera."""
    places = [np.zeros(3)]
    for finger, (x, y) in enumerate(KNUCKLES):
        place = np.array((x, y, 0.0))
        places.append(place)
        bend = 0.0 if finger in straight else math.radians(80)
        aside = (math.sin(-0.9), -math.cos(-0.9)) if finger == 0 else (0.4 * x, -1.0)
        if finger == 0 and finger not in straight:
            aside, bend = (0.9, -0.4), math.radians(40)
        along = np.array((*aside, 0.0)) / math.hypot(*aside)
        angle = 0.0 if finger == 0 else bend
        for bone in BONES:
            step = bone * (math.cos(angle) * along - math.sin(angle) * np.array((0, 0, 1.0)))
            place = place + step
            places.append(place)
            angle += bend
    cosine, sine = math.cos(turn), math.sin(turn)
    around = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    return (np.array(places) @ around.T * size + (200, 200, 0)).astype(np.float32)


def hand(time: float = 0.0, *straight: int, turn: float = 0.0, x: float = 0.0) -> Hand:
    """A look at a left hand with these fingers straight."""
    points = drawn(*straight, turn=turn) + np.array((x, 0, 0), np.float32)
    shape = hand_shape(points)
    return Hand("left", time, points, shape.name, shape.straight, is_palm=True, number=1)


@pytest.mark.parametrize(
    ("fingers", "name"),
    [((0, 1, 2, 3, 4), OPEN), ((1,), POINTING), ((0, 1), POINTING), ((0,), THUMB), ((), FIST)],
)
def test_a_shape_has_a_name(fingers: tuple[int, ...], name: str) -> None:
    shape = hand_shape(drawn(*fingers))
    assert shape.name == name
    assert [n for n in range(5) if shape.straight[n]] == list(fingers)


@pytest.mark.parametrize("count", range(6))
def test_fingers_are_counted(count: int) -> None:
    fingers = (1, 2, 3, 4, 0)[:count]
    assert hand(0.0, *fingers).fingers == count


@given(
    st.sets(st.integers(0, 4)),
    st.floats(-math.pi, math.pi),
    st.floats(2, 2000),
    st.tuples(st.floats(-500, 500), st.floats(-500, 500)),
)
def test_place_size_and_turn_do_not_change_the_shape(
    fingers: set[int], turn: float, size: float, place: tuple[float, float]
) -> None:
    points = drawn(*fingers, turn=turn, size=size) + np.array((*place, 0), np.float32)
    assert hand_shape(points) == hand_shape(drawn(*fingers))


@given(st.sets(st.integers(0, 4)), st.booleans())
def test_a_mirrored_hand_has_the_same_shape_and_shows_the_same_side(
    fingers: set[int], is_left: bool
) -> None:
    points = drawn(*fingers)
    mirrored = points * np.array((-1, 1, 1), np.float32)
    assert hand_shape(mirrored) == hand_shape(points)
    assert shows_palm(mirrored, not is_left) == shows_palm(points, is_left)
    assert shows_palm(points, is_left) != shows_palm(points, not is_left)


def test_a_left_palm_is_one() -> None:
    assert shows_palm(drawn(0, 1, 2, 3, 4), is_left=True)


@given(
    st.lists(st.floats(width=32), min_size=63, max_size=63).map(
        lambda numbers: np.array(numbers, np.float32).reshape(21, 3)
    )
)
def test_any_points_have_a_shape(points: Landmarks) -> None:
    shape = hand_shape(points)
    assert len(shape.straight) == 5
    assert shape.name in ("", *SHAPES)
    if not np.isfinite(points).all():
        assert shape.name == ""


def test_all_points_in_one_place_are_no_shape() -> None:
    assert hand_shape(np.zeros((21, 3), np.float32)).name == ""
