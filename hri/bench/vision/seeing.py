"""The chain from pictures to people and gestures, as a robot runs it, but in one thread."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator

from hri.core.signals import Frame, People
from hri.simulation.people.actors import Optics
from hri.vision.camera_view import CameraView
from hri.vision.detectors.detector_choice import AUTO, load_detectors
from hri.vision.face_models import find_face_models
from hri.vision.tracking.people import PeopleTracker


def tracker(optics: Optics, setting: str = AUTO) -> PeopleTracker:
    """One that begins to see. Raises NotAvailable when the networks are not fetched."""
    if setting == AUTO:
        find_face_models()
    return PeopleTracker(load_detectors(setting), CameraView(optics.field_of_view))


def seen(
    frames: Iterable[Frame], optics: Optics, setting: str = AUTO
) -> Iterator[tuple[People, float]]:
    """The people in each picture, and the CPU milliseconds that it took to see them."""
    sees = tracker(optics, setting)
    for frame in frames:
        begun = time.thread_time()
        people = sees.see(frame)
        yield people, (time.thread_time() - begun) * 1e3
