"""What moves before a camera at rest: a thing is turned while it is held up, the room is not.

Each pixel of a picture is compared with the same one of the pictures before (Stauffer and Grimson,
"Adaptive background mixture models for real-time tracking", 1999, with one Gaussian of a few
seconds): where it changes by more than noise, something has moved.
"""

from __future__ import annotations

from collections import deque

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.vision.objects.cutout import Mask

PICTURES, LEAST_PICTURES = 8, 3
"""How many are compared, some 0.4 s apart."""
CHANGED = 6.0
"""Standard deviation, of 255 levels, from which a pixel changes by more than a camera's noise."""
JOINED = 9
"""Pixels across, within which what moves is of one thing: inside of plain areas nothing changes."""
SMALLEST, LARGEST = 0.01, 0.5
"""Parts of the picture: noise, and the camera itself or all of a person, move as well."""
ASIDE = 0.25
"""Parts of the picture, by which the middle of what is held up may lie beside its center."""
DARKEST = 4.0
"""Levels that are added where two brightnesses are divided."""


class MovingThing:
    """Remembers the last pictures, and finds what moves in the middle of them."""

    def __init__(self) -> None:
        self._pictures: deque[NDArray[np.float32]] = deque(maxlen=PICTURES)

    def look(self, image: Image) -> Mask | None:
        """1 within the convex hull of what moves; None when too little does, too much, or aside.

        `image` is uint8, [height, width, 3], some 160 pixels wide; another size is a new start.
        """
        picture = image.astype(np.float32)
        if self._pictures and self._pictures[0].shape != picture.shape:
            self._pictures.clear()
        if self._pictures:  # a camera that sets its exposure moves nothing
            first = self._pictures[0]
            picture *= np.median((first + DARKEST) / (picture + DARKEST))
        self._pictures.append(np.minimum(picture, 255))
        if len(self._pictures) < LEAST_PICTURES:
            return None
        return _hull(np.array(self._pictures).std(axis=0).max(axis=2) > CHANGED)


def _hull(changes: NDArray[np.bool_]) -> Mask | None:
    mask = changes.astype(np.uint8)
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (JOINED, JOINED))
    # Without a margin, closing would join what moves to the edge of the picture.
    wide = np.pad(mask, JOINED)
    closed = cv2.morphologyEx(wide, cv2.MORPH_CLOSE, kernel)[JOINED:-JOINED, JOINED:-JOINED]
    found, _ = cv2.findContours(
        cv2.morphologyEx(closed, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8)),
        cv2.RETR_EXTERNAL,
        cv2.CHAIN_APPROX_SIMPLE,
    )
    if not found:
        return None
    hull = cv2.convexHull(max(found, key=cv2.contourArea))
    whole: Mask = np.zeros(mask.shape, np.uint8)
    cv2.fillPoly(whole, [hull], 1)
    left, top, width, height = cv2.boundingRect(hull)
    sides = np.array([mask.shape[1], mask.shape[0]])
    aside = np.abs(np.array([left + width / 2, top + height / 2]) / sides - 0.5)
    if aside.max() > ASIDE or not SMALLEST <= whole.mean() <= LARGEST:
        return None
    return whole
