"""Faces by a Haar cascade: a classifier that comes with OpenCV and needs no other file.

Viola and Jones, "Rapid object detection using a boosted cascade of simple features" (2001).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np

from hri.core.native_path import native_path
from hri.core.signals import FaceBox, Image
from hri.vision.detectors.face import FoundFace, merged
from hri.vision.detectors.preprocessing import gray_picture
from hri.vision.detectors.search_squares import Square, whole

FOLDER = Path(cv2.__file__).parent / "data"
CASCADE = "haarcascade_frontalface_alt2.xml"
SCALE_STEP = 1.2
"""Ratio of each tried size to the one before."""
NEIGHBORS = 3
"""How many findings nearly on top of each other make a face."""
SMALLEST = 40
"""Pixels, width of the smallest face."""


class HaarDetector:
    """Finds upright faces that look toward the camera, within about 20 degrees."""

    def __init__(self) -> None:
        with native_path(FOLDER / CASCADE) as name:
            self._cascade = cv2.CascadeClassifier(name)

    def squares(self, width: int, height: int) -> list[Square]:
        """One: it looks at whole pictures."""
        return [whole(width, height)]

    def find(self, image: Image, squares: Sequence[Square] | None = None) -> list[FoundFace]:
        """All faces of the picture, the surest first; none for an invalid picture."""
        picture = gray_picture(image)
        if picture is None or min(picture.gray.shape) < SMALLEST:
            return []
        boxes, neighbors = self._cascade.detectMultiScale2(
            picture.gray, SCALE_STEP, NEIGHBORS, minSize=(SMALLEST, SMALLEST)
        )
        rows = np.asarray(boxes, np.float64).reshape(-1, 4) * picture.scale
        # The more findings there are around a face, the surer it is: half at the least of them.
        return merged(
            FoundFace(FaceBox(*row), count / (count + NEIGHBORS))
            for row, count in zip(rows.tolist(), np.ravel(neighbors).tolist(), strict=True)
        )
