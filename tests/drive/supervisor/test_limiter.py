import math

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Twist
from hri.drive.supervisor.limiter import QUANTUM, Limiter
from hri.drive.velocity_limits import BaseLimits, Cap, within
from hri.hal.motion import REST

CAP = BaseLimits().cap(is_near=False)
speeds = st.floats(-3, 3, allow_nan=False)
targets = st.lists(
    st.tuples(st.builds(Twist, speeds, speeds), st.integers(1, 40)), min_size=1, max_size=12
)
NEARLY = 1e-6


def trace(limiter: Limiter, target: Twist, seconds: float, cap: Cap = CAP) -> list[Twist]:
    """The velocity after each quantum."""
    return [limiter.step(target, cap, QUANTUM) for _ in range(round(seconds / QUANTUM))]


@settings(deadline=None, max_examples=60)
@given(targets)
def test_whatever_is_asked_speed_acceleration_and_jerk_stay_within_limits(asked) -> None:
    limits, limiter = BaseLimits(), Limiter(BaseLimits())
    before, slope = REST, REST
    for target, quanta in asked:
        for _ in range(quanta):
            now = limiter.step(target, CAP, QUANTUM)
            assert -CAP.backward <= now.linear <= CAP.forward
            assert abs(now.angular) <= CAP.angular
            rise = (now.linear - before.linear) / QUANTUM
            spin = (now.angular - before.angular) / QUANTUM
            if abs(now.linear) > abs(before.linear):
                assert abs(rise) <= limits.acceleration + NEARLY
            assert abs(rise) <= limits.deceleration + NEARLY
            assert abs(spin) <= limits.angular_deceleration + NEARLY
            assert abs(rise - slope.linear) <= limits.jerk * QUANTUM + NEARLY
            assert abs(spin - slope.angular) <= limits.angular_jerk * QUANTUM + NEARLY
            before, slope = now, Twist(rise, spin)


@pytest.mark.parametrize("target", [Twist(0.5), Twist(-0.25), Twist(0.3, 0.5), Twist(0.0, -1.5)])
def test_a_target_is_reached_exactly_and_never_passed(target) -> None:
    path = trace(Limiter(BaseLimits()), target, 3.0)
    assert path[-1].linear == pytest.approx(target.linear, abs=1e-6)
    assert path[-1].angular == pytest.approx(target.angular, abs=1e-6)
    assert max(abs(v.linear) for v in path) <= abs(target.linear) + 1e-9
    assert max(abs(v.angular) for v in path) <= abs(target.angular) + 1e-9


def test_it_takes_the_time_that_acceleration_and_jerk_ask_for() -> None:
    path = trace(Limiter(BaseLimits()), Twist(0.4), 3.0)
    reached = next(number for number, v in enumerate(path) if v.linear > 0.3999) * QUANTUM
    # v / a + a / j, for an acceleration that is reached on the way.
    assert reached == pytest.approx(0.4 / 0.5 + 0.5 / 5.0, abs=0.03)


def test_rest_is_reached_and_kept() -> None:
    limiter = Limiter(BaseLimits())
    trace(limiter, Twist(0.5, 1.0), 2.0)
    assert trace(limiter, REST, 1.0)[-1] == REST


def test_a_cap_that_falls_brakes_at_once_with_the_whole_deceleration() -> None:
    limiter = Limiter(BaseLimits())
    trace(limiter, Twist(0.5), 2.0)
    path = trace(limiter, Twist(0.5), 0.1, Cap(0.0, 0.25, 1.5))
    assert path[-1].linear == pytest.approx(0.5 - 1.0 * 0.1)
    path = trace(limiter, Twist(0.5), 1.0, Cap(0.0, 0.25, 1.5))
    assert path[-1] == REST
    assert min(velocity.linear for velocity in path) == 0.0


def test_halting_is_abrupt() -> None:
    limiter = Limiter(BaseLimits())
    trace(limiter, Twist(0.5, 1.0), 2.0)
    assert limiter.halt() == REST == limiter.velocity


def test_how_often_it_is_asked_does_not_matter() -> None:
    often, seldom = Limiter(BaseLimits()), Limiter(BaseLimits())
    for _ in range(100):
        often.step(Twist(0.3), CAP, 0.0025)
    for _ in range(10):
        seldom.step(Twist(0.3), CAP, 0.025)
    assert often.velocity.linear == pytest.approx(seldom.velocity.linear, abs=0.003)


@given(speeds, speeds)
def test_a_curve_that_is_too_fast_keeps_its_shape(linear, angular) -> None:
    cut = within(Twist(linear, angular), CAP)
    assert abs(cut.angular) <= CAP.angular + NEARLY
    assert -CAP.backward - NEARLY <= cut.linear <= CAP.forward + NEARLY
    assert cut.linear * angular == pytest.approx(cut.angular * linear, abs=1e-9)


def test_where_it_may_not_drive_it_may_turn() -> None:
    assert within(Twist(0.3, 0.5), Cap(0.0, 0.2, 1.0)) == Twist(0.0, 0.5)


def test_near_people_all_speeds_are_lower() -> None:
    near, far = BaseLimits().cap(is_near=True), BaseLimits().cap(is_near=False)
    assert near.forward < far.forward
    assert near.backward < far.backward
    assert near.angular < far.angular
    assert math.isclose(BaseLimits(forward=0.2).cap(is_near=True).forward, 0.2)
