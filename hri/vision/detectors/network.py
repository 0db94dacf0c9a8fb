"""The networks of faces and hands: TensorFlow Lite files, run by the fastest that is here.

onnxruntime takes a third to a fifth of the time of OpenCV for those of hands, and a sixth less for
seeing faces. It comes with the natural voice; where that is not, OpenCV runs them.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any, Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError, NotAvailable
from hri.core.reading import read_bytes
from hri.vision.detectors.tflite import read_tflite
from hri.vision.detectors.tflite_to_onnx import onnx_of

Tensor = NDArray[np.float32]

LARGEST = 64_000_000
"""Bytes; no network of ours is larger."""


class Network(Protocol):
    """What takes one square picture."""

    def run(self, picture: Tensor) -> list[Tensor]:
        """Its answers to a picture of shape [side, side, 3], each as one row of numbers, in the
        order of the file.
        """


def load_network(file: Path, sha256: str, remedy: str) -> Network:
    """The network in a TensorFlow Lite file.

    Raises NotAvailable, with the remedy, when the file is not the one of this checksum.
    """
    content = read_network_file(file, remedy)
    # Checked first: what is made of a damaged file is not to be relied on.
    if hashlib.sha256(content).hexdigest() != sha256:
        raise NotAvailable(f"{file}: damaged, or another network - {remedy}")
    try:
        return OnnxNetwork(content)
    except ImportError:
        return OpenCvNetwork(content, file)


def read_network_file(file: Path, remedy: str) -> bytes:
    """The network in a file. Raises NotAvailable with the remedy for other files."""
    try:
        return read_bytes(file, "network", LARGEST)
    except HriError as error:
        raise NotAvailable(f"{error}, or {remedy}") from error


class OnnxNetwork:
    """A network that onnxruntime runs on one thread: the same picture gives the same answers."""

    def __init__(self, content: bytes) -> None:
        """Of a TensorFlow Lite file. Raises ImportError without onnxruntime."""
        import onnxruntime

        onnxruntime.disable_telemetry_events()  # where it was imported before `hri`
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = options.inter_op_num_threads = 1
        options.log_severity_level = 4
        self._session: Any = onnxruntime.InferenceSession(
            onnx_of(content), options, ["CPUExecutionProvider"]
        )
        self._input: str = self._session.get_inputs()[0].name

    def run(self, picture: Tensor) -> list[Tensor]:
        channels_first = np.ascontiguousarray(picture.transpose(2, 0, 1)[None], np.float32)
        answers = self._session.run(None, {self._input: channels_first})
        return [np.asarray(answer, np.float32).ravel() for answer in answers]


class OpenCvNetwork:
    """A network that OpenCV runs."""

    def __init__(self, content: bytes, file: Path) -> None:
        """Raises NotAvailable where this OpenCV cannot read it."""
        try:
            self._network = cv2.dnn.readNetFromTFLite(np.frombuffer(content, np.uint8))
        except (cv2.error, AttributeError) as error:
            remedy = "pip install 'opencv-python-headless>=4.10,<5'"
            raise NotAvailable(f"{file}: this OpenCV cannot read it - {remedy}") from error
        # OpenCV's order of the outputs is another than the file's.
        read = read_tflite(content)
        self._outputs = [read.tensors[number].name for number in read.outputs]

    def run(self, picture: Tensor) -> list[Tensor]:
        self._network.setInput(cv2.dnn.blobFromImage(picture))
        answers = self._network.forward(self._outputs)
        return [np.asarray(answer, np.float32).ravel() for answer in answers]
