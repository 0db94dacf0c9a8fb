"""Lamps in the upper corners of the face: green while the camera watches, red while it records."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Picture, ImageDraw, ImageFont

from hri.core.signals import Image

RADIUS = 0.011
"""Of the height of the picture; never less than a pixel and a half."""
MARGIN = 0.045
"""Of the height of the picture, from the upper and the nearer edge to the middle of a lamp."""
HALO = 2.2
"""Radii to which its light reaches."""
GLOW = 0.35
"""How much its light covers beside the lamp itself."""
LETTERS = 3.2
"""Radii that the letters beside a lamp are high."""
LEGIBLE = 8
"""Pixels; a word that would be lower than this is left out."""


@dataclass(frozen=True, slots=True)
class Lamp:
    """What a lamp looks like, and where it is."""

    color: tuple[int, int, int]
    """Red, green, blue."""
    is_left: bool
    word: str = ""
    """The text to the right of it."""


WATCHING = Lamp((92, 214, 140), is_left=False)
RECORDING = Lamp((255, 84, 72), is_left=True, word="REC")


def add_lamp(image: Image, lamp: Lamp = WATCHING) -> Image:
    """A copy of the picture with the lamp lit."""
    height, width = image.shape[:2]
    cover = _cover(height, lamp.word)
    side = len(cover)
    top = min(max(0, round(MARGIN * height - side / 2)), max(0, height - side))
    left = top if lamp.is_left else max(0, min(width, width - top) - side)
    part = (slice(top, top + side), slice(left, left + cover.shape[1]))
    lit = image.copy()
    share = cover[: lit[part].shape[0], : lit[part].shape[1], None]
    lit[part] = np.rint(lit[part] * (1 - share) + np.array(lamp.color) * share).astype(np.uint8)
    return lit


@lru_cache(maxsize=8)
def _cover(height: int, word: str) -> NDArray[np.float32]:
    """How much of each pixel a lamp and its word cover, for a picture so high; [side, width]."""
    radius = max(1.5, RADIUS * height)
    reach = int(np.ceil(HALO * radius))
    line = np.arange(-reach, reach + 1)
    away = np.hypot(line, line[:, None])
    disc = np.clip(radius + 0.5 - away, 0, 1)
    halo = GLOW * np.clip(1 - away / (HALO * radius), 0, 1)
    lamp = np.maximum(disc, halo).astype(np.float32)
    size = round(LETTERS * radius)
    return np.hstack([lamp, _letters(word, len(lamp), size)]) if size >= LEGIBLE else lamp


def _letters(word: str, side: int, size: int) -> NDArray[np.float32]:
    """A word in a strip that is `side` pixels high, 0 to 1."""
    font = ImageFont.load_default(size)
    strip = Picture.new("L", (round(font.getlength(word)), side))
    ImageDraw.Draw(strip).text((0, side / 2), word, fill=255, font=font, anchor="lm")
    return np.asarray(strip, np.float32) / np.float32(255)
