import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from hri.core.errors import NotAvailable
from hri.core.signals import Image, Landmarks
from hri.simulation.people.actors import ACTORS, Appearance, render_people
from hri.simulation.people.lens import Lens
from hri.vision.detectors.detector_choice import Detectors
from hri.vision.detectors.face import FoundFace
from hri.vision.detectors.mesh import (
    LEFT_EYE,
    RIGHT_EYE,
    FaceMesh,
    Region,
    region_of,
    region_of_landmarks,
)
from hri.vision.face_models import DETECTOR
from hri.vision.head_pose import head_pose

ADA = Appearance("ada", center=(320, 240), height=180)
AT_ADA = Region(320, 260, 200)
TIP_OF_NOSE, CHIN = 4, 152


def see(*persons: Appearance) -> Image:
    return render_people(persons, (640, 480))


def found(detectors: Detectors, image: Image) -> FoundFace:
    return detectors.finder.find(image)[0]


def followed(mesh: FaceMesh, images: list[Image], region: Region) -> Iterator[Landmarks]:
    """The landmarks in each picture, each looked for where the ones before were."""
    for image in images:
        fitted = mesh.fit(image, region)
        assert fitted is not None
        assert fitted.presence > 0.9
        region = region_of_landmarks(fitted.landmarks)
        yield fitted.landmarks


@pytest.mark.parametrize("actor", ACTORS)
@pytest.mark.parametrize("height", [80, 300])
def test_the_mesh_fits_every_face_that_is_found(
    detectors: Detectors, mesh: FaceMesh, actor: str, height: float
) -> None:
    image = see(Appearance(actor, center=(320, 240), height=height))
    fitted = mesh.fit(image, region_of(found(detectors, image)))
    assert fitted is not None
    assert fitted.presence > 0.9
    right, left, nose, chin = fitted.landmarks[[RIGHT_EYE, LEFT_EYE, TIP_OF_NOSE, CHIN]]
    assert right[0] < nose[0] < left[0]
    assert right[1] < nose[1] < chin[1]
    assert nose[2] < right[2], "the nose is nearer to the camera"
    assert abs(nose[0] - 320) < 0.06 * height


def test_a_small_face_in_the_dark_is_one_all_the_same(detectors: Detectors, mesh: FaceMesh) -> None:
    lens = Lens(noise=9, light=0.4, blur=0.8, seed=5)
    still = render_people([Appearance("chima", center=(160, 120), height=90)])
    images = [lens.take(still, index) for index in range(8)]
    region = region_of(found(detectors, images[0]))
    assert len(list(followed(mesh, images, region))) == len(images)


def test_a_place_without_a_face_has_no_presence(mesh: FaceMesh) -> None:
    for image in (see(), np.zeros((480, 640, 3), np.uint8), np.full((480, 640, 3), 200, np.uint8)):
        fitted = mesh.fit(image, AT_ADA)
        assert fitted is None or fitted.presence < 0.5


def test_the_landmarks_follow_a_face_that_moves_and_comes_nearer(mesh: FaceMesh) -> None:
    steps = [
        replace(ADA, center=(320 + 8 * step, 240 + 3 * step), height=180 + 4 * step)
        for step in range(10)
    ]
    landmarks = list(followed(mesh, [see(step) for step in steps], AT_ADA))
    moved = landmarks[-1][TIP_OF_NOSE] - landmarks[0][TIP_OF_NOSE]
    assert moved[:2] == pytest.approx((8 * 9, 3 * 9), abs=8)
    grown = [np.linalg.norm(points[LEFT_EYE] - points[RIGHT_EYE]) for points in landmarks]
    assert grown[-1] / grown[0] == pytest.approx(216 / 180, abs=0.04)


def test_the_landmarks_stay_where_they_are_in_a_picture_of_another_size(mesh: FaceMesh) -> None:
    image = see(ADA)
    large = np.asarray(cv2.resize(image, None, fx=5, fy=5), np.uint8)
    small = list(followed(mesh, [image] * 4, AT_ADA))[-1]
    giant = list(followed(mesh, [large] * 4, Region(1600, 1300, 1000)))[-1]
    # Pixels have their middle at whole numbers.
    assert np.abs((small[:, :2] + 0.5) * 5 - 0.5 - giant[:, :2]).max() < 5 * 2


def test_a_face_half_outside_of_the_picture_costs_nothing(mesh: FaceMesh) -> None:
    for center in ((0, 240), (639, 240), (320, 479), (0, 0)):
        image = see(replace(ADA, center=center))
        fitted = mesh.fit(image, Region(*center, 200))
        assert fitted is None or np.isfinite(fitted.landmarks).all()


@pytest.mark.parametrize(
    "region",
    [
        Region(math.nan, 260, 200),
        Region(320, 260, math.inf),
        Region(320, 260, 200, math.nan),
        Region(320, 260, 3),
        Region(320, 260, -200),
        Region(320, 260, 1e6),
        Region(-1, 260, 200),
        Region(320, 480, 200),
    ],
)
def test_a_region_that_is_none_has_no_mesh(mesh: FaceMesh, region: Region) -> None:
    assert mesh.fit(see(ADA), region) is None


def test_a_strip_of_a_picture_costs_nothing(mesh: FaceMesh) -> None:
    for shape in ((32, 8192, 3), (8192, 32, 3)):
        region = Region(shape[1] / 2, shape[0] / 2, 2 * 8192.0)
        assert mesh.fit(np.zeros(shape, np.uint8), region) is not None


@pytest.mark.parametrize(
    "image",
    [np.zeros((480, 640), np.uint8), np.zeros((480, 640, 3), np.uint16), None],
    ids=["gray", "16 bits", "nothing"],
)
def test_what_is_no_picture_has_no_mesh(mesh: FaceMesh, image: Image) -> None:
    assert mesh.fit(image, AT_ADA) is None


def test_another_network_is_no_mesh(face_models: Path) -> None:
    with pytest.raises(NotAvailable, match=r"damaged, or another network - hri models fetch face"):
        FaceMesh(face_models / DETECTOR.name)


def test_the_region_of_landmarks_stands_upright_around_them() -> None:
    generator = np.random.default_rng(0)
    upright = generator.uniform(-50, 50, (468, 3)).astype(np.float32)
    upright[RIGHT_EYE], upright[LEFT_EYE] = (-30, -10, 0), (30, -10, 0)
    for roll in (-1.2, -0.3, 0.0, 0.7):
        cosine, sine = math.cos(roll), math.sin(roll)
        turned = upright.copy()
        turned[:, :2] = upright[:, :2] @ np.array([[cosine, sine], [-sine, cosine]]) + (300, 200)
        region = region_of_landmarks(turned)
        assert region.roll == pytest.approx(roll, abs=1e-4)
        assert region.side == pytest.approx(region_of_landmarks(upright).side, abs=0.01)
        assert (region.x, region.y) == pytest.approx((300, 200), abs=2)


class TestPoseOfTheMesh:
    """Against the angles that the picture was made with."""

    def poses(self, mesh: FaceMesh, images: list[Image], region: Region) -> np.ndarray:
        return np.degrees([head_pose(points) for points in followed(mesh, images, region)])

    @pytest.mark.parametrize("actor", ACTORS)
    def test_tells_how_far_a_head_nods_and_turns(
        self, detectors: Detectors, mesh: FaceMesh, actor: str
    ) -> None:
        swings = 10 * np.sin(np.linspace(0, 2.5 * np.pi, 12))
        still = Appearance(actor, center=(160, 120), height=130)
        region = region_of(found(detectors, render_people([still])))
        for axis, name in enumerate(("pitch", "yaw")):
            images = [
                render_people([replace(still, **{name: math.radians(swing)})]) for swing in swings
            ]
            told = self.poses(mesh, images, region)[4:, axis]
            gain, offset = np.polyfit(swings[4:], told, 1)
            assert gain == pytest.approx(1, abs=0.2)
            assert abs(offset) < 6

    def test_tells_how_far_a_head_is_tilted(self, mesh: FaceMesh) -> None:
        for roll in (-20, 0, 20):
            leaned = see(replace(ADA, roll=math.radians(roll)))
            pose = self.poses(mesh, [leaned] * 4, replace(AT_ADA, roll=math.radians(roll)))[-1]
            assert pose[2] == pytest.approx(roll, abs=3)
            assert abs(pose[1]) < 5

    @pytest.mark.parametrize("light", [1.0, 0.4])
    def test_is_quiet_while_the_picture_is_noisy(self, mesh: FaceMesh, light: float) -> None:
        lens = Lens(noise=4, light=light, seed=1)
        image = see(ADA)
        told = self.poses(mesh, [lens.take(image, i) for i in range(24)], AT_ADA)[4:]
        quiet = 0.3 if light == 1.0 else 0.6
        assert told.std(axis=0).max() < quiet

    def test_a_mouth_that_talks_does_not_nod(self, mesh: FaceMesh) -> None:
        images = [see(replace(ADA, mouth=opening)) for opening in (0, 0, 0, 0.5, 1, 0.5, 0, 1)]
        told = self.poses(mesh, images, AT_ADA)[3:, 0]
        assert np.ptp(told) < 2.5
