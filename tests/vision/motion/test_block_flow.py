import itertools
import math

import cv2
import numpy as np
import pytest

from hri.vision.motion.block_flow import BlockFlowFinder


def texture(size=(240, 320)):
    noise = np.random.default_rng(3).uniform(0, 255, size).astype(np.float32)
    return cv2.normalize(cv2.GaussianBlur(noise, (0, 0), 3), None, 0, 255, cv2.NORM_MINMAX)


def warped(image, scale=1.0, shift=(0.0, 0.0)):
    height, width = image.shape
    matrix = cv2.getRotationMatrix2D((width / 2, height / 2), 0, scale)
    matrix[:, 2] += shift
    moved = cv2.warpAffine(image, matrix, (width, height), borderMode=cv2.BORDER_REFLECT)
    return moved.astype(np.uint8)


def flow(first, second):
    return BlockFlowFinder().between(first, second)


def test_the_mean_is_the_shift_of_the_picture():
    found = flow(warped(texture()), warped(texture(), shift=(3.3, -1.7)))
    assert found.cells.shape == (15, 20, 2)
    assert np.median(found.cells, axis=(0, 1)) == pytest.approx((3.3, -1.7), abs=0.3)
    assert found.mean == pytest.approx((3.3, -1.7), abs=0.5)


def test_a_picture_that_grows_comes_nearer():
    found = flow(warped(texture()), warped(texture(), scale=1.03))
    assert found.expansion == pytest.approx(0.03, abs=0.006)
    assert found.time_to_contact(0.1) == pytest.approx(0.1 / 0.03, rel=0.25)


def test_a_picture_that_shrinks_is_never_touched():
    found = flow(warped(texture()), warped(texture(), scale=0.97))
    assert found.time_to_contact(0.1) == math.inf


def test_the_same_film_gives_the_same_flow():
    film = [warped(texture(), shift=(step, step / 2)) for step in range(4)]
    finder = BlockFlowFinder()
    for before, now in itertools.pairwise(film):
        assert np.array_equal(finder.between(before, now).cells, flow(before, now).cells)


@pytest.mark.parametrize("size", [(1, 1), (1, 50), (31, 200)])
def test_tiny_pictures_have_no_flow(size):
    assert flow(np.zeros(size, np.uint8), np.zeros(size, np.uint8)) is None


def test_odd_sizes_and_a_covered_camera_have_no_motion():
    found = flow(np.zeros((61, 77), np.uint8), np.zeros((61, 77), np.uint8))
    assert found.mean == pytest.approx((0, 0), abs=1e-3)
    assert found.time_to_contact(0.1) > 100


def test_pictures_of_two_sizes_have_no_flow():
    assert flow(np.zeros((64, 64), np.uint8), np.zeros((48, 64), np.uint8)) is None
