import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.signals import Landmarks
from hri.vision.head_pose import FACE, NUMBERS, PITCH_GAIN, head_pose

ANGLES = st.floats(-1.0, 1.0)
POINTS = 468


def turned(pitch: float, yaw: float, roll: float) -> Landmarks:
    """The average face, turned as the signals' conventions say."""
    cp, sp, cy, sy = math.cos(pitch), math.sin(pitch), math.cos(yaw), math.sin(yaw)
    cr, sr = math.cos(roll), math.sin(roll)
    nod = np.array([[1, 0, 0], [0, cp, sp], [0, -sp, cp]])
    turn = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    tilt = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
    landmarks = np.full((POINTS, 3), 1e3, np.float32)
    landmarks[NUMBERS] = (FACE @ (tilt @ turn @ nod).T * (1, 1, -1)).astype(np.float32)
    return landmarks


@given(ANGLES, ANGLES, ANGLES)
def test_the_angles_that_a_face_was_turned_by_are_told(
    pitch: float, yaw: float, roll: float
) -> None:
    expected = (pitch / PITCH_GAIN, yaw, roll)
    assert head_pose(turned(pitch, yaw, roll)) == pytest.approx(expected, abs=1e-4)


@given(ANGLES, ANGLES, st.floats(-500, 500), st.floats(20, 400))
def test_neither_place_nor_size_changes_them(
    pitch: float, yaw: float, place: float, size: float
) -> None:
    landmarks = turned(pitch, yaw, 0.1)
    moved = landmarks * np.float32(size) + np.float32([place, -place, place / 2])
    assert head_pose(moved) == pytest.approx(head_pose(landmarks), abs=1e-3)


@given(ANGLES, ANGLES, ANGLES)
def test_a_mirrored_face_turns_and_tilts_the_other_way(
    pitch: float, yaw: float, roll: float
) -> None:
    there = turned(pitch, yaw, roll)
    mirrored = turned(pitch, -yaw, -roll)
    told, other = head_pose(there), head_pose(mirrored)
    assert other == pytest.approx((told[0], -told[1], -told[2]), abs=1e-4)


@pytest.mark.parametrize("broken", [math.nan, math.inf, -math.inf])
def test_landmarks_that_are_no_numbers_have_no_pose(broken: float) -> None:
    landmarks = turned(0, 0, 0)
    landmarks[NUMBERS[3], 1] = broken
    assert all(map(math.isnan, head_pose(landmarks)))


def test_points_that_all_fall_together_have_a_finite_pose() -> None:
    assert all(map(math.isfinite, head_pose(np.zeros((POINTS, 3), np.float32))))
