"""Markers in pictures: which they are, where, and what is none."""

import math

import cv2
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from benchmarks.vision.marker_scenes import SIDE, Condition, shown
from hri.core.errors import HriError
from hri.core.geometry import ROBOT_FROM_CAMERA, Pose3D
from hri.vision.camera_view import CameraView
from hri.vision.markers.families import FAMILIES, NAMES
from hri.vision.markers.marker_reader import MarkerReader
from tests.vision.markers.rendering import ground

DEFAULT = FAMILIES["apriltag_36h11"]


def made(family, id, condition, seed=0):
    return shown(family, id, ground(seed), condition, np.random.default_rng(seed))


@settings(max_examples=25, deadline=None)
@given(
    id=st.integers(0, DEFAULT.count - 1),
    pixels=st.floats(34, 160),
    tilt=st.floats(0, 60),
    blur=st.floats(0.4, 1.2),
    is_shaded=st.booleans(),
    seed=st.integers(0, 10**6),
)
def test_any_pose_in_range_is_found_where_it_is(id, pixels, tilt, blur, is_shaded, seed):
    scene = made(DEFAULT, id, Condition(pixels, (tilt, tilt), blur, is_shaded), seed)
    (one,) = MarkerReader().find(scene.picture)
    assert one.id == id
    away = ROBOT_FROM_CAMERA @ scene.place
    assert math.dist(one.point, away) < 0.03 * np.linalg.norm(away)
    assert one.distance == pytest.approx(np.linalg.norm(away), rel=0.03)
    assert one.bearing == pytest.approx(math.atan2(away[1], away[0]), abs=0.005)
    normal = ROBOT_FROM_CAMERA @ scene.rotation[:, 2]
    off = math.degrees(math.acos(min(1.0, float(normal @ one.facing))))
    # Small and nearly from the front it looks the same when tilted to the other side.
    assert off < (4.0 if one.is_sure else 2 * tilt + 10.0)
    assert abs(math.degrees(one.tilt) - tilt) < 10.0


@pytest.mark.parametrize("family", FAMILIES.values(), ids=FAMILIES)
def test_each_family_is_read_small_blurred_tilted_and_half_in_shadow(family):
    reader, found = MarkerReader(list(FAMILIES)), 0
    condition = Condition(tilt=(0, 60), blur=1.0, is_shaded=True)
    for seed in range(20):
        id = 7 * seed % family.count
        names = [one.name for one in reader.find(made(family, id, condition, seed).picture)]
        assert set(names) <= {f"{family.name}:{id}"}
        found += len(names)
    assert found >= 19


def test_corners_begin_at_the_upper_left_one_and_go_clockwise():
    scene = made(DEFAULT, 3, Condition(90.0, blur=0.5), 5)
    (one,) = MarkerReader().find(scene.picture)
    upper_left, upper_right, lower_right, _ = (np.array(corner) for corner in one.outline)
    right, down = scene.rotation[:2, 0], -scene.rotation[:2, 1]
    assert (upper_right - upper_left) @ right > 80
    assert (lower_right - upper_right) @ down > 80


def test_several_are_found_the_nearest_first_and_none_is_told_twice():
    near = made(DEFAULT, 1, Condition(120.0), 1)
    rest = np.random.default_rng(9)
    both = shown(DEFAULT, 2, near.picture, Condition(40.0), rest).picture
    assert [one.id for one in MarkerReader().find(both)] in ([1, 2], [1])
    assert [one.id for one in MarkerReader().find(near.picture)] == [1]


def test_the_place_is_in_the_axes_of_the_robot_however_the_camera_is_mounted_and_turned():
    scene = made(DEFAULT, 4, Condition(100.0, (30, 30)), 2)
    (plain,) = MarkerReader().find(scene.picture)
    view = CameraView(mount=Pose3D(0.1, 0.0, 0.5, 0.0, 0.2, 0.0))
    (one,) = MarkerReader(view=view).find(scene.picture, pan=0.4)
    turn = Pose3D(yaw=0.4).rotation() @ view.mount.rotation()
    assert one.point == pytest.approx(turn @ plain.point + (0.1, 0.0, 0.5))
    assert one.facing == pytest.approx(turn @ plain.facing)
    assert (one.distance, one.tilt) == pytest.approx((plain.distance, plain.tilt))
    assert one.pose.heading == pytest.approx(math.atan2(one.facing[1], one.facing[0]))


def test_a_larger_side_is_farther_away():
    picture = made(DEFAULT, 4, Condition(100.0, (30, 30)), 2).picture
    (small,), (large,) = (MarkerReader(side=side).find(picture) for side in (SIDE, 2 * SIDE))
    assert large.distance == pytest.approx(2 * small.distance)


def test_codes_have_their_texts_which_are_cut_and_in_one_line():
    reader = MarkerReader(["qr"])
    for text, told in (
        ("hello", "hello"),
        ("https://example.com/?a=1", "https://example.com/?a=1"),
        ("one\ntwo\x1b[31m", "one two [31m"),
        ("x" * 400, "x" * 300),
    ):
        code = cv2.QRCodeEncoder_create().encode(text)
        large = cv2.resize(code, None, fx=6, fy=6, interpolation=cv2.INTER_NEAREST)
        page = np.full((large.shape[0] + 80, large.shape[1] + 80), 255, np.uint8)
        page[40 : 40 + len(large), 40 : 40 + large.shape[1]] = large
        (one,) = reader.find(np.dstack([page] * 3))
        assert (one.text, one.id, one.name) == (told, -1, f"qr:{told}")


@pytest.mark.parametrize("name", ["noise", "dither", "grid", "black", "white", "one pixel", "line"])
def test_hostile_pictures_show_none_in_bounded_time(name):
    draw = np.random.default_rng(0)
    rows, columns = np.mgrid[:480, :640]
    pictures = {
        "noise": draw.integers(0, 256, (480, 640)),
        "dither": 255 * ((rows + columns) % 2),
        "grid": 255 * ((rows // 20 + columns // 20) % 2),
        "black": np.zeros((480, 640)),
        "white": np.full((480, 640), 255),
        "one pixel": np.zeros((1, 1)),
        "line": np.zeros((3, 4000)),
    }
    picture = np.dstack([pictures[name].astype(np.uint8)] * 3)
    assert MarkerReader(NAMES).find(picture) == ()


@settings(max_examples=30, deadline=None)
@given(st.integers(1, 90), st.integers(1, 90), st.integers(0, 99))
def test_no_small_picture_of_noise_fails(height, width, seed):
    picture = np.random.default_rng(seed).integers(0, 256, (height, width, 3), np.uint8)
    assert MarkerReader(NAMES).find(picture) == ()


def test_pictures_without_markers_show_none():
    reader = MarkerReader(NAMES)
    assert [one for seed in range(40) for one in reader.find(ground(seed))] == []


def test_an_unknown_family_is_refused_with_the_nearest_name():
    with pytest.raises(HriError, match='did you mean "aruco_4x4_50"'):
        MarkerReader(["aruco_4x4"])
    with pytest.raises(HriError, match="no family of markers"):
        MarkerReader([])
    with pytest.raises(HriError, match="one of 0 to 49"):
        FAMILIES["aruco_4x4_50"].cells(50)
