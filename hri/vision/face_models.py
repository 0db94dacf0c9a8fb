"""The networks that see faces and hands: MediaPipe's, in a wheel that still carries them."""

from __future__ import annotations

from pathlib import Path

from hri.core.errors import NotAvailable
from hri.core.fetch.archive import Part
from hri.core.fetch.pypi_wheel import Wheel
from hri.core.models import Download, folder_of

_WHEEL = "mediapipe-0.10.21-cp311-cp311-manylinux_2_28_x86_64.whl"
_FOLDER = "ad/83/56f760fecdc60de84c529d6c05c9dfc7d972617c6632bd254d5e021e5b16"

DETECTOR = Part(
    "mediapipe/modules/face_detection/face_detection_short_range.tflite",
    "bbff11cebd1eb27a1e004cae0b0e63ec8c551cbf34a4451148b4908b8db3eca8",
)
MESH = Part(
    "mediapipe/modules/face_landmark/face_landmark.tflite",
    "1055cb9d4a9ca8b8c688902a3a5194311138ba256bcc94e336d8373a5f30c814",
)
PALM = Part(
    "mediapipe/modules/palm_detection/palm_detection_lite.tflite",
    "e9a4aaddf90dda56a87235303cf00e4c2d3fb28725f68fd88772997dac905c18",
)
HAND = Part(
    "mediapipe/modules/hand_landmark/hand_landmark_lite.tflite",
    "048edd3645c9bf7397d19a9f6e3a42957d6e414c9bea6598030a2e9b624156e6",
)
LICENSE = Part(
    "mediapipe-0.10.21.dist-info/LICENSE",
    "8707eef0533987efc5b155d64761eeb6e20793f50b9bd1a68dad1cf4719d0ed8",
)
FACE = Download(
    "face",
    "finds faces, how they are turned, and hands",
    "Apache-2.0",
    f"https://files.pythonhosted.org/packages/{_FOLDER}/{_WHEEL}",
    35_622_638,
    "05dc4a9e593655a79558d05d6227d31018c2537a4bd3362b51e230cf22aecfe3",
    parts=(DETECTOR, MESH, PALM, HAND, LICENSE),
    wheel=Wheel("mediapipe==0.10.21", "3.11", "manylinux_2_28_x86_64"),
)
MODELS = (FACE,)
REMEDY = f"hri models fetch {FACE.name}"


def find_face_models() -> Path:
    """The folder with the networks. Raises NotAvailable when they are not here."""
    folder = folder_of(FACE.name)
    if not folder.is_dir():
        raise NotAvailable(f"the networks that see faces are not here - {REMEDY}")
    return folder


def find_hand_models() -> Path:
    """The folder with the networks of hands. Raises NotAvailable when one is not here.

    Whoever fetched the networks of faces before has none of hands.
    """
    folder = folder_of(FACE.name)
    if not all((folder / part.name).is_file() for part in (PALM, HAND)):
        raise NotAvailable(f"the networks that see hands are not here - {REMEDY}")
    return folder
