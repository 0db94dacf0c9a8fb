"""What moves is found, also by a camera that turns and drives; a still room shows nothing."""

import math

import cv2
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.vision.camera_view import CameraView
from hri.vision.motion.motion_finder import CameraMove, MotionFinder
from tests.recorded import picture

VIEW = CameraView(1.05)
SIZE = 320, 240
FOCAL = VIEW.focal_length(SIZE)
STEP = 1 / 15


@pytest.fixture(scope="module")
def wall():
    """A photograph that is much wider than a picture of it."""
    return cv2.resize(picture("coffee"), (900, 600), interpolation=cv2.INTER_AREA)


def seen(wall, heading=0.0, distance=1.0, thing=None, seed=0, noise=3.0):
    """The wall from a camera that is turned (radians to the left) and that far away."""
    turn = cv2.Rodrigues(np.array([0.0, heading, 0.0]))[0]
    camera = np.array([[FOCAL, 0, SIZE[0] / 2], [0, FOCAL, SIZE[1] / 2], [0, 0, 1]])
    scale = 1.2 / wall.shape[1]
    flat = np.array([[scale, 0, -0.6], [0, scale, -0.4], [0, 0, distance * 0.6]])
    image = cv2.warpPerspective(wall, camera @ turn @ flat, SIZE, borderMode=cv2.BORDER_REFLECT)
    if thing is not None:
        x, y = thing
        patch = np.random.default_rng(3).integers(0, 255, (60, 40, 3)).astype(np.uint8)
        image[y : y + 60, x : x + 40] = cv2.GaussianBlur(patch, (0, 0), 2.0)
    drawn = image + np.random.default_rng(seed).normal(0, noise, image.shape)
    return np.clip(drawn, 0, 255).astype(np.uint8)


def compared(first, second, before=None, after=None, elapsed=STEP):
    finder = MotionFinder(VIEW)
    assert finder.look(first, 0.0, before or CameraMove(), 0.0) is None
    return finder.look(second, elapsed, after or CameraMove(), 0.0)


@pytest.mark.proves("R09")
@settings(max_examples=10)
@given(st.integers(20, 240), st.integers(20, 150), st.integers(4, 9), st.integers(0, 99))
def test_a_thing_that_moves_is_found_where_it_is(wall, x, y, step, seed):
    found = compared(
        seen(wall, thing=(x, y), seed=seed), seen(wall, thing=(x + step, y), seed=seed + 1)
    )
    largest = found.motion.regions[0]
    assert abs(largest.x - (x + step / 2 + 20)) < 24
    assert abs(largest.y - (y + 30)) < 28
    assert largest.bearing == pytest.approx(math.atan2(160 - largest.x, FOCAL), abs=1e-3)


@settings(max_examples=10)
@given(st.floats(0, 8), st.floats(0.9, 1.1), st.integers(0, 999))
def test_a_still_room_does_not_move_whatever_the_noise_and_the_light(wall, noise, light, seed):
    first = seen(wall, seed=seed, noise=noise)
    second = np.clip(seen(wall, seed=seed + 1, noise=noise) * light, 0, 255).astype(np.uint8)
    assert compared(first, second).motion.regions == ()


@pytest.mark.proves("R09")
@pytest.mark.parametrize("degrees", [-3.0, -1.0, -0.18, 0.1, 1.0, 2.5])
def test_what_moves_because_the_camera_turns_is_subtracted(wall, degrees):
    turn = math.radians(degrees)
    before, after = CameraMove(0.3), CameraMove(0.3 + turn)
    still = compared(seen(wall), seen(wall, turn, seed=1), before, after)
    assert still.motion.regions == ()
    x = 120 + round(FOCAL * turn) + 8
    walker = compared(
        seen(wall, thing=(120, 80)), seen(wall, turn, thing=(x, 80), seed=1), before, after
    )
    assert abs(walker.motion.regions[0].x - (x + 16)) < 30


def test_someone_who_fills_most_of_the_picture_moves_also_while_the_camera_turns(wall):
    before, after = CameraMove(0.0), CameraMove(math.radians(0.3))
    cloth = np.random.default_rng(4).integers(0, 255, (24, 20, 3)).astype(np.uint8)
    patch = cv2.resize(cloth, (200, 240), interpolation=cv2.INTER_CUBIC)
    first, second = seen(wall), seen(wall, after.heading, seed=1)
    first[:, 60:260], second[:, 67:267] = patch, patch
    largest = compared(first, second, before, after).motion.regions[0]
    assert largest.width > 150
    assert abs(largest.x - 163) < 30


@pytest.mark.proves("R09")
@pytest.mark.parametrize(("near", "far"), [(0.96, 1.0), (0.98, 1.0)])
def test_a_camera_that_drives_sees_no_motion_in_a_still_room_but_the_time_to_contact(
    wall, near, far
):
    finder = MotionFinder(VIEW)
    finder.look(seen(wall, distance=far), 0.0, CameraMove(), 0.0)
    ahead = CameraMove(0.0, far - near, 0.0)
    found = finder.look(seen(wall, distance=near, seed=1), STEP, ahead, 0.0)
    assert found.motion.regions == ()
    contact = near / (far - near) * STEP
    assert found.time_to_contact == pytest.approx(contact, rel=0.03)
    assert found.expansion == pytest.approx(1 / contact, rel=0.03)


def test_a_camera_that_backs_off_meets_nothing(wall):
    found = compared(seen(wall, distance=0.95), seen(wall, distance=1.0))
    assert found.expansion < 0
    assert found.time_to_contact == math.inf


@pytest.mark.parametrize("elapsed", [0.0, -1.0, 1.5])
def test_after_a_pause_or_a_step_back_in_time_nothing_is_known(wall, elapsed):
    assert compared(seen(wall), seen(wall), elapsed=elapsed) is None


@pytest.mark.parametrize("shape", [(1, 1), (31, 500), (500, 31), (97, 131), (480, 640)])
def test_covered_cameras_of_any_size_see_nothing_move(shape):
    black = np.zeros((*shape, 3), np.uint8)
    found = compared(black, black)
    assert found is None or found.motion.regions == ()


def test_another_size_of_the_picture_begins_anew(wall):
    assert compared(seen(wall), np.zeros((480, 640, 3), np.uint8)) is None


def test_the_same_film_gives_the_same_twice(wall):
    frames = [seen(wall, thing=(100 + 5 * number, 90), seed=number) for number in range(6)]

    def watched():
        finder = MotionFinder(VIEW)
        found = [
            finder.look(frame, number * STEP, CameraMove(), 0.0)
            for number, frame in enumerate(frames)
        ]
        return [one.motion.regions for one in found if one is not None]

    assert watched() == watched()
