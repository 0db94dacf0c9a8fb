import cv2
import numpy as np
import pytest

from hri.core.errors import HriError
from hri.vision.color.color_constancy import chromaticity
from hri.vision.color.color_mixture import ColorTable, fit, ratio_table
from hri.vision.color.segmentation import ColorSegmenter

RED, BLUE, GRAY = (200, 30, 30), (30, 40, 200), (120, 120, 110)


def drawn(*balls, size=(320, 240), seed=1):
    """A noisy gray room with balls: color, center and radius."""
    image = np.full((size[1], size[0], 3), GRAY, np.uint8)
    for color, center, radius in balls:
        cv2.circle(image, center, radius, color, -1)
    noise = np.random.default_rng(seed).normal(0, 4, image.shape)
    return np.clip(image + noise, 0, 255).astype(np.uint8)


def samples(color):
    """The chroma of what has a color in such a room."""
    seen = chromaticity(drawn((color, (80, 100), 40), seed=7))
    return seen.chroma[80:120, 60:100].reshape(-1, 2).astype(float)


@pytest.fixture(scope="module")
def tables():
    background = fit(samples(GRAY), 2)
    return {
        name: ratio_table(fit(samples(color), 2), background)
        for name, color in (("red", RED), ("blue", BLUE))
    }


def test_blobs_of_several_colors_have_place_and_size(tables):
    image = drawn((RED, (80, 100), 30), (BLUE, (230, 60), 20))
    red, blue = ColorSegmenter(tables).segment(image)
    assert (red.name, blue.name) == ("red", "blue"), "the largest comes first"
    assert (red.x, red.y) == pytest.approx((80, 100), abs=1)
    assert red.area == pytest.approx(np.pi * 30**2, rel=0.05)
    assert (red.width, red.height) == pytest.approx((61, 61), abs=2)
    assert (blue.x, blue.y) == pytest.approx((230, 60), abs=1)


def test_an_empty_room_has_no_blobs(tables):
    assert ColorSegmenter(tables).segment(drawn()) == ()


@pytest.mark.parametrize("size", [(1, 1), (33, 17), (1, 50)])
def test_a_black_picture_of_any_size_has_no_blobs(tables, size):
    assert ColorSegmenter(tables).segment(np.zeros((*size, 3), np.uint8)) == ()


def test_the_same_seed_gives_the_same_mixture():
    pixels = samples(RED)
    assert np.array_equal(fit(pixels, 3, seed=5).means, fit(pixels, 3, seed=5).means)


def test_a_mixture_finds_two_colors():
    both = np.vstack([samples(RED), samples(BLUE)])
    means = sorted(fit(both, 2).means.tolist())
    expected = sorted([samples(RED).mean(axis=0).tolist(), samples(BLUE).mean(axis=0).tolist()])
    assert np.allclose(means, expected, atol=2)


def test_one_color_everywhere_can_be_fitted():
    mixture = fit(np.full((100, 2), 128.0), 3)
    assert np.allclose(mixture.means, 128.0)


def test_too_few_pixels_are_refused():
    with pytest.raises(HriError, match="draw a larger box"):
        fit(np.zeros((3, 2)), 2)


def test_a_new_color_leaves_the_light_of_the_others_as_it_is(tables):
    """Skin is learned again and again; a lamp on a ball must not be forgotten each time."""
    segmenter = ColorSegmenter(tables)
    for step in range(60):
        under_a_lamp = tuple(int(part) for part in np.array(RED) + (0, 40, 0) * np.array(step / 59))
        image = drawn((under_a_lamp, (80, 100), 30), seed=step)
        before = segmenter.segment(image)
    assert ColorSegmenter(tables).segment(image) == ()
    nothing = ColorTable(np.full((256, 256), -10.0, np.float32), np.zeros(2))
    segmenter.learn("skin", nothing)
    assert [one.name for one in segmenter.segment(image)] == [one.name for one in before] == ["red"]


def test_a_blob_that_might_be_another_color_has_less_confidence(tables):
    image = drawn((RED, (80, 100), 30))
    (alone,) = ColorSegmenter(tables).segment(image)
    assert 0.9 < alone.confidence <= 1.0
    red = tables["red"]
    twins = {"one": red, "other": ColorTable(red.ratios - 0.1, red.center)}
    (doubtful,) = ColorSegmenter(twins).segment(image)
    assert doubtful.confidence == pytest.approx(1 / (1 + np.exp(-0.1)), abs=0.01)


def test_in_the_light_in_which_it_was_learned_a_color_stays_where_it_is(tables):
    segmenter = ColorSegmenter(tables)
    for seed in range(40):
        segmenter.segment(drawn((RED, (80, 100), 30), (BLUE, (230, 60), 20), seed=seed))
    assert all(max(map(abs, shift)) <= 2 for shift in segmenter.light.values())
