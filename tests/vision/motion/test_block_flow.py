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


def noisy(image, seed, noise=3.0):
    drawn = image + np.random.default_rng(seed).normal(0, noise, image.shape)
    return np.clip(drawn, 0, 255).astype(np.uint8)


def wall():
    return np.full((240, 320), 150.0)


def wall_with_a_picture():
    image = wall()
    image[60:140, 90:170] = warped(texture())[:80, :80]
    return image


def wall_with_an_edge():
    image = wall()
    image[:, 200:] = 90
    return image


@pytest.mark.proves("R09")
@pytest.mark.parametrize("made", [wall, wall_with_a_picture, wall_with_an_edge])
@pytest.mark.parametrize("noise", [0.0, 3.0, 8.0])
def test_noise_before_a_still_camera_is_no_contact(made, noise):
    finder = BlockFlowFinder()
    for seed in range(12):
        found = finder.between(noisy(made(), seed, noise), noisy(made(), seed + 1, noise))
        assert found.time_to_contact(0.1) == math.inf
        assert math.hypot(*found.mean) < 4


def test_only_cells_with_structure_are_sure():
    found = flow(noisy(wall_with_a_picture(), 1), noisy(wall_with_a_picture(), 2))
    inside = found.confidence[5:8, 7:10]
    outside = found.confidence.copy()
    outside[3:10, 5:12] = 0
    assert inside.min() > 0.6
    assert outside.max() < 0.3


@pytest.mark.proves("R09")
@pytest.mark.parametrize("shift", [(20, 8), (0, 20), (40, 0), (-40, 12), (3, -50)])
def test_a_picture_that_moved_far_is_followed(shift):
    found = flow(noisy(warped(texture()), 1), noisy(warped(texture(), shift=shift), 2))
    error = np.hypot(*(found.cells - np.array(shift)).transpose(2, 0, 1))
    is_sure = found.confidence > 0.5
    assert is_sure.mean() > 0.5
    assert np.percentile(error[is_sure], 95) < 0.5
    assert found.mean == pytest.approx(shift, abs=0.5)


@pytest.mark.parametrize("scale", [0.95, 1.01, 1.03, 1.06, 1.1])
def test_growth_is_measured_as_it_is(scale):
    found = flow(noisy(warped(texture()), 1), noisy(warped(texture(), scale=scale), 2))
    assert found.expansion == pytest.approx(scale - 1, rel=0.06, abs=0.0007)


def test_a_picture_of_something_else_tells_nothing():
    other = np.random.default_rng(8).uniform(0, 255, (240, 320)).astype(np.float32)
    found = flow(warped(texture()), cv2.GaussianBlur(other, (0, 0), 2).astype(np.uint8))
    assert found.confidence.mean() < 0.1
    assert found.time_to_contact(0.1) == math.inf
