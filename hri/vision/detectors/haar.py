"""Faces by a Haar cascade: a classifier that comes with OpenCV and needs no other file.

Viola and Jones, "Rapid object detection using a boosted cascade of simple features" (2001).
"""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from hri.core.signals import FaceBox
from hri.vision.detectors.picture import Gray

FOLDER = Path(cv2.__file__).parent / "data"
CASCADE = "haarcascade_frontalface_alt2.xml"
SCALE_STEP = 1.2
"""Each size that is tried is so much larger than the one before."""
NEIGHBORS = 3
"""How many findings nearly on top of each other make a face."""
SMALLEST = 40
"""Pixels, width of the smallest face."""
AROUND = 0.4
"""Part of a box by which the search around it reaches further on each side."""
SHRINK = 0.7
"""The search around a box takes faces of at least this part of its width."""


class HaarDetector:
    """Finds upright faces that look toward the camera, within about 20 degrees."""

    def __init__(self) -> None:
        self._cascade = cv2.CascadeClassifier(str(FOLDER / CASCADE))

    def largest(self, gray: Gray) -> FaceBox | None:
        """The largest face of the picture, in its pixels."""
        return self._search(gray, 0, 0, SMALLEST)

    def near(self, gray: Gray, box: FaceBox) -> FaceBox | None:
        """The face that is now where one has been; much faster than a search everywhere."""
        left, top = (
            max(0, int(box.x - AROUND * box.width)),
            max(0, int(box.y - AROUND * box.height)),
        )
        right = int(box.x + (1 + AROUND) * box.width)
        bottom = int(box.y + (1 + AROUND) * box.height)
        part = gray[top : max(top, bottom), left : max(left, right)]
        return self._search(part, left, top, max(SMALLEST, int(SHRINK * box.width)))

    def _search(self, gray: Gray, left: int, top: int, smallest: int) -> FaceBox | None:
        if min(gray.shape) < smallest:
            return None
        found = self._cascade.detectMultiScale(
            gray, SCALE_STEP, NEIGHBORS, minSize=(smallest, smallest)
        )
        if not len(found):
            return None
        # Position decides between faces of one size: the order they come in is not fixed.
        x, y, width, height = max(
            np.asarray(found).tolist(), key=lambda face: (face[2] * face[3], *face)
        )
        return FaceBox(float(left + x), float(top + y), float(width), float(height))
