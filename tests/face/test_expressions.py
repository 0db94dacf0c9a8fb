"""What the default face shows, measured from its pixels."""

import numpy as np
import pytest

from hri.core.errors import HriError
from hri.face import render_face
from hri.face.vocabulary import REQUIRED, VISEMES
from tests.face.pixels import (
    MODEL,
    SIZE,
    brow_slope,
    corners_up,
    dark_mouth,
    face,
    iris,
    iris_center,
    lid_gap,
    lip_line,
    teeth,
    white_above_iris,
)

STEPS = (0.0, 0.25, 0.5, 0.75, 1.0)


def test_the_neutral_face_is_kind_and_its_mouth_is_shut() -> None:
    neutral = face()
    assert 4 < corners_up(neutral) < 15, "a hint of a smile"
    assert dark_mouth(neutral) == 0
    assert teeth(neutral) == 0
    assert abs(brow_slope(neutral)) < 3


def test_the_upper_lid_cuts_the_iris_at_rest_and_not_in_surprise() -> None:
    assert white_above_iris(face()) == 0
    assert white_above_iris(face("surprised")) > 3


def test_happy_lifts_the_corners_and_sad_lowers_them() -> None:
    neutral = corners_up(face())
    assert corners_up(face("happy")) > neutral + 12
    assert corners_up(face("sad")) < neutral - 15


def test_anger_and_sadness_slope_the_brows_against_each_other() -> None:
    assert brow_slope(face("angry")) > 8
    assert brow_slope(face("sad")) < -8
    assert brow_slope(face("scared")) < -8


def test_surprise_opens_mouth_and_eyes() -> None:
    surprised = face("surprised")
    assert dark_mouth(surprised) > 1000
    assert lid_gap(surprised) > 1.3 * lid_gap(face())
    assert lip_line(surprised)["width"] < 0.6 * lip_line(face())["width"]


def test_fear_bares_the_teeth_where_surprise_rounds_the_mouth() -> None:
    scared, surprised = face("scared"), face("surprised")
    assert lip_line(scared)["width"] > 2 * lip_line(surprised)["width"]
    assert teeth(scared) > 2 * teeth(surprised)


def test_disgust_narrows_the_eyes_that_anger_leaves_open() -> None:
    assert lid_gap(face("disgusted")) < 0.6 * lid_gap(face("angry"))
    assert corners_up(face("disgusted")) < corners_up(face("angry"))


def test_all_expressions_differ_clearly() -> None:
    pictures = {label: face(label).astype(int) for label in REQUIRED}
    for first in REQUIRED:
        for second in REQUIRED:
            if first < second:
                changed = np.abs(pictures[first] - pictures[second]).max(axis=2) > 30
                assert changed.mean() > 0.01, (first, second)


def test_afraid_is_another_word_for_scared() -> None:
    assert np.array_equal(face("afraid"), face("scared"))


@pytest.mark.parametrize(
    ("label", "measure", "sign"),
    [
        ("happy", corners_up, 1),
        ("sad", corners_up, -1),
        ("angry", brow_slope, 1),
        ("sad", brow_slope, -1),
        ("surprised", dark_mouth, 1),
        ("surprised", lid_gap, 1),
        ("disgusted", lid_gap, -1),
    ],
)
def test_an_expression_grows_with_its_intensity(label, measure, sign) -> None:  # type: ignore[no-untyped-def]
    values = [sign * measure(face(label, intensity)) for intensity in STEPS]
    steps = np.diff(values)
    assert (steps >= -1.5).all(), values
    assert values[-1] > values[0]


def test_a_blink_shuts_the_eyes() -> None:
    gaps = [lid_gap(face(weights={"eyeBlink": share})) for share in STEPS]
    assert gaps == sorted(gaps, reverse=True)
    assert gaps[-1] == 0
    assert iris(face("asleep")) == 0


def test_one_eye_can_wink() -> None:
    assert lid_gap(face(weights={"eyeBlinkLeft": 1.0})) == 0
    assert lid_gap(face(weights={"eyeBlinkRight": 1.0})) == lid_gap(face())


def test_the_eyes_look_where_they_are_told() -> None:
    x, y = iris_center(face())
    still = {"headX": 0.0}
    assert iris_center(face(gaze=(1, 0), weights=still))[0] > x + 10
    assert iris_center(face(gaze=(-1, 0), weights=still))[0] < x - 10
    assert iris_center(face(gaze=(0, 1)))[1] < y - 8
    assert iris_center(face(gaze=(0, -1)))[1] > y + 8


def test_every_viseme_has_a_shape_of_its_own_and_closes_or_opens_as_it_must() -> None:
    dark = {name: dark_mouth(face(viseme=name)) for name in VISEMES}
    assert dark["PP"] == 0
    assert dark["sil"] == 0
    assert dark["aa"] > dark["E"] > dark["ih"]
    assert dark["aa"] > dark["oh"] > dark["ou"]
    assert teeth(face(viseme="FF")) > 200, "the upper teeth rest on the lower lip"
    assert dark["FF"] < 30
    assert teeth(face(viseme="SS")) > 500


def test_round_vowels_round_the_lips() -> None:
    width = {name: lip_line(face(viseme=name))["width"] for name in ("ou", "oh", "aa", "ih")}
    assert width["ou"] < width["oh"] < width["aa"] < width["ih"]


@pytest.mark.parametrize("label", REQUIRED)
def test_lips_meet_for_b_whatever_is_felt(label: str) -> None:
    if label not in ("asleep",):
        assert dark_mouth(face(label, viseme="PP")) == 0


def test_left_and_right_mirror_each_other() -> None:
    left, right = face(weights={"mouthSmileLeft": 1}), face(weights={"mouthSmileRight": 1})
    mouth = (slice(285, 340), slice(175, 306))
    mirrored = right[:, ::-1][mouth].astype(int)
    assert np.abs(left[mouth].astype(int) - mirrored).mean() < 6


def test_the_same_arguments_give_the_same_bytes() -> None:
    first = render_face(MODEL, "happy", time=3.3, seed=4, size=(160, 120))
    again = render_face(MODEL, "happy", time=3.3, seed=4, size=(160, 120))
    assert np.array_equal(first, again)
    assert first.shape == (120, 160, 3)
    assert first.dtype == np.uint8
    other = render_face(MODEL, "happy", time=3.3, seed=5, size=(160, 120))
    assert not np.array_equal(first, other)


@pytest.mark.parametrize("size", [(16, 16), (128, 64), (320, 480), (600, 200)])
def test_any_size_can_be_drawn(size: tuple[int, int]) -> None:
    picture = render_face(MODEL, "surprised", size=size)
    assert picture.shape == (size[1], size[0], 3)
    assert picture.std() > 10


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"expression": "hapy"}, 'did you mean "happy"'),
        ({"viseme": "pp"}, 'did you mean "PP"'),
        ({"weights": {"jawOpne": 1.0}}, 'did you mean "jawOpen"'),
        ({"weights": {"jawOpen": float("nan")}}, "finite"),
        ({"intensity": float("inf")}, "finite"),
        ({"intensity": 7.0}, "from 0 to 1"),
        ({"gaze": (float("nan"), 0.0)}, "finite"),
        ({"size": (4, 4)}, "4x4"),
        ({"face": "robbot"}, 'did you mean "robot"'),
    ],
)
def test_what_cannot_be_drawn_is_refused(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(HriError, match=message):
        render_face(**{"size": SIZE, **arguments})  # type: ignore[arg-type]


def test_weights_far_out_of_range_still_give_a_picture() -> None:
    assert face(weights={"jawOpen": 1e30, "headX": -1e30, "eyeBlink": -50.0}).shape == (480, 480, 3)
