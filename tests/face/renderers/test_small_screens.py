from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.face.renderers.small_screens import PIXELS, SmallScreen, one_bit, pages, rgb565, rows
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager


def plain(gray: int, width: int = 32, height: int = 16) -> np.ndarray:
    return np.full((height, width, 3), gray, np.uint8)


def test_rows_begin_at_the_left_with_the_highest_bit() -> None:
    bits = np.zeros((2, 10), bool)
    bits[0, 0] = bits[0, 9] = bits[1, 7] = True
    assert rows(bits) == bytes([0b1000_0000, 0b0100_0000, 0b0000_0001, 0])


def test_pages_are_columns_of_eight_with_the_topmost_in_the_lowest_bit() -> None:
    bits = np.zeros((16, 3), bool)
    bits[0, 0] = bits[7, 1] = bits[8, 2] = bits[9, 2] = True
    assert pages(bits) == bytes([1, 128, 0, 0, 0, 3])


def test_pages_need_whole_pages() -> None:
    with pytest.raises(HriError, match="multiple of 8"):
        pages(np.zeros((12, 8), bool))


@pytest.mark.parametrize(
    ("color", "word"),
    [((255, 0, 0), 0xF800), ((0, 255, 0), 0x07E0), ((0, 0, 255), 0x001F), ((8, 4, 8), 0x0821)],
)
def test_rgb565_has_its_bits_where_displays_want_them(
    color: tuple[int, int, int], word: int
) -> None:
    picture = np.full((1, 2, 3), color, np.uint8)
    assert rgb565(picture) == word.to_bytes(2, "big") * 2
    assert rgb565(picture, "little") == word.to_bytes(2, "little") * 2


@given(st.integers(0, 255))
def test_a_dithered_gray_lights_as_many_pixels_as_it_is_light(gray: int) -> None:
    assert one_bit(plain(gray), dither=True).mean() == pytest.approx(gray / 255, abs=0.02)


def test_without_dither_half_decides() -> None:
    assert not one_bit(plain(127)).any()
    assert one_bit(plain(128)).all()


@pytest.mark.parametrize("dither", [True, False])
def test_black_stays_black_and_white_white(dither: bool) -> None:
    assert not one_bit(plain(0), dither=dither).any()
    assert one_bit(plain(255), dither=dither).all()


def test_a_picture_is_fitted_into_the_middle() -> None:
    bits = one_bit(plain(255, 64, 64), (128, 64))
    assert bits.shape == (64, 128)
    assert bits[:, 32:96].all()
    assert not bits[:, :32].any()
    assert not bits[:, 96:].any()


@pytest.mark.parametrize("size", [(0, 64), (128, 100_000)])
def test_a_size_that_no_display_has_is_refused(size: tuple[int, int]) -> None:
    with pytest.raises(HriError, match="display"):
        one_bit(plain(9), size)


def opened(**parameters: str) -> SmallScreen:
    manager = ResourceManager((), FakeClock())
    screen = SmallScreen(Description("screen", "Hri.SmallScreen", parameters), manager)
    screen.activate()
    return screen


@pytest.mark.parametrize("pixels", PIXELS)
def test_a_small_screen_holds_the_last_picture(tmp_path: Path, pixels: str) -> None:
    file, length = tmp_path / "display", 32 * 16 * (2 if "rgb" in pixels else 1 / 8)
    screen = opened(file=str(file), width="32", height="16", pixels=pixels)
    assert screen.is_one_bit == (pixels in ("rows", "pages"))
    screen.show(plain(0), 0.0)
    screen.show(plain(255), 0.1)
    assert file.read_bytes() == b"\xff" * round(length)
    screen.show(plain(0, 64, 64), 0.2)
    screen.deactivate()
    assert file.read_bytes() == bytes(round(length))


@pytest.mark.parametrize(
    ("parameters", "what"),
    [
        ({"pixels": "rgb555"}, 'did you mean "rgb565"'),
        ({"pixels": "pages", "height": "20"}, "multiple of 8"),
        ({"file": "/no/such/fb1"}, "cannot be written"),
    ],
)
def test_a_small_screen_that_cannot_be_is_refused(
    tmp_path: Path, parameters: dict[str, str], what: str
) -> None:
    with pytest.raises(HriError, match=what):
        opened(**{"file": str(tmp_path / "display"), **parameters})
