"""What is seen is drawn over the picture, and the picture itself stays as it is."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import FaceBox, HeadGesture, HeadPose, People, Person
from hri.vision.detectors.overlay import (
    CALM,
    GESTURE,
    HIDDEN,
    LOOKING,
    draw,
    draw_words,
    head_axes,
    pose_words,
    words_of,
)

DARK = np.zeros((240, 320, 3), np.uint8)
BOX = FaceBox(120, 60, 80, 100)


def somebody(id="p1", box=BOX, pitch=0.0, yaw=0.0, roll=0.0, **more):
    return Person(id, HeadPose(0.0, pitch, yaw, roll, box), **more)


def drawn(*persons, gestures=(), attended=""):
    return draw(DARK, People(0.0, persons, attended), gestures)


def colored(image, color):
    """How many pixels have about this color."""
    return int((np.abs(image.astype(int) - color).max(axis=2) < 30).sum())


def test_everybody_is_marked_and_the_picture_itself_is_not_touched():
    before = DARK.copy()
    other = somebody("p2", FaceBox(10, 30, 60, 70))
    one, two = drawn(somebody()), drawn(somebody(), other)
    assert np.array_equal(DARK, before)
    assert two.shape == DARK.shape
    assert two.dtype == np.uint8
    assert colored(two, CALM) > colored(one, CALM) > 100
    assert not draw(DARK, None).any()
    assert not drawn().any()


def test_colors_tell_who_looks_at_the_robot_and_who_is_out_of_sight():
    assert colored(drawn(somebody(is_looking=True)), LOOKING) > 200
    hidden = drawn(somebody(is_visible=False))
    assert colored(hidden, HIDDEN) > 100
    assert colored(hidden, CALM) == 0


def test_the_one_who_is_attended_to_has_a_thick_box():
    assert colored(drawn(somebody(), attended="p1"), CALM) > 1.5 * colored(drawn(somebody()), CALM)


def test_a_gesture_is_written_at_who_made_it():
    nod = HeadGesture("nod", 0.0, person="p1")
    other = somebody("p2", FaceBox(10, 30, 60, 70))
    image = drawn(somebody(), other, gestures=[nod])
    assert colored(image[:, 120:], GESTURE) > 10
    assert colored(image[:, :110], GESTURE) == 0


def test_the_words_say_who_how_far_and_how():
    person = somebody(distance=1.234, engagement="engaged", pitch=0.1, yaw=-0.2)
    assert words_of(person) == "p1  1.2 m  engaged"
    assert words_of(somebody(name="Anna", is_visible=False)) == "Anna  out of sight"
    assert pose_words(person.pose) == "pitch 6 yaw -11 roll 0"
    assert pose_words(HeadPose(0.0, math.nan, 0.0)) == ""


def test_the_axes_turn_with_the_head():
    left, down, ahead = head_axes(0.0, 0.0, 0.0)
    assert (left, down, ahead) == ((1, 0), (0, 1), (0, 0))
    assert head_axes(0.0, 0.5, 0.0)[2][0] > 0.4  # to the person's left: to the picture's right
    assert head_axes(0.5, 0.0, 0.0)[2][1] > 0.4  # down
    assert head_axes(0.0, 0.0, 0.5)[0][1] > 0.4  # left ear down


@given(*[st.floats(-math.pi, math.pi)] * 3)
def test_no_axis_is_longer_than_one(pitch, yaw, roll):
    assert all(math.hypot(*axis) <= 1 + 1e-9 for axis in head_axes(pitch, yaw, roll))


WILD = st.floats(allow_nan=True, allow_infinity=True)


@settings(max_examples=60, deadline=None)
@given(*[WILD] * 7, st.text(max_size=8))
def test_nothing_that_is_seen_can_break_it(x, y, width, height, pitch, yaw, distance, name):
    landmarks = np.full((468, 3), x, np.float32) if abs(x) < 1e30 else None
    person = somebody(
        box=FaceBox(x, y, width, height),
        pitch=pitch,
        yaw=yaw,
        distance=distance,
        name=name,
        landmarks=landmarks,
    )
    for size in ((240, 320), (1, 1), (3, 500)):
        image = np.zeros((*size, 3), np.uint8)
        assert draw(image, People(0.0, (person,)), [HeadGesture(name, 0.0)]).shape == image.shape


@pytest.mark.parametrize("words", ["30 pictures a second, 2 lost, 14 ms", "Grüße 你好 \x00"])
def test_a_line_of_words_stands_at_the_bottom(words):
    image = draw_words(DARK, words)
    assert image[200:].any()
    assert not image[:200].any()
