"""What is shown is cut out of what is behind it."""

import cv2
import numpy as np
import pytest

from hri.vision.objects.cutout import (
    in_the_middle,
    on_even_background,
    opaque,
    whole,
)
from hri.vision.objects.printed_label import printed_label
from tests.vision.objects.pictures import noisy, room

BOX = (200, 120, 440, 360)
"""Left, top, right, and bottom of a label in a picture."""


def with_label(image):
    left, top, right, bottom = BOX
    image = image.copy()
    image[top:bottom, left:right] = printed_label("cup")
    return image


def box_of(outline):
    return (*outline.min(axis=0), *outline.max(axis=0))


def test_an_object_before_one_color_is_cut_out():
    wall = np.full((480, 640, 3), (120, 170, 90), np.uint8)
    assert box_of(on_even_background(noisy(with_label(wall)))) == pytest.approx(BOX, abs=6)


def test_the_whole_picture_is_taken_where_nothing_stands_out():
    assert np.array_equal(on_even_background(room()), whole(room()))
    wall = np.full((40, 60, 3), 120, np.uint8)
    assert np.array_equal(on_even_background(wall), whole(wall))


def test_what_is_transparent_is_not_the_object():
    mask = np.zeros((480, 640), np.uint8)
    cv2.circle(mask, (300, 200), 90, 255, -1)
    assert box_of(opaque(room(), mask)) == pytest.approx((210, 110, 390, 290), abs=6)
    assert opaque(room(), mask * 0) is None
    assert np.array_equal(opaque(room(), mask * 0 + 255), whole(room()))


def test_what_is_held_in_the_middle_is_cut_out_of_a_room():
    found = box_of(in_the_middle(with_label(room(5))))
    assert found == pytest.approx(BOX, abs=40)


@pytest.mark.parametrize("shape", [(480, 640, 3), (60, 40, 3)])
def test_in_a_picture_of_one_color_nothing_stands_out(shape):
    assert in_the_middle(np.full(shape, 90, np.uint8)) is None
