"""A blob is sure when it is one thing: compact, set off, bright as it was, and hardly repeated."""

import cv2
import numpy as np
import pytest

from hri.vision.color.color_mixture import ratio_table
from hri.vision.color.color_model import learn_color
from hri.vision.color.segmentation import ColorSegmenter
from tests.vision.color.test_segmentation import GRAY

ORANGE = (235, 120, 25)


@pytest.fixture(scope="module")
def segmenter():
    def made():
        return ColorSegmenter({"orange": table})

    picture = room()
    cv2.circle(picture, (100, 110), 40, ORANGE, -1)
    picture = noisy(picture)
    model = learn_color("orange", [(picture, [(80, 90, 40, 40)])])
    table = ratio_table(model.color, model.background, model.brightness)
    return made


def surest(found):
    return max((blob.confidence for blob in found), default=0.0)


def noisy(image):
    noise = np.random.default_rng(3).normal(0, 4, image.shape)
    return np.clip(image + noise, 0, 255).astype(np.uint8)


def room():
    image = np.full((240, 320, 3), GRAY, np.uint8)
    image[:50, 240:] = 240
    return image


@pytest.mark.parametrize("light", [0.3, 0.5, 1.0])
def test_a_ball_is_sure_in_any_light(segmenter, light):
    image = room()
    cv2.circle(image, (150, 130), 30, ORANGE, -1)
    (blob,) = segmenter().segment(noisy(image * light))
    assert blob.confidence > 0.8
    assert blob.area == pytest.approx(np.pi * 30**2, rel=0.1)


def test_brown_is_not_a_sure_orange(segmenter):
    image = room()
    cv2.circle(image, (150, 130), 30, tuple(round(0.35 * part) for part in ORANGE), -1)
    assert surest(segmenter().segment(noisy(image))) < 0.5


def test_what_is_long_and_ragged_is_not_sure(segmenter):
    image = room()
    line = [(20 + 12 * n, 120 + (25 if n % 2 else -25)) for n in range(22)]
    cv2.polylines(image, [np.array(line)], False, ORANGE, 6)
    assert surest(segmenter().segment(noisy(image))) < 0.3


def test_each_of_many_scattered_blobs_is_less_sure_than_one_alone(segmenter):
    alone, many = room(), room()
    cv2.circle(alone, (50, 60), 12, ORANGE, -1)
    for n in range(12):
        cv2.circle(many, (30 + 50 * (n % 6), 60 + 110 * (n // 6)), 12, ORANGE, -1)
    assert surest(segmenter().segment(noisy(many))) < 0.75 * surest(
        segmenter().segment(noisy(alone))
    )


def test_what_runs_into_its_surroundings_is_less_sure(segmenter):
    sharp, blurred = room(), room()
    cv2.circle(sharp, (150, 130), 30, ORANGE, -1)
    wide = cv2.GaussianBlur(np.float32(sharp), (0, 0), 35)
    blurred = np.clip(GRAY + 2.2 * (wide - GRAY), 0, 255)
    assert surest(segmenter().segment(noisy(blurred))) < surest(segmenter().segment(noisy(sharp)))
