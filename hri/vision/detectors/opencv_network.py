"""A neural network read from a file for OpenCV to run."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError, NotAvailable
from hri.core.reading import read_bytes

Tensor = NDArray[np.float32]

LARGEST = 64_000_000
"""Bytes; no network of ours is larger."""


def read_network_file(file: Path, remedy: str) -> bytes:
    """The network in a file. Raises NotAvailable with the remedy for other files."""
    try:
        return read_bytes(file, "network", LARGEST)
    except HriError as error:
        raise NotAvailable(f"{error}, or {remedy}") from error


class OpenCvNetwork:
    """A TensorFlow Lite network that takes one square picture."""

    def __init__(self, file: Path, sha256: str, remedy: str) -> None:
        """Raises NotAvailable when the file is not the one of this checksum."""
        content = read_network_file(file, remedy)
        # Checked first: what OpenCV makes of a damaged file is not to be relied on.
        if hashlib.sha256(content).hexdigest() != sha256:
            raise NotAvailable(f"{file}: damaged, or another network - {remedy}")
        try:
            self._network = cv2.dnn.readNetFromTFLite(np.frombuffer(content, np.uint8))
        except (cv2.error, AttributeError) as error:
            remedy = "pip install 'opencv-python-headless>=4.10,<5'"
            raise NotAvailable(f"{file}: this OpenCV cannot read it - {remedy}") from error
        self._outputs: Sequence[str] = self._network.getUnconnectedOutLayersNames()

    def run(self, picture: Tensor) -> list[Tensor]:
        """Its answers to a picture of shape [side, side, 3], each as one row of numbers."""
        self._network.setInput(cv2.dnn.blobFromImage(picture))
        answers = self._network.forward(self._outputs)
        return [np.asarray(answer, np.float32).ravel() for answer in answers]
