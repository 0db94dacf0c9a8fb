import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hri.face.renderers.lamp import COLOR, add_lamp


@pytest.mark.parametrize(("width", "height"), [(640, 480), (800, 600), (128, 64)])
def test_the_lamp_shines_green_in_the_upper_right_corner_and_nowhere_else(
    width: int, height: int
) -> None:
    dark = np.full((height, width, 3), 40, np.uint8)
    changed = (add_lamp(dark) != dark).any(axis=2)
    rows, columns = np.nonzero(changed)
    assert rows.max() < height / 6
    assert columns.min() > width - height / 6
    brightest = add_lamp(dark)[rows, columns].max(axis=0)
    assert np.abs(brightest.astype(int) - COLOR).max() <= 2
    assert (dark == 40).all(), "the picture itself stays as it was"


@given(st.integers(1, 40), st.integers(1, 40))
def test_no_picture_is_too_small_for_it(width: int, height: int) -> None:
    assert add_lamp(np.zeros((height, width, 3), np.uint8)).shape == (height, width, 3)
