import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Image
from hri.simulation.people.body_motion import idle_angles, nod_angles, shake_angles
from tests.vision.film import render_head


def head(
    pitch: float = 0.0,
    yaw: float = 0.0,
    roll: float = 0.0,
    center: tuple[float, float] = (160.0, 120.0),
    height: float = 120.0,
    size: tuple[int, int] = (320, 240),
    mouth: float = 0.0,
    lids: float = 1.0,
) -> Image:
    """A picture; angles in degrees."""
    return render_head(
        *map(math.radians, (pitch, yaw, roll)),
        center=center,
        height=height,
        size=size,
        mouth=mouth,
        lids=lids,
    )


EMPTY = head(center=(5000.0, 120.0))


def middle(picture: Image, color: str) -> tuple[float, float]:
    """The middle of the pixels that are lips or hair: x and y, in heads from that of the head."""
    window = picture[60:180, 100:220].astype(int)
    red, green, blue = window[..., 0], window[..., 1], window[..., 2]
    lips = (red - green > 0.41 * red) & (red > 80)
    hair = red + green + blue < 210
    rows, columns = np.nonzero(lips if color == "lips" else hair)
    return (columns.mean() - 60) / 120, (rows.mean() - 60) / 120


def test_the_picture_is_rgb_and_the_same_each_time() -> None:
    picture = head(5, 5, 5)
    assert picture.shape == (240, 320, 3)
    assert picture.dtype == np.uint8
    assert np.array_equal(picture, head(5, 5, 5))
    red, green, blue = picture[130, 150]
    assert red > green > blue, "skin"


def test_pitch_is_positive_down() -> None:
    assert middle(head(12), "lips")[1] > middle(head(), "lips")[1] + 0.03
    assert middle(head(-12), "lips")[1] < middle(head(), "lips")[1] - 0.03


def test_yaw_is_positive_to_the_persons_left_which_is_the_pictures_right() -> None:
    assert middle(head(0, 15), "lips")[0] > 0.06
    assert middle(head(0, -15), "lips")[0] < -0.06


def test_roll_is_positive_toward_the_persons_left_shoulder() -> None:
    assert middle(head(0, 0, 15), "hair")[0] > middle(head(0, 0, -15), "hair")[0] + 0.05


def test_the_head_is_where_and_as_large_as_asked() -> None:
    for center, height in (((100.0, 100.0), 70.0), ((200.0, 130.0), 150.0)):
        changed = np.abs(head(center=center, height=height).astype(int) - EMPTY).max(axis=2) > 25
        rows, columns = np.nonzero(changed[: int(center[1])])
        assert rows.min() == pytest.approx(center[1] - height / 2, abs=0.04 * height)
        assert columns.mean() == pytest.approx(center[0], abs=0.03 * height)


def test_mouth_and_eyes_open_and_shut() -> None:
    shut, open_ = head(mouth=0.0), head(mouth=1.0)
    changed = np.abs(shut.astype(int) - open_).max(axis=2) > 20
    rows, columns = np.nonzero(changed)
    assert 145 < rows.mean() < 175
    assert columns.mean() == pytest.approx(160, abs=3)
    blinked = np.abs(head(lids=0.0).astype(int) - shut).max(axis=2) > 20
    assert 112 < np.nonzero(blinked)[0].mean() < 130


def test_a_head_beside_the_picture_leaves_the_room_empty() -> None:
    assert np.array_equal(head(center=(-900.0, 120.0)), EMPTY)
    assert np.array_equal(head(center=(160.0, 4000.0)), EMPTY)
    assert EMPTY.std() > 20, "there is a room"


angles = st.floats(-180, 180)
places = st.floats(-400, 800)


@given(angles, angles, angles, places, places, st.floats(2, 300), st.floats(-1, 2))
@settings(max_examples=30, deadline=None)
def test_any_pose_gives_a_picture(
    pitch: float, yaw: float, roll: float, x: float, y: float, height: float, part: float
) -> None:
    picture = head(pitch, yaw, roll, (x, y), height, (160, 120), part, part)
    assert picture.shape == (120, 160, 3)


def test_nods_and_shakes_start_and_end_at_rest() -> None:
    for time in (-1.0, 0.0, 2 / 1.8, 9.0):
        assert nod_angles(time) == pytest.approx((0, 0, 0), abs=1e-9)
        assert shake_angles(time) == pytest.approx((0, 0, 0), abs=1e-9)
    times = np.arange(0, 2, 0.01)
    nods = np.array([nod_angles(t, amplitude=0.1, frequency=1.0) for t in times])
    shakes = np.array([shake_angles(t, amplitude=0.2, frequency=1.0) for t in times])
    assert np.ptp(nods, axis=0) == pytest.approx((0.2, 0, 0), abs=0.01)
    assert np.ptp(shakes, axis=0) == pytest.approx((0, 0.4, 0), abs=0.01)
    assert nods[10, 0] > 0, "a nod begins with the head going down"
    assert shakes[10, 1] > 0


def test_a_head_at_rest_sways_slowly_and_each_in_its_own_way() -> None:
    times = np.arange(0, 60, 0.1)
    sway = np.degrees([idle_angles(t, seed=4) for t in times])
    assert 0.5 < np.abs(sway).max() < 3
    assert np.abs(np.diff(sway, axis=0)).max() / 0.1 < 5, "degrees a second"
    assert idle_angles(3.0, seed=4) != idle_angles(3.0, seed=5)
