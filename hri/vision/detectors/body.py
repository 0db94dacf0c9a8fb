"""Finds people who stand upright by the outline of their bodies, also from behind.

Dalal and Triggs, "Histograms of oriented gradients for human detection" (2005), with the weights
that come with OpenCV.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import cv2
import numpy as np

from hri.core.signals import FaceBox, Image

SURE = 1.0
"""Weight from which a body counts: what is less sure is furniture as often."""
WIDEST = 640
"""Pixels; a larger picture is shrunk."""
STRIDE, PADDING, STEP = (8, 8), (16, 16), 1.05
"""Of the search, pixels; and the factor from one size to the next."""
SEARCHED_SIZE, WIDE_STEP = 125.0, 1.1
"""Pixels from crown to feet to which a picture is scaled in which one body is expected; and the
factor from one size to the next there."""
AROUND, ABOVE = 0.45, 0.2
"""How much of the picture to each side of its middle, above and below, as parts of its size."""
MARGIN = 0.125
"""Part of what is found, at each side, that lies beside the body."""
SMALLEST = (64, 128)
"""Pixels; a smaller picture has no one in it who could be found."""


@lru_cache(maxsize=1)
def _detector() -> Any:
    detector = cv2.HOGDescriptor()
    detector.setSVMDetector(np.array(cv2.HOGDescriptor.getDefaultPeopleDetector()))
    return detector


def find_bodies(image: Image) -> list[tuple[FaceBox, float]]:
    """Boxes of bodies in pixels, each with how sure it is, 0 to 1; the surest first."""
    scale = min(1.0, WIDEST / max(image.shape[:2]))
    gray = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY)
    size = round(image.shape[1] * scale), round(image.shape[0] * scale)
    if size[0] < SMALLEST[0] or size[1] < SMALLEST[1]:
        return []
    small = cv2.resize(gray, size, interpolation=cv2.INTER_AREA)
    found, weights = _detector().detectMultiScale(
        small, winStride=STRIDE, padding=PADDING, scale=STEP
    )
    bodies = [
        (_box(np.asarray(place, float) / scale), float(weight / (1 + weight)))
        for place, weight in zip(found, np.ravel(weights), strict=True)
        if weight >= SURE
    ]
    return sorted(bodies, key=lambda body: -body[1])


def find_body_at(image: Image, expected: FaceBox) -> FaceBox | None:
    """The body, from crown to feet in pixels, about where and as large as one is expected.

    None when there is none. Only the picture around it is searched, in a fiftieth of the time.
    """
    height, width = image.shape[:2]
    x, size = expected.x + expected.width / 2, expected.height
    is_there = SEARCHED_SIZE / 8 <= size <= height and 0 <= x <= width
    if not (is_there and -size <= expected.y <= height):
        return None
    left, right = max(0, int(x - AROUND * size)), min(width, int(x + AROUND * size))
    top = max(0, int(expected.y - ABOVE * size))
    bottom = min(height, int(expected.y + (1 + ABOVE) * size))
    scale = SEARCHED_SIZE / size
    gray = cv2.cvtColor(image[top:bottom, left:right], cv2.COLOR_RGB2GRAY)
    small = cv2.resize(
        gray,
        (round((right - left) * scale), round((bottom - top) * scale)),
        interpolation=cv2.INTER_AREA,
    )
    if small.shape[1] < SMALLEST[0] or small.shape[0] < SMALLEST[1]:
        return None
    found, weights = _detector().detectMultiScale(
        small, winStride=STRIDE, padding=PADDING, scale=WIDE_STEP
    )
    if not len(found) or max(np.ravel(weights)) < SURE:
        return None
    best = np.asarray(found[int(np.argmax(weights))], float)
    return _box(best / scale + (left, top, 0, 0))


def _box(place: Any) -> FaceBox:
    x, y, width, height = place.tolist()
    inward, down = MARGIN * width, MARGIN * height / 2
    return FaceBox(x + inward, y + down, width - 2 * inward, height - 2 * down)
