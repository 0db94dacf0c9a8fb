"""The drawn faces as the networks see them: faces in every respect that matters here."""

import math

import numpy as np
import pytest

from hri.core.errors import NotAvailable
from hri.simulation.people.actors import ACTORS, Appearance, render_people
from hri.simulation.people.lens import Lens
from hri.vision.detectors.detector_choice import Detectors, load_detectors
from hri.vision.detectors.mesh import FittedFace, region_of, region_of_landmarks
from hri.vision.face_models import find_face_models
from hri.vision.head_pose import head_pose

TURNS = (-12.0, -6.0, 0.0, 6.0, 12.0)
"""Degrees."""


@pytest.fixture(scope="module")
def detectors() -> Detectors:
    try:
        find_face_models()
    except NotAvailable as error:
        pytest.skip(str(error))
    return load_detectors()


def fitted(detectors: Detectors, shown: Appearance, lens: Lens) -> FittedFace:
    image = lens.take(render_people([shown], (320, 240)), 0)
    found = detectors.finder.find(image)
    assert len(found) == 1
    assert detectors.mesh is not None
    first = detectors.mesh.fit(image, region_of(found[0]))
    assert first is not None
    second = detectors.mesh.fit(image, region_of_landmarks(first.landmarks))
    assert second is not None
    return second


@pytest.mark.parametrize("actor", ACTORS)
def test_a_face_seems_to_turn_as_far_as_it_does(detectors: Detectors, actor: str) -> None:
    for axis, name in enumerate(("pitch", "yaw")):
        seen = []
        for turn in TURNS:
            angles = {name: math.radians(turn)}
            shown = Appearance(actor, height=150.0, **angles)  # type: ignore[arg-type]
            face = fitted(detectors, shown, Lens(noise=2.0))
            seen.append(math.degrees(head_pose(face.landmarks)[axis]))
        gain, offset = np.polyfit(TURNS, seen, 1)
        assert gain == pytest.approx(1.0, abs=0.15), name
        assert abs(offset) < 8


@pytest.mark.parametrize("actor", ACTORS)
def test_a_small_face_and_one_in_the_dark_is_a_face(detectors: Detectors, actor: str) -> None:
    """A head of 75 pixels is a face of 60."""
    dark = Lens(noise=4.0, light=0.4, flicker=0.15, blur=0.8)
    for height, lens in ((75.0, Lens(noise=9.0)), (105.0, dark)):
        for pitch, yaw in ((0.0, 0.0), (0.2, 0.0), (0.0, 0.3)):
            shown = Appearance(actor, pitch, yaw, height=height)
            assert fitted(detectors, shown, lens).presence > 0.9
