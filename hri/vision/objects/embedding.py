"""A network that describes a picture by a vector: alike for pictures of one thing."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core import paths
from hri.core.errors import HriError
from hri.core.native_path import native_path
from hri.core.signals import Image

SIDE = 224
"""Pixels of the picture that the network sees."""
MEAN = np.array([0.485, 0.456, 0.406], np.float32)
DEVIATION = np.array([0.229, 0.224, 0.225], np.float32)
"""Of the colors of ImageNet, 0 to 1, as networks of its kind expect them."""
REMEDY = f"give an ONNX file with one input, [1, 3, {SIDE}, {SIDE}], and vectors as its output"


class Embedding:
    """A network in ONNX, such as one of ImageNet without its last layer."""

    def __init__(self, path: Path) -> None:
        """Raises HriError for a file that is missing, or is not such a network."""
        if not paths.exists(path):
            raise HriError(f"{path}: not found - {REMEDY}")
        try:
            with native_path(path) as name:
                self._network = cv2.dnn.readNetFromONNX(name)
            self.describe(np.zeros((SIDE, SIDE, 3), np.uint8))
        except cv2.error as error:
            reason = str(error.err or error).strip().splitlines()[0]
            raise HriError(f"{path}: not a network for pictures: {reason} - {REMEDY}") from error

    def describe(self, image: Image) -> NDArray[np.float32]:
        """A vector of length 1; the cosine of two is how alike they are, -1 to 1.

        `image` is uint8, [height, width, 3], RGB.
        """
        resized = cv2.resize(image, (SIDE, SIDE), interpolation=cv2.INTER_LINEAR)
        scaled = (np.asarray(resized, np.float32) / 255 - MEAN) / DEVIATION
        self._network.setInput(np.ascontiguousarray(scaled.transpose(2, 0, 1)[None]))
        vector = np.asarray(self._network.forward(), np.float32).ravel()
        return vector / max(float(np.linalg.norm(vector)), 1e-9)
