import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.face.renderers.lamp import RECORDING, WATCHING, Lamp, add_lamp
from hri.face.renderers.small_screens import one_bit

LAMPS = [WATCHING, RECORDING]


@pytest.mark.parametrize(("width", "height"), [(640, 480), (800, 600), (128, 64)])
@pytest.mark.parametrize("lamp", LAMPS)
def test_a_lamp_shines_in_its_color_in_its_upper_corner_and_nowhere_else(
    lamp: Lamp, width: int, height: int
) -> None:
    dark = np.full((height, width, 3), 40, np.uint8)
    changed = (add_lamp(dark, lamp) != dark).any(axis=2)
    rows, columns = np.nonzero(changed)
    assert rows.max() < height / 6
    if lamp.is_left:
        assert columns.max() < width / 6
    else:
        assert columns.min() > width - height / 6
    brightest = add_lamp(dark, lamp)[rows, columns].max(axis=0)
    assert np.abs(brightest.astype(int) - lamp.color).max() <= 2
    assert (dark == 40).all(), "the picture itself stays as it was"


def test_the_mark_of_a_recording_says_so_where_letters_can_be_read() -> None:
    def reach(height: int) -> float:
        dark = np.zeros((height, 2 * height, 3), np.uint8)
        return float(np.nonzero(add_lamp(dark, RECORDING).any(axis=(0, 2)))[0].max() / height)

    assert reach(480) > reach(64) + 0.02


@pytest.mark.parametrize("lamp", LAMPS)
def test_a_lamp_can_be_seen_on_a_screen_of_one_bit(lamp: Lamp) -> None:
    assert one_bit(add_lamp(np.zeros((64, 128, 3), np.uint8), lamp)).any()


@given(st.integers(1, 40), st.integers(1, 40), st.sampled_from(LAMPS))
def test_no_picture_is_too_small_for_it(width: int, height: int, lamp: Lamp) -> None:
    assert add_lamp(np.zeros((height, width, 3), np.uint8), lamp).shape == (height, width, 3)
