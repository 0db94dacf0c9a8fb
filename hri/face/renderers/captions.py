"""Writes captions across the bottom of a picture."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Picture, ImageDraw, ImageFont

from hri.core.signals import Image


@dataclass(frozen=True)
class Lettering:
    """How large the letters are, and how many lines of them there may be."""

    height: float
    """Of the letters, of the height of the picture."""
    lines: int


SPOKEN = Lettering(0.055, 2)
SMALL = Lettering(0.032, 5)
MOST_LETTERS = 400
"""What is longer does not fit anyway."""
_SHADE = 0.55
"""How much the band behind the letters darkens the picture."""


def add_caption(image: Image, text: str, lettering: Lettering = SPOKEN) -> Image:
    """A copy of the picture with the text over a dark band; the picture itself without text.

    A text that is too long for the lines of the lettering ends in "...".
    """
    if not text.strip():
        return image
    height, width = image.shape[:2]
    letters = _letters(text, width, height, lettering)
    captioned = image.copy()
    band = captioned[height - len(letters) :].astype(np.float32) * (1 - _SHADE)
    share = letters[..., None].astype(np.float32) / 255
    captioned[height - len(letters) :] = np.rint(band + (255 - band) * share).astype(np.uint8)
    return captioned


@lru_cache(maxsize=8)
def _letters(text: str, width: int, height: int, lettering: Lettering) -> NDArray[np.uint8]:
    """The band with its letters, [band height, width], 0 to 255."""
    size = max(8, round(height * lettering.height))
    font = ImageFont.load_default(size)
    assert isinstance(font, ImageFont.FreeTypeFont), "Pillow is built with FreeType"
    lines = _wrapped(" ".join(text.split())[:MOST_LETTERS], font, width - 2 * size, lettering.lines)
    step = round(size * 1.3)
    band = Picture.new("L", (width, min(step * len(lines) + size, height)))
    draw = ImageDraw.Draw(band)
    for number, line in enumerate(lines):
        x = (width - draw.textlength(line, font)) / 2
        draw.text((x, size / 2 + number * step), line, fill=255, font=font)
    return np.asarray(band)


def _wrapped(text: str, font: ImageFont.FreeTypeFont, width: float, most: int) -> list[str]:
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}".strip()
        if font.getlength(longer) <= width or not lines[-1]:
            lines[-1] = longer
        elif len(lines) < most:
            lines.append(word)
        else:
            lines[-1] += " ..."
            break
    return [_cut(line, font, width) for line in lines]


def _cut(line: str, font: ImageFont.FreeTypeFont, width: float) -> str:
    """The line, shortened when even one word is too wide."""
    if font.getlength(line) <= width:
        return line
    line = line.removesuffix(" ...")
    while line and font.getlength(line + "...") > width:
        line = line[:-1]
    return line.rstrip() + "..."


def add_label(image: Image, text: str) -> Image:
    """A copy of the picture with a name in its upper left corner."""
    picture = Picture.fromarray(image)
    size = max(10, image.shape[0] // 16)
    draw = ImageDraw.Draw(picture)
    draw.text((size // 2, size // 3), text, fill=(255, 255, 255), font=ImageFont.load_default(size))
    return np.array(picture)
