"""The color of a thing is the same in any light that a camera can see in."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.vision.color.color_constancy import chromaticity
from tests.vision.color.test_segmentation import BLUE, RED, drawn

SCENE = drawn((RED, (80, 100), 30), (BLUE, (230, 60), 30), ((245, 245, 240), (250, 190), 25))
PLACES = {"red": (80, 100), "blue": (230, 60), "gray": (150, 200)}


def levels(image):
    """The mean chroma of each thing."""
    chroma = chromaticity(image).chroma.astype(float)
    return {
        name: chroma[y - 9 : y + 10, x - 9 : x + 10].mean((0, 1)) for name, (x, y) in PLACES.items()
    }


def lit(image, *gains):
    return np.clip(image * np.array(gains), 0, 255).astype(np.uint8)


@given(st.floats(0.25, 1.0))
def test_a_dim_light_changes_no_color(gain):
    before, after = levels(SCENE), levels(lit(SCENE, gain, gain, gain))
    for name in PLACES:
        assert after[name] == pytest.approx(before[name], abs=10)


@given(st.floats(0.75, 1.25), st.floats(0.7, 1.25))
def test_most_of_a_tint_is_taken_away(red, blue):
    tinted = lit(SCENE, red, 1.0, blue)
    gray = levels(tinted)["gray"]
    moved = np.abs(gray - levels(SCENE)["gray"]).max()
    assert moved <= 4 + 0.35 * 90 * max(abs(red - 1), abs(blue - 1))


@pytest.mark.parametrize("share", [0.35, 0.6, 1.0])
def test_a_shadow_changes_little(share):
    image = SCENE.copy()
    image[:, :160] = lit(image[:, :160], share, share, share)
    assert levels(image)["red"] == pytest.approx(levels(SCENE)["red"], abs=14)


@pytest.mark.parametrize("color", [RED, BLUE])
def test_what_fills_the_picture_keeps_its_color(color):
    """There is nothing else to tell the light by."""
    near = drawn((color, (160, 120), 230))
    chroma = chromaticity(near).chroma[100:140, 140:180].astype(float).mean((0, 1))
    usual = chromaticity(drawn((color, (160, 120), 40))).chroma[100:140, 140:180]
    assert chroma == pytest.approx(usual.astype(float).mean((0, 1)), abs=14)


@pytest.mark.parametrize("size", [(1, 1), (3, 500), (240, 320)])
def test_noise_in_the_dark_has_no_color(size):
    dark = np.random.default_rng(2).integers(0, 8, (*size, 3)).astype(np.uint8)
    assert not chromaticity(dark).brightness.any()


def test_gray_has_no_chroma_in_any_shade():
    ramp = np.repeat(np.arange(256, dtype=np.uint8)[None, :, None], 3, axis=2)
    assert np.abs(chromaticity(ramp).chroma.astype(int) - 128).max() <= 2
