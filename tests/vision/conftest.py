from pathlib import Path

import pytest

from hri.core.models import folder_of
from hri.vision.detectors.blazeface import BlazeFace
from hri.vision.detectors.detector_choice import Detectors
from hri.vision.detectors.mesh import FaceMesh
from hri.vision.face_models import DETECTOR, FACE, MESH

FACE_MODELS = folder_of(FACE.name)
"""Told before a test changes where models are kept."""


@pytest.fixture(scope="session")
def face_models() -> Path:
    """The folder with both face networks; without them a test is skipped."""
    if not all((FACE_MODELS / part.name).is_file() for part in (DETECTOR, MESH)):
        pytest.skip("the face networks are not here: hri models fetch face")
    return FACE_MODELS


@pytest.fixture(scope="session")
def mesh(face_models: Path) -> FaceMesh:
    return FaceMesh(face_models / MESH.name)


@pytest.fixture
def blazeface(face_models: Path) -> BlazeFace:
    return BlazeFace(face_models / DETECTOR.name)


@pytest.fixture
def detectors(blazeface: BlazeFace, mesh: FaceMesh) -> Detectors:
    return Detectors(blazeface, mesh)
