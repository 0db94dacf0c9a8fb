"""Faces by YuNet, OpenCV's own detector: for small, far, dark and turned faces.

Wu et al., "YuNet: a tiny millisecond-level face detector" (2023). Its file,
face_detection_yunet_2023mar.onnx of the OpenCV zoo (MIT), comes with no package: the user has it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np

from hri.core.errors import NotAvailable
from hri.core.signals import FaceBox, Image
from hri.vision.detectors.face import FoundFace, merged
from hri.vision.detectors.network import read_network_file
from hri.vision.detectors.preprocessing import is_picture
from hri.vision.detectors.search_squares import Square, whole

SEEN_SIDE = 320
"""Pixels of the longer side of the picture that is looked at: 8 ms, faces from 24 of 640."""
LEAST_SCORE = 0.6
SAME = 0.3
"""Part by which boxes overlap that are of one face."""
MOST = 100
"""Proposals that are looked at."""
POINTS = 5
"""Eyes, tip of the nose, corners of the mouth; the person's right one first."""


class YuNet:
    """Finds faces. Raises NotAvailable when the file is not the network."""

    def __init__(self, file: Path) -> None:
        remedy = "take face_detection_yunet_2023mar.onnx of the OpenCV zoo"
        content = np.frombuffer(read_network_file(file, remedy), np.uint8)
        size = SEEN_SIDE, SEEN_SIDE
        try:
            self._network = cv2.FaceDetectorYN.create(
                "onnx", content, np.zeros(0, np.uint8), size, LEAST_SCORE, SAME, MOST
            )
            # A network of something else shows itself only when it runs.
            self._network.detect(np.zeros((SEEN_SIDE, SEEN_SIDE, 3), np.uint8))
        except cv2.error as error:
            raise NotAvailable(f"{file}: damaged, or not YuNet - {remedy}") from error

    def squares(self, width: int, height: int) -> list[Square]:
        """One: it looks at whole pictures."""
        return [whole(width, height)]

    def find(self, image: Image, squares: Sequence[Square] | None = None) -> list[FoundFace]:
        """All faces of the picture, the surest first; none for an invalid picture."""
        if not is_picture(image):
            return []
        height, width = image.shape[:2]
        scale = max(1.0, max(height, width) / SEEN_SIDE)
        size = max(1, round(width / scale)), max(1, round(height / scale))
        small = cv2.resize(image, size, interpolation=cv2.INTER_AREA)
        self._network.setInputSize(size)
        _, rows = self._network.detect(cv2.cvtColor(small, cv2.COLOR_RGB2BGR))
        if rows is None:
            return []
        found = []
        for row in np.asarray(rows, np.float64):
            x, y, across, down = (row[:4] * scale).tolist()
            *others, right, left = row[4:14].reshape(POINTS, 2) * scale
            points = np.array([*others, (right + left) / 2], np.float32)
            found.append(FoundFace(FaceBox(x, y, across, down), float(row[14]), points))
        return merged(found)
