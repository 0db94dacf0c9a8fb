"""Networks of TensorFlow Lite files: both that run them answer alike."""

import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from hri.core.errors import NotAvailable
from hri.core.fetch.archive import Part
from hri.vision.detectors.network import OnnxNetwork, OpenCvNetwork, Tensor, load_network
from hri.vision.detectors.tflite import read_tflite
from hri.vision.detectors.tflite_to_onnx import onnx_of
from hri.vision.face_models import DETECTOR, HAND, MESH, PALM
from tests.recorded import picture

SIDES = {DETECTOR: 128, MESH: 192, PALM: 192, HAND: 224}
parts = pytest.mark.parametrize("part", SIDES, ids=lambda part: part.name)


def shown(side: int) -> Tensor:
    portrait = picture("obama")
    height = portrait.shape[0]
    square = portrait[: height // 2, : height // 2]
    small = cv2.resize(square, (side, side), interpolation=cv2.INTER_AREA)
    return np.asarray(small, np.float32) / np.float32(255)


def content_of(models: Path, part: Part) -> bytes:
    file = models / part.name
    if not file.is_file():
        pytest.skip(f"{part.name} is not here: hri models fetch face")
    return file.read_bytes()


@parts
def test_onnxruntime_and_opencv_give_the_same_answers(face_models: Path, part: Part) -> None:
    pytest.importorskip("onnxruntime")
    content, seen = content_of(face_models, part), shown(SIDES[part])
    ours = OnnxNetwork(content).run(seen)
    theirs = OpenCvNetwork(content, face_models / part.name).run(seen)
    if part is HAND:
        # OpenCV 4.14 misplaces its points by up to 3 pixels, and those in meters by 0.3:
        # TensorFlow's runtime has those of onnxruntime.
        (points, *ours), (others, *theirs) = ours[:3], theirs[:3]
        np.testing.assert_allclose(points, others, atol=4)
    for own, other in zip(ours, theirs, strict=True):
        np.testing.assert_allclose(own, other, atol=0.02)


@parts
def test_two_that_were_read_give_the_same_numbers(face_models: Path, part: Part) -> None:
    content, seen = content_of(face_models, part), shown(SIDES[part])
    file = face_models / part.name
    first, second = (load_network(file, part.sha256, "") for _ in range(2))
    for one, other in zip(first.run(seen), second.run(seen), strict=True):
        assert one.tobytes() == other.tobytes()
    assert onnx_of(content) == onnx_of(content)


@parts
def test_a_file_says_what_goes_in_and_comes_out(face_models: Path, part: Part) -> None:
    network = read_tflite(content_of(face_models, part))
    (number,) = network.inputs
    side = SIDES[part]
    assert network.tensors[number].shape == (1, side, side, 3)
    known = {
        number,
        *(index for index, one in enumerate(network.tensors) if one.constant is not None),
    }
    for operation in network.operations:
        assert known.issuperset(operation.inputs)
        known.add(operation.output)
    assert known.issuperset(network.outputs)


def test_without_onnxruntime_opencv_runs_it(
    face_models: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    network = load_network(face_models / DETECTOR.name, DETECTOR.sha256, "")
    assert isinstance(network, OpenCvNetwork)
    assert [len(answer) for answer in network.run(shown(128))] == [14336, 896]


def test_a_file_with_another_checksum_is_refused(face_models: Path) -> None:
    with pytest.raises(NotAvailable, match="damaged, or another network - the remedy"):
        load_network(face_models / DETECTOR.name, MESH.sha256, "the remedy")
