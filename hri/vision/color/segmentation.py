"""Blobs of learned colors in a picture: a table gives a mask, and its connected parts are blobs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.vision.color.color_mixture import Table

LEAST = 0.001
"""Share of the picture below which a blob is noise."""
DARKEST = 30
"""Luma, 0 to 255, below which a pixel has no color that could be recognized."""
LIKELY = 2.0
"""Log-likelihood ratio from which a pixel has the color."""


@dataclass(frozen=True, slots=True)
class ColorBlob:
    """A part of a picture that has one color."""

    name: str
    """Of the color."""
    x: float
    """Of its center, pixels from the left."""
    y: float
    """Of its center, pixels from the top."""
    box: tuple[int, int, int, int]
    """Left, top, width and height in pixels."""
    area: int
    """Pixels."""
    outline: tuple[tuple[int, int], ...]
    """Corners, x and y in pixels."""


def segment(image: Image, tables: Mapping[str, Table]) -> tuple[ColorBlob, ...]:
    """The blobs of all colors, the largest first. A pixel has the one color that fits it best."""
    height, width = image.shape[:2]
    if not tables or not height or not width:
        return ()
    pixels = np.asarray(cv2.cvtColor(image, cv2.COLOR_RGB2YCrCb), np.uint8)
    names = list(tables)
    index = (pixels[..., 1].astype(np.uint16) << 8) | pixels[..., 2]
    which = _label_table([tables[name] for name in names]).ravel().take(index)
    which[pixels[..., 0] < DARKEST] = 0
    least = max(LEAST * height * width, 1.0)
    found = [
        blob
        for index, name in enumerate(names, start=1)
        for blob in _blobs(name, np.asarray(which == index, np.uint8), least)
    ]
    return tuple(sorted(found, key=lambda blob: (-blob.area, blob.name, blob.box)))


def _label_table(tables: list[Table]) -> NDArray[np.uint8]:
    """By chroma, the number of the color from 1; 0 for the background."""
    stacked = np.stack(tables)
    return np.where(stacked.max(axis=0) >= LIKELY, stacked.argmax(axis=0) + 1, 0).astype(np.uint8)


def _blobs(name: str, mask: NDArray[np.uint8], least: float) -> list[ColorBlob]:
    count, labels, stats, centers = cv2.connectedComponentsWithStats(mask)
    found = []
    for part in range(1, count):
        left, top, width, height, area = (int(number) for number in stats[part])
        if area < least:
            continue
        own = np.asarray(labels[top : top + height, left : left + width] == part, np.uint8)
        outlines, _ = cv2.findContours(
            own, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE, offset=(left, top)
        )
        outline = tuple((int(x), int(y)) for x, y in max(outlines, key=len).reshape(-1, 2))
        x, y = (float(number) for number in centers[part])
        found.append(ColorBlob(name, x, y, (left, top, width, height), area, outline))
    return found
