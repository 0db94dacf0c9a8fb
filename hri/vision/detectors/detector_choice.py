"""Chooses the detectors of people by the installed models."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from hri.core import paths
from hri.core.errors import HriError
from hri.vision.detectors.blazeface import BlazeFace
from hri.vision.detectors.face import FaceFinder
from hri.vision.detectors.haar import HaarDetector
from hri.vision.detectors.mesh import FaceMesh
from hri.vision.detectors.yunet import YuNet
from hri.vision.face_models import DETECTOR, MESH, find_face_models

T = TypeVar("T")

AUTO, HAAR = "auto", "haar"
"""Settings; anything else is the path of a YuNet file."""


@dataclass(frozen=True, slots=True)
class Detectors:
    """A face finder, and a model that fits a mesh to the faces."""

    finder: FaceFinder
    mesh: FaceMesh | None = None
    """None when its file is not there: faces are then boxes that optical flow follows."""
    problems: tuple[str, ...] = ()
    """The unavailable parts of the setting, with their remedies."""


def load_detectors(setting: str = AUTO) -> Detectors:
    """The detectors of a setting, or the nearest that can be had: then `problems` says why.

    "auto": BlazeFace and the mesh when they are fetched, else Haar's cascade alone; "haar": the
    cascade alone in any case; else the path of a YuNet file: that, and the mesh.
    """
    if setting == HAAR:
        return Detectors(HaarDetector())
    problems: list[str] = []
    finder: FaceFinder | None = None
    if setting != AUTO:
        finder = _tried(lambda: YuNet(paths.expanded(setting)), problems)
    if finder is None:
        finder = _tried(lambda: BlazeFace(find_face_models() / DETECTOR.name), problems)
    mesh = _tried(lambda: FaceMesh(find_face_models() / MESH.name), problems)
    # One problem may be that of both.
    return Detectors(finder or HaarDetector(), mesh, tuple(dict.fromkeys(problems)))


def _tried(load: Callable[[], T], problems: list[str]) -> T | None:
    try:
        return load()
    except (HriError, RuntimeError) as error:  # the latter of a home folder that nobody has
        problems.append(str(error))
        return None
