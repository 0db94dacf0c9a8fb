"""Covers of magazines that nobody printed: the issues of one look alike, but for text and picture.

An issue that was not learned is the hardest thing that must not get a name.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from benchmarks.vision.stamps import SIDE, Stamp
from hri.core.signals import Image

WIDTH = 270
"""Pixels; the height is that of all stamps."""
EDGE = 6
"""Pixels around it that are not paper: the thing is all of a cover, not the picture on it."""
FONTS = (
    cv2.FONT_HERSHEY_DUPLEX,
    cv2.FONT_HERSHEY_TRIPLEX,
    cv2.FONT_HERSHEY_COMPLEX,
    cv2.FONT_HERSHEY_SCRIPT_COMPLEX,
)
LETTERS = "abcdefghijklmnoprstuvwyz"
ISSUES = 7
"""Of a magazine, at most, so that each has another picture."""
SEED = 560_000


def cover(series: int, issue: int, pictures: Sequence[Stamp]) -> Stamp:
    """An issue of a magazine; `pictures` are what its cover may show.

    Title, colors and places are those of the series; picture, headlines and number the issue's.
    """
    layout = np.random.default_rng(SEED + series)
    inside = np.random.default_rng((SEED, series, issue))
    paper = tuple(int(part) for part in layout.integers(120, 256, 3))
    ink = tuple(int(part) for part in layout.integers(0, 90, 3))
    page = np.full((SIDE, WIDTH, 3), paper, np.uint8)
    font = FONTS[int(layout.integers(len(FONTS)))]
    if layout.random() < 0.5:
        band = tuple(int(part) for part in layout.integers(60, 256, 3))
        cv2.rectangle(page, (0, 0), (WIDTH, 70), band, -1)
    _fitting(page, _word(layout, 6).upper(), (14, 58), WIDTH - 28, font, ink, 3)
    top = int(layout.integers(90, 130))
    height = int(layout.integers(110, 150))
    ground = tuple(int(part) for part in inside.integers(60, 256, 3))
    cv2.rectangle(page, (14, top), (WIDTH - 14, top + height), ground, -1)
    shown = pictures[(series * ISSUES + issue) % len(pictures)]
    _draw(page, shown, (WIDTH // 2, top + height // 2), height)
    _fitting(page, f"No. {issue + 1:>3}", (14, 84), 60, font, ink, 1)
    for line in range(int(layout.integers(2, 5))):
        text = " ".join(_word(inside, int(inside.integers(3, 9))) for _ in range(4))
        place = 14, top + height + 24 + 24 * line
        _fitting(page, text, place, WIDTH - 28, font, ink, 1 + (line == 0))
    soft = np.asarray(cv2.GaussianBlur(page, (0, 0), 0.6), np.uint8)
    mask: Image = np.zeros((SIDE, WIDTH), np.uint8)
    mask[EDGE:-EDGE, EDGE:-EDGE] = 255
    return Stamp(f"magazine {series} issue {issue}", soft, mask)


def _word(dice: np.random.Generator, letters: int) -> str:
    return "".join(LETTERS[int(index)] for index in dice.integers(0, len(LETTERS), letters))


def _fitting(
    page: Image,
    text: str,
    place: tuple[int, int],
    width: int,
    font: int,
    ink: tuple[int, ...],
    thickness: int,
) -> None:
    (wide, _), _ = cv2.getTextSize(text, font, 1.0, thickness)
    cv2.putText(page, text, place, font, width / wide, ink, thickness, cv2.LINE_AA)


def _draw(page: Image, stamp: Stamp, middle: tuple[int, int], height: int) -> None:
    scale = 0.95 * height / max(stamp.picture.shape[:2])
    size = tuple(max(1, int(side * scale)) for side in stamp.picture.shape[1::-1])
    thing = cv2.resize(stamp.picture, size, interpolation=cv2.INTER_AREA)
    mask = cv2.resize(stamp.mask, size, interpolation=cv2.INTER_AREA) > 127
    left, top = middle[0] - size[0] // 2, middle[1] - size[1] // 2
    page[top : top + size[1], left : left + size[0]][mask] = thing[mask]
