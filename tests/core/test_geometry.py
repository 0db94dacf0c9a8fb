import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.geometry import ROBOT_FROM_CAMERA, Pose3D, after_move, along_arc, placed, seen_from
from hri.core.signals import Pose2D

lengths = st.floats(-10, 10)
angles = st.floats(-math.pi, math.pi)
poses = st.builds(Pose2D, lengths, lengths, angles)
mounts = st.builds(Pose3D, lengths, lengths, lengths, angles, angles, angles)


@pytest.mark.proves("C01")
def test_the_robots_frame_is_right_handed_and_turns_left() -> None:
    ahead, left, up = np.eye(3)
    assert np.cross(ahead, left) == pytest.approx(up)
    quarter = Pose3D(yaw=math.pi / 2).rotation()
    assert quarter @ ahead == pytest.approx(left)
    assert Pose3D(pitch=math.pi / 2).rotation() @ ahead == pytest.approx(-up)
    assert Pose3D(roll=math.pi / 2).rotation() @ left == pytest.approx(up)


@pytest.mark.proves("C02")
def test_the_two_moves_of_the_guide() -> None:
    first = after_move(Pose2D(), 10, 20)
    assert (first.x, first.y) == (10, 20)
    assert first.heading == pytest.approx(math.atan2(20, 10))
    # The axes are drawn anew: the second move begins at (0, 0) and looks along its own x axis.
    assert seen_from(first, first.x, first.y) == (0, 0)
    second = after_move(first, 10, -30)
    line = second.x - first.x, second.y - first.y
    assert math.hypot(*line) == pytest.approx(math.hypot(10, 30))
    assert second.heading == pytest.approx(math.atan2(line[1], line[0]))
    assert seen_from(first, second.x, second.y) == pytest.approx((10, -30))


def test_a_move_to_where_it_stands_turns_nothing() -> None:
    assert after_move(Pose2D(1, 2, 3), 0, 0) == Pose2D(1, 2, 3)


@pytest.mark.proves("C02")
@given(poses, lengths, lengths)
def test_after_any_move_the_robot_faces_away_from_where_it_was(
    pose: Pose2D, x: float, y: float
) -> None:
    moved = after_move(pose, x, y)
    if math.hypot(x, y) < 1e-3:
        return
    behind = seen_from(moved, pose.x, pose.y)
    assert behind == pytest.approx((-math.hypot(x, y), 0), abs=1e-9)


@given(poses, lengths, lengths)
def test_seeing_from_a_pose_and_placing_undo_each_other(pose: Pose2D, x: float, y: float) -> None:
    assert placed(pose, *seen_from(pose, x, y)) == pytest.approx((x, y), abs=1e-9)


@pytest.mark.proves("C03")
@pytest.mark.parametrize(
    ("camera", "robot"),
    [((0, 0, 1), (1, 0, 0)), ((1, 0, 0), (0, -1, 0)), ((0, 1, 0), (0, 0, -1))],
    ids=["what is ahead", "what is to the right", "what is below"],
)
def test_the_camera_looks_along_z_with_x_right_and_y_down(
    camera: tuple[float, ...], robot: tuple[float, ...]
) -> None:
    assert ROBOT_FROM_CAMERA @ camera == pytest.approx(robot)
    assert ROBOT_FROM_CAMERA.T @ robot == pytest.approx(camera)
    assert np.linalg.det(ROBOT_FROM_CAMERA) == pytest.approx(1)


@given(mounts, mounts, mounts)
def test_poses_on_poses_may_be_grouped_at_will(a: Pose3D, b: Pose3D, c: Pose3D) -> None:
    one, other = a.then(b).then(c), a.then(b.then(c))
    assert (one.x, one.y, one.z) == pytest.approx((other.x, other.y, other.z), abs=1e-6)
    assert one.rotation() == pytest.approx(other.rotation(), abs=1e-6)


def test_something_on_a_turned_arm_is_carried_along() -> None:
    hand = Pose3D(x=1.0, z=0.5, yaw=math.pi / 2).then(Pose3D(x=0.2, pitch=0.3))
    assert (hand.x, hand.y, hand.z) == pytest.approx((1.0, 0.2, 0.5))
    assert (hand.roll, hand.pitch, hand.yaw) == pytest.approx((0.0, 0.3, math.pi / 2))


def test_a_quarter_circle_in_short_arcs_ends_beside() -> None:
    pose = Pose2D()
    for _ in range(1000):
        pose = along_arc(pose, math.pi / 2 / 1000, math.pi / 2 / 1000)
    assert (pose.x, pose.y) == pytest.approx((1.0, 1.0), abs=1e-6)
