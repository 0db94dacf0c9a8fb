import math

import numpy as np
import pytest

from hri.core.signals import FaceBox
from hri.simulation.head import render_head
from hri.vision.detectors.flow import FaceFlow
from hri.vision.detectors.haar import HaarDetector
from hri.vision.detectors.picture import Gray, gray_picture

BOX = FaceBox(120, 90, 80, 80)


def view(
    pitch: float = 0.0,
    yaw: float = 0.0,
    center: tuple[float, float] = (160.0, 120.0),
    height: float = 105.0,
) -> Gray:
    """The person's head, angles in degrees."""
    image = render_head(math.radians(pitch), math.radians(yaw), 0.0, center=center, height=height)
    picture = gray_picture(image)
    assert picture is not None
    return picture.gray


def test_a_large_picture_becomes_small_and_a_small_one_stays() -> None:
    large = gray_picture(np.zeros((480, 640, 3), np.uint8))
    small = gray_picture(np.zeros((240, 320, 3), np.uint8)[:, ::-1])
    assert large is not None
    assert small is not None
    assert (large.gray.shape, large.scale) == ((240, 320), 2.0)
    assert (small.gray.shape, small.scale) == ((240, 320), 1.0)


@pytest.mark.parametrize(
    "image",
    [
        np.zeros((240, 320), np.uint8),
        np.zeros((240, 320, 4), np.uint8),
        np.zeros((240, 320, 3), np.uint16),
        np.zeros((240, 320, 3), np.float32),
        np.zeros((1, 1, 3), np.uint8),
        np.zeros((0, 0, 3), np.uint8),
        None,
        "picture",
    ],
)
def test_what_is_no_picture_is_none(image: object) -> None:
    assert gray_picture(image) is None  # type: ignore[arg-type]


@pytest.mark.parametrize("height", [70, 105, 160])
def test_the_cascade_finds_the_face_at_all_poses_of_a_conversation(height: float) -> None:
    detector = HaarDetector()
    for pitch in (-20, 0, 20):
        for yaw in (-20, 0, 20):
            box = detector.largest(view(pitch, yaw, height=height))
            assert box is not None, (pitch, yaw)
            assert (
                math.hypot(box.x + box.width / 2 - 160, box.y + box.height / 2 - 125) < height / 3
            )


def test_no_face_is_found_in_an_empty_room_or_in_noise() -> None:
    detector = HaarDetector()
    noise = np.random.default_rng(0).integers(0, 255, (240, 320), np.uint8)
    assert detector.largest(view(center=(2000, 0))) is None
    assert detector.largest(noise) is None


def test_the_search_near_a_box_finds_the_face_that_moved_a_little() -> None:
    detector = HaarDetector()
    before = detector.largest(view())
    assert before is not None
    after = detector.near(view(center=(175, 110)), before)
    assert after is not None
    assert after.x - before.x == pytest.approx(15, abs=6)
    assert detector.near(view(center=(400, 110)), before) is None
    assert detector.near(view(), FaceBox(-500, -500, 80, 80)) is None


def test_the_flow_of_a_face_that_moves_or_comes_nearer() -> None:
    flow = FaceFlow()
    flow.start(view(), BOX)
    shift = flow.follow(view(center=(163, 118)))
    assert shift is not None
    assert (shift.x, shift.y) == (pytest.approx(3, abs=0.3), pytest.approx(-2, abs=0.3))
    assert abs(shift.growth) < 0.01
    nearer = flow.follow(view(center=(163, 118), height=110))
    assert nearer is not None
    assert nearer.growth == pytest.approx(110 / 105 - 1, abs=0.015)


def test_the_flow_of_a_head_that_turns() -> None:
    flow = FaceFlow()
    flow.start(view(), BOX)
    turned = flow.follow(view(yaw=5))
    bowed = flow.follow(view(yaw=5, pitch=4))
    assert turned is not None
    assert bowed is not None
    assert turned.x > 2 > abs(turned.y), "to the person's left is to the right of the picture"
    assert bowed.y > 1.5 > abs(bowed.x)
    assert abs(turned.growth) < 0.01


def test_the_flow_knows_when_it_cannot_tell() -> None:
    flow = FaceFlow()
    assert flow.follow(view()) is None
    flow.start(np.full((240, 320), 128, np.uint8), BOX)
    assert flow.follow(view()) is None
    flow.start(view(), BOX)
    assert flow.follow(view()[:200]) is None, "a picture of another size"
    flow.start(view(), FaceBox(-90, -90, 50, 50))
    assert flow.follow(view()) is None
    flow.start(view(), BOX)
    assert flow.follow(np.random.default_rng(0).integers(0, 255, (240, 320), np.uint8)) is None
