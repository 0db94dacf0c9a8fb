"""Pictures as the bytes that small displays take: one bit a pixel, or RGB565.

bits = one_bit(render_face("eyes", "happy"), (128, 64))
oled.write(pages(bits))                     # SSD1306 and its like
lcd.write(rgb565(render_face(size=(240, 240))))     # ST7789, ILI9341
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Image
from hri.hal.drivers.scaling import by_area
from hri.hal.picture import fitted
from hri.hal.screen import Screen

Bits = NDArray[np.bool_]
"""Lit pixels, [height, width]."""

PAGE = 8
"""Rows that share a byte in a display with pages."""
LARGEST = 2048
"""Pixels along a side; no small display has more."""


def one_bit(image: Image, size: tuple[int, int] | None = None, *, dither: bool = False) -> Bits:
    """Which pixels are lit, [height, width]: those that are light, after shrinking to `size`.

    `size` is width and height; the picture is fitted into the middle of it, the rest stays dark.
    What is lighter than half is lit, which keeps the lines of a face made for such a display clean.
    With `dither`, grays become a pattern of dots (Bayer's, 8x8) that does not crawl when something
    moves: for faces with shades. Raises HriError for a size out of range.
    """
    picture = image if size is None else _fitted(image, size)
    gray = cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY)
    if not dither:
        return np.asarray(gray >= 128)
    height, width = gray.shape
    tiles = (-(-height // PAGE), -(-width // PAGE))
    return np.asarray(gray > np.tile(_THRESHOLDS, tiles)[:height, :width])


def black_and_white(bits: Bits) -> Image:
    """Bits as a picture, [height, width, 3]."""
    return np.repeat(np.where(bits, np.uint8(255), np.uint8(0))[..., None], 3, axis=2)


def rows(bits: Bits) -> bytes:
    """Row by row, eight pixels a byte, the leftmost in the highest bit (as in PBM files).

    A row whose width is not a multiple of eight is filled up with dark pixels.
    """
    return np.packbits(bits, axis=1).tobytes()


def pages(bits: Bits) -> bytes:
    """In pages of eight rows, as SSD1306, SH1106 and PCD8544 want them: a byte is a column of a
    page, its topmost pixel in the lowest bit.

    Raises HriError for a height that is not a multiple of eight.
    """
    height, width = bits.shape
    if height % PAGE:
        raise HriError(f"{height} rows make no whole pages of {PAGE} - use a multiple of {PAGE}")
    columns = bits.reshape(height // PAGE, PAGE, width)
    return np.packbits(columns, axis=1, bitorder="little").tobytes()


def rgb565(image: Image, order: Literal["big", "little"] = "big") -> bytes:
    """Row by row, two bytes a pixel: 5 bits of red, 6 of green, 5 of blue.

    "big" endian is what displays on SPI take (ST7789, ILI9341), "little" what the frame buffers of
    Linux are (`/dev/fb1`).
    """
    red, green, blue = (image[..., channel].astype(np.uint16) for channel in range(3))
    packed = (red >> 3) << 11 | (green >> 2) << 5 | blue >> 3
    return packed.astype(">u2" if order == "big" else "<u2").tobytes()


def _fitted(image: Image, size: tuple[int, int]) -> Image:
    """The whole picture, as large as the size allows, in the middle of black."""
    width, height = size
    if not (1 <= width <= LARGEST and 1 <= height <= LARGEST):
        raise HriError(f"a display of {width}x{height} - give sides from 1 to {LARGEST} pixels")
    return fitted(image, width, height, by_area)


def _bayer(size: int) -> NDArray[np.uint8]:
    """Bayer's matrix of thresholds, 0 to 255: each doubling splits every dot in four."""
    matrix = np.zeros((1, 1), int)
    while len(matrix) < size:
        matrix = np.block([[4 * matrix, 4 * matrix + 2], [4 * matrix + 3, 4 * matrix + 1]])
    return np.asarray((matrix + 0.5) * 256 / size**2, np.uint8)


_THRESHOLDS = _bayer(PAGE)

PIXELS: dict[str, Callable[[Image], bytes]] = {
    "rgb565": lambda image: rgb565(image, "little"),
    "rgb565-big": rgb565,
    "rows": lambda image: rows(one_bit(image)),
    "pages": lambda image: pages(one_bit(image)),
    "rows-dithered": lambda image: rows(one_bit(image, dither=True)),
    "pages-dithered": lambda image: pages(one_bit(image, dither=True)),
}
"""How a display wants its bytes, by name."""
ONE_BIT = ("rows", "pages")
"""Those of which a pixel is lit when it is lighter than half."""


class SmallScreen(Screen):
    """Writes each picture over the last one in a file, as bytes for a small display.

    `file` is such as /dev/fb1, the frame buffer that Linux has for a display on SPI; `pixels` is a
    name of `PIXELS`.
    """

    parameters = ("file", "width", "height", "pixels")

    def _open(self) -> None:
        self._take_size()
        name = self.description.text("pixels", "rgb565")
        if name not in PIXELS:
            raise self.description.error(
                "pixels", f'no pixels "{name}"', did_you_mean(name, PIXELS)
            )
        if name.startswith("pages") and self.height % PAGE:
            what = f"{self.height} rows make no whole pages"
            raise self.description.error("height", what, f"use a multiple of {PAGE}")
        self._bytes = PIXELS[name]
        self.is_one_bit = name in ONE_BIT
        path = Path(self.description.text("file"))
        try:
            self._file = path.open("wb", buffering=0)
        except OSError as error:
            why = f"{path} cannot be written: {error.strerror}"
            raise self.not_available(why, "check `file`, and who may write it") from error

    def show(self, image: Image, time: float) -> None:
        if image.shape[:2] != (self.height, self.width):
            image = _fitted(image, (self.width, self.height))
        self._file.seek(0)
        self._file.write(self._bytes(image))

    def _close(self) -> None:
        self._file.close()
