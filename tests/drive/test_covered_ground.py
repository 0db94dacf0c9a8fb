"""How far a robot may back off: only over ground it has just come over."""

import math

import pytest
from hypothesis import given, strategies as st

from hri.core.signals import Pose2D
from hri.drive.covered_ground import REMEMBERED_S, CoveredGround

anywhere = st.floats(-5, 5)
headings = st.floats(-math.pi, math.pi)


def driven(ground, start, way, began=0.0):
    """Drive `way` meters ahead from a pose, 1 cm a look; the time and the pose of the end."""
    steps = max(round(abs(way) / 0.01), 1)
    for step in range(steps + 1):
        gone = way * step / steps
        x = start.x + gone * math.cos(start.heading)
        y = start.y + gone * math.sin(start.heading)
        end = began + 0.1 * step, Pose2D(x, y, start.heading)
        ground.see(*end)
    return end


@given(anywhere, anywhere, headings, st.floats(0, 1))
def test_it_may_back_off_as_far_as_it_came(x, y, heading, way):
    ground = CoveredGround()
    driven(ground, Pose2D(x, y, heading), way)
    assert way - 0.011 <= ground.behind() <= way + 1e-9


@given(anywhere, anywhere, headings, st.floats(0.01, 1))
def test_nothing_is_known_of_where_it_has_not_been(x, y, heading, way):
    ground = CoveredGround()
    assert ground.behind() == 0.0
    driven(ground, Pose2D(x, y, heading), -way)
    assert ground.behind() == 0.0


@pytest.mark.parametrize("turned", [10, 90, -170])
def test_ground_that_lies_another_way_does_not_count(turned):
    ground = CoveredGround()
    now, end = driven(ground, Pose2D(0, 0, 0), 0.5)
    ground.see(now + 1, Pose2D(end.x, end.y, math.radians(turned)))
    assert ground.behind() == 0.0


def test_a_wiggle_leaves_the_ground_behind_it_known():
    ground = CoveredGround()
    now, end = driven(ground, Pose2D(0, 0, 0), 0.5)
    for step, degrees in enumerate((8, -8, 0.5)):
        ground.see(now + step, Pose2D(end.x, end.y, math.radians(degrees)))
    assert ground.behind() == pytest.approx(0.5, abs=0.02)


def test_what_was_free_long_ago_may_not_be_free_anymore():
    ground = CoveredGround()
    now, end = driven(ground, Pose2D(0, 0, 0), 0.5)
    ground.see(now + REMEMBERED_S - 2, end)
    assert ground.behind() > 0.1
    ground.see(now + REMEMBERED_S + 1, end)
    assert ground.behind() == 0.0


def test_who_carries_it_takes_it_off_its_ground():
    ground = CoveredGround()
    driven(ground, Pose2D(0, 0, 0), 0.5)
    ground.see(10, Pose2D(0.8, 0, 0))
    assert ground.behind() == 0.0
    now, _ = driven(ground, Pose2D(0.8, 0, 0), 0.3, 10)
    assert ground.behind() == pytest.approx(0.3, abs=0.02)
    ground.forget()
    ground.see(now + 1, Pose2D(1.1, 0, 0))
    assert ground.behind() == 0.0
