import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.geometry import after_move
from hri.core.signals import Pose2D, Twist
from hri.drive.odometry import Estimate, Wheels, arc_between, rolled_on
from hri.simulation.base import Base

WHEELS = Wheels(track=0.3, slip=0.01)


def straight(way: float, step: float = 0.02) -> Estimate:
    estimate = Estimate()
    for _ in range(round(way / step)):
        estimate = rolled_on(estimate, step, 0.0, WHEELS)
    return estimate


def test_it_grows_unsure_with_the_root_of_the_way() -> None:
    short, long = straight(1.0), straight(4.0)
    assert short.heading_deviation == pytest.approx(0.01 * math.sqrt(2) / 0.3, rel=0.01)
    assert long.heading_deviation == pytest.approx(2 * short.heading_deviation, rel=0.01)
    assert long.covariance[1, 1] > long.covariance[0, 0], "it drifts aside more than ahead"


def test_it_tells_as_much_as_the_slip_of_real_wheels_makes() -> None:
    ends = []
    for seed in range(60):
        base = Base(lambda x, y, time: math.inf, slip=0.01, seed=seed)
        drive(base, 4.0)
        ends.append(base.pose.y)
    told = math.sqrt(straight(4.0).covariance[1, 1])
    assert float(np.std(ends)) == pytest.approx(told, rel=0.3)


def drive(base: Base, way: float) -> None:
    now = 0.0
    while base.odometry.x < way:
        base.command(Twist(0.5), now)
        now += 0.1
        base.advance(now)


@given(st.lists(st.tuples(st.floats(-0.1, 0.1), st.floats(-0.3, 0.3)), max_size=40))
def test_a_covariance_stays_one(arcs: list[tuple[float, float]]) -> None:
    estimate = Estimate()
    for linear, angular in arcs:
        before = estimate
        estimate = rolled_on(before, linear, angular, WHEELS)
        assert np.trace(estimate.covariance) >= np.trace(before.covariance) - 1e-9 or linear < 0
    assert np.allclose(estimate.covariance, estimate.covariance.T)
    assert np.linalg.eigvalsh(estimate.covariance)[0] >= -1e-9


@pytest.mark.parametrize("way", [(math.nan, 0.0), (0.0, math.inf)])
def test_what_is_not_finite_is_refused(way: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match="finite"):
        rolled_on(Estimate(), *way, WHEELS)


@given(st.floats(-0.2, 0.2), st.floats(-1.0, 1.0), st.floats(-3, 3))
def test_the_arc_between_two_poses_leads_from_one_to_the_other(
    linear: float, angular: float, heading: float
) -> None:
    start = Pose2D(1.0, -2.0, heading)
    after = rolled_on(Estimate(start), linear, angular, WHEELS).pose
    assert arc_between(start, after) == pytest.approx((linear, angular), abs=1e-9)


def test_relative_moves_are_those_of_the_guide() -> None:
    first = after_move(Pose2D(), 0.10, 0.20)
    assert (first.x, first.y) == pytest.approx((0.10, 0.20))
    assert first.heading == pytest.approx(math.atan2(0.20, 0.10))
    second = after_move(first, 0.10, -0.30)
    assert math.dist((second.x, second.y), (first.x, first.y)) == pytest.approx(
        math.hypot(0.1, 0.3)
    )
