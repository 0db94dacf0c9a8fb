import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.core.geometry import Pose3D
from hri.vision.camera_view import EYE_DISTANCE, CameraView

SIZE = (640, 480)


def test_the_middle_of_the_picture_is_straight_ahead():
    assert CameraView().toward(320, 240, SIZE) == pytest.approx((0.0, 0.0))


def test_the_edge_of_the_picture_is_half_the_field_of_view_away():
    view = CameraView(field_of_view=1.0)
    assert view.toward(0, 240, SIZE)[0] == pytest.approx(0.5), "what is left is to the left"
    assert view.toward(640, 240, SIZE)[0] == pytest.approx(-0.5)
    assert view.toward(320, 0, SIZE)[1] > 0 > view.toward(320, 480, SIZE)[1]


def test_pictures_of_another_size_show_the_same_directions():
    view = CameraView()
    assert view.toward(100, 50, SIZE) == pytest.approx(view.toward(50, 25, (320, 240)))


@given(
    yaw=st.floats(-3, 3), pitch=st.floats(-0.6, 0.6), x=st.floats(100, 540), y=st.floats(80, 400)
)
def test_a_turned_camera_turns_every_direction_along(yaw, pitch, x, y):
    bearing, elevation = CameraView().toward(x, y, SIZE)
    turned, same = CameraView(mount=Pose3D(yaw=yaw)).toward(x, y, SIZE)
    assert math.remainder(turned - bearing - yaw, math.tau) == pytest.approx(0.0, abs=1e-9)
    assert same == pytest.approx(elevation)
    middle = CameraView(mount=Pose3D(pitch=pitch, roll=0.7)).toward(320, 240, SIZE)
    assert middle == pytest.approx((0.0, -pitch)), "pitch looks down; roll moves not the middle"


def test_a_camera_on_its_side_sees_left_as_up():
    bearing, elevation = CameraView(mount=Pose3D(roll=math.pi / 2)).toward(0, 240, SIZE)
    assert abs(bearing) < 1e-9
    assert elevation == pytest.approx(CameraView().field_of_view / 2)


@given(distance=st.floats(0.3, 10), bearing=st.floats(-0.4, 0.4), elevation=st.floats(-0.3, 0.3))
def test_the_distance_is_that_at_which_a_length_takes_so_many_pixels(distance, bearing, elevation):
    view = CameraView()
    focal = view.focal_length(SIZE)
    ray = np.array([-math.sin(bearing), -math.sin(elevation), 1.0])
    x, y, depth = ray / np.linalg.norm(ray) * distance
    pixels = focal * EYE_DISTANCE / depth
    place = 320 + focal * x / depth, 240 + focal * y / depth
    assert view.distance(*place, pixels, EYE_DISTANCE, SIZE) == pytest.approx(distance)
    assert math.isnan(view.distance(*place, 0.0, EYE_DISTANCE, SIZE))


@pytest.mark.parametrize("angle", [0.0, -1.0, math.pi, math.nan])
def test_a_field_of_view_that_no_lens_has_is_refused(angle):
    with pytest.raises(HriError, match="field of view"):
        CameraView(angle)


def test_a_pixel_of_the_floor_is_a_place_before_the_robot() -> None:
    view = CameraView(math.pi / 2, Pose3D(x=0.1, z=0.4))
    ahead, left = view.on_floor(320, 240 + 128, SIZE)  # 0.4 m below at 1 m: 320 * 0.4 pixels down
    assert (ahead, left) == pytest.approx((1.1, 0.0))
    assert view.on_floor(320 + 160, 240 + 128, SIZE) == pytest.approx((1.1, -0.5))


def test_a_camera_that_looks_down_or_is_turned_sees_the_floor_elsewhere() -> None:
    down = CameraView(math.pi / 2, Pose3D(z=0.5, pitch=math.pi / 4))
    assert down.on_floor(320, 240, SIZE) == pytest.approx((0.5, 0.0))
    assert down.on_floor(320, 240, SIZE, pan=math.pi / 2) == pytest.approx((0.0, 0.5))


@pytest.mark.parametrize(
    ("view", "pixel", "message"),
    [
        (CameraView(1.0, Pose3D(z=0.4)), (320, 100), "shows no floor within 10 m - point at"),
        (CameraView(1.0, Pose3D(z=0.4)), (320, 241), "shows no floor within 10 m - point at"),
        (CameraView(1.0, Pose3D(z=0.4)), (700, 400), "outside of a picture of 640 x 480"),
        (CameraView(1.0), (320, 400), "height of the camera is not in the configuration"),
    ],
)
def test_a_pixel_that_is_no_place_is_refused(view, pixel, message) -> None:
    with pytest.raises(HriError, match=message):
        view.on_floor(*pixel, SIZE)
