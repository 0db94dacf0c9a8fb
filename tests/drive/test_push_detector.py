"""Whether someone pushes a robot that stands."""

import pytest
from hypothesis import given, strategies as st

from hri.core.signals import Pose2D
from hri.drive.push_detector import LEAST, STOOD_S, PushDetector


def felt(steps, driven_until=-1.0, detector=None):
    """The pushes that are felt while x grows by these meters, each in a tenth of a second."""
    detector = detector or PushDetector()
    x, pushes = 0.0, []
    for number, step in enumerate([0.0, *steps]):
        x += step
        now = 0.1 * number
        if speed := detector.see(now, Pose2D(x, 0, 0), now <= driven_until):
            pushes.append(round(speed, 3))
    return pushes


def test_a_kick_is_felt_once_while_it_rolls():
    assert felt([0, 0, 0.06, 0.05, 0.04, 0.02, 0.01, 0, 0]) == [0.6]


def test_a_second_kick_is_felt_again():
    assert felt([0.06, 0.0, 0.08]) == [0.6, 0.8]


def test_who_moves_it_aside_by_hand_does_not_kick_it():
    assert felt([0.02] * 20) == []


@given(st.lists(st.floats(-0.1, 0.1), min_size=1, max_size=30))
def test_its_own_driving_is_not_a_push(steps):
    assert felt(steps, driven_until=10) == []


def test_the_last_of_a_motion_is_not_a_push():
    assert felt([0.04] * 9, driven_until=0.1) == []
    assert felt([0.04] * 4 + [0] * 12 + [0.04], driven_until=0.3) == [pytest.approx(0.4)]


@given(st.lists(st.floats(-0.3, 0.3), max_size=40), st.floats(0, 3))
def test_what_is_felt_was_fast_and_came_after_standing(steps, until):
    speeds = felt(steps, until)
    fast = [abs(s) * 10 for n, s in enumerate(steps, 1) if 0.1 * n - until >= STOOD_S - 0.11]
    assert len(speeds) <= len([speed for speed in fast if speed >= LEAST - 1e-6])
