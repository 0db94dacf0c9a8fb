"""Eyes that lead, a head that follows, and points in space."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError
from hri.core.geometry import Pose3D
from hri.core.signals import Gaze
from hri.face.motion.gaze import HEAD_DELAY, GazeController, direction, from_camera
from hri.face.settings import HeadSettings, Settings
from tests.face.pixels import MODEL

STEP = 2e-3


def turning() -> Settings:
    """The settings of a face whose head turns by 25 and 15 degrees."""
    head = HeadSettings((240, 240), (150, 170), 160, 25.0, 15.0, (), {})
    gaze = replace(MODEL.settings.gaze, degrees=(25.0, 18.0), head_share=0.3)
    return replace(MODEL.settings, head=head, gaze=gaze)


def looks(
    looking: GazeController, seconds: float, start: float = 0.0
) -> list[tuple[float, float, float]]:
    """Time, degrees of the eyes and degrees of the head to the right, step by step."""
    found = []
    for number in range(round(seconds / STEP)):
        look = looking.follow(start + number * STEP, STEP)
        found.append((number * STEP, look.eyes.x * 25, look.yaw * 25))
    return found


def test_the_robots_left_is_the_viewers_right() -> None:
    assert direction((1.0, 0.0, 0.0)) == pytest.approx((0.0, 0.0))
    assert direction((1.0, 1.0, 0.0)) == pytest.approx((45.0, 0.0))
    assert direction((1.0, 0.0, -1.0)) == pytest.approx((0.0, -45.0))


def test_a_point_of_the_camera_is_a_point_before_the_face() -> None:
    assert from_camera((0.0, 0.0, 2.0)) == pytest.approx((2.0, 0.0, 0.0))
    assert from_camera((-0.5, -0.2, 2.0)) == pytest.approx((2.0, 0.5, 0.2))
    below = Pose3D(z=-0.3, pitch=-math.radians(10))
    ahead = from_camera((0.0, 0.0, 2.0), below)
    assert ahead == pytest.approx((2 * math.cos(0.1745), 0.0, 2 * math.sin(0.1745) - 0.3), abs=1e-3)


def test_the_eyes_lead_the_head_follows_and_the_look_stays() -> None:
    looking = GazeController(turning())
    looks(looking, 1.0)
    assert looking.look(Gaze(point=(1.0, math.tan(math.radians(20)), 0.0))) == pytest.approx(20.0)
    seen = looks(looking, 2.0, 1.0)
    there = next(time for time, eyes, head in seen if eyes + head > 18)
    sets_out = next(time for time, _, head in seen if head > 0.1)
    assert there < 0.09
    assert HEAD_DELAY <= sets_out < 0.15
    _, eyes, head = seen[-1]
    assert head == pytest.approx(6.0, abs=0.1), "its share"
    assert eyes + head == pytest.approx(20.0, abs=0.1), "what it looks at"
    after = [eyes + head for time, eyes, head in seen if time > 0.2]
    assert max(after) < 20.2, "the eyes turn back as the head turns"


def test_the_head_takes_what_the_eyes_cannot_up_to_its_limit() -> None:
    looking = GazeController(turning())
    looking.look(Gaze(point=(1.0, math.tan(math.radians(45)), 0.0)))
    *_, (_, eyes, head) = looks(looking, 3.0)
    assert (eyes, head) == pytest.approx((25.0, 20.0), abs=0.2)
    looking.look(Gaze(point=(-1.0, -0.1, 0.0)))
    *_, (_, eyes, head) = looks(looking, 3.0, 3.0)
    assert (eyes, head) == pytest.approx((-25.0, -25.0), abs=0.2)


def test_eyes_turn_inward_to_what_is_near() -> None:
    inward = {}
    for distance in (0.01, 0.2, 0.5, 5.0):
        looking = GazeController(turning())
        looking.look(Gaze(point=(distance, 0.0, 0.0)))
        for number in range(500):
            look = looking.follow(number * STEP, STEP)
        inward[distance] = look.inward * 25
    assert inward[0.5] == pytest.approx(math.degrees(math.atan(0.0325 / 0.5)), abs=0.05)
    assert inward[0.01] > inward[0.2] > inward[0.5] > inward[5.0]
    assert inward[0.01] < 20, "no nearer than ten centimeters"


@given(st.lists(st.tuples(*[st.floats(-5, 5)] * 3), min_size=1, max_size=4))
@settings(max_examples=30)
def test_wherever_it_looks_nothing_jumps_or_leaves_its_range(
    points: list[tuple[float, float, float]],
) -> None:
    looking = GazeController(turning())
    last, now = None, 0.0
    for point in points:
        looking.look(Gaze(point=point))
        for _ in range(25):
            now += 1e-2
            look = looking.follow(now, 1e-2)
            assert max(abs(look.eyes.x), abs(look.eyes.y)) <= 1
            assert max(abs(look.yaw), abs(look.pitch)) <= 1 + 1e-9
            shown = np.array([look.eyes.x, look.eyes.y, look.yaw, look.pitch])
            assert last is None or np.abs(shown - last).max() < 1.2
            last = shown


def test_a_face_without_a_neck_looks_with_its_eyes_alone() -> None:
    looking = GazeController(replace(turning(), head=None))
    looking.look(Gaze(1.0, 0.0))
    *_, (_, eyes, head) = looks(looking, 1.0)
    assert (eyes, head) == pytest.approx((25.0, 0.0), abs=0.01)


def test_a_look_at_nowhere_is_refused() -> None:
    for gaze in (Gaze(math.nan, 0.0), Gaze(point=(1.0, math.inf, 0.0))):
        with pytest.raises(HriError, match="is not finite"):
            GazeController(turning()).look(gaze)
