import math

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Twist
from hri.drive.gate import VelocityGate
from hri.drive.velocity_limits import GateLimits
from hri.hal.motion import REST
from hri.hal.motion_profile import velocity_for

TICK = 0.02
anything = st.floats(allow_nan=True, allow_infinity=True, width=32)
twists = st.builds(Twist, anything, anything)


def run(gate: VelocityGate, seconds: float, start: float = 0.0, **inputs: float) -> float:
    """Tick without new commands; the time after it."""
    ticks = round(seconds / TICK)
    for tick in range(ticks + 1):
        gate.velocity(start + tick * TICK, **inputs)
    return start + ticks * TICK


def test_a_command_is_reached_with_the_acceleration_limit() -> None:
    gate = VelocityGate(GateLimits(acceleration=0.4))
    gate.velocity(0.0)
    gate.command(Twist(0.3), 0.0)
    assert gate.velocity(0.1).linear == pytest.approx(0.04)
    gate.command(Twist(0.3), 0.5)
    assert run(gate, 0.5, 0.1) == pytest.approx(0.6)
    assert gate.velocity(0.85).linear == pytest.approx(0.3)


def test_without_commands_it_slows_down_after_half_a_second() -> None:
    gate = VelocityGate(GateLimits(deceleration=0.5))
    gate.command(Twist(0.2), 0.0)
    run(gate, 0.5)
    assert gate.current.linear == pytest.approx(0.2)
    run(gate, 0.2, 0.52)
    assert 0.05 < gate.current.linear < 0.15
    run(gate, 0.4, 0.74)
    assert gate.current == REST
    assert gate.reason == "timeout"


def test_halt_is_abrupt() -> None:
    gate = VelocityGate()
    gate.command(Twist(0.3, 0.5), 0.0)
    run(gate, 0.4)
    gate.halt()
    assert gate.velocity(0.42) == REST
    assert gate.reason == "halt"


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_counted_and_stops(bad: float) -> None:
    gate = VelocityGate()
    gate.command(Twist(0.3), 0.0)
    run(gate, 0.4)
    gate.command(Twist(0.3, bad), 0.4)
    run(gate, 1.0, 0.42)
    assert gate.current == REST
    assert gate.refused == 1


def test_a_way_that_is_not_a_number_is_refused_and_no_arrival() -> None:
    gate = VelocityGate()
    gate.command(Twist(velocity_for(math.nan, 0.3, 0.5, TICK)), 0.0)
    assert gate.velocity(TICK) == REST
    assert gate.refused == 1


def test_a_curve_keeps_its_shape_when_it_is_too_fast() -> None:
    gate = VelocityGate(GateLimits(max_linear=0.4, max_angular=1.2))
    gate.command(Twist(0.8, 0.6), 0.0)
    gate.velocity(0.0)
    assert gate.target == Twist(0.4, 0.3)


def test_the_speed_factor_never_breaks_the_limit() -> None:
    gate = VelocityGate(GateLimits(max_linear=0.4))
    gate.command(Twist(0.3), 0.0)
    gate.velocity(0.0, speed=0.6)
    assert gate.target.linear == pytest.approx(0.18)
    gate.velocity(0.02, speed=2.0)
    assert gate.target.linear == pytest.approx(0.4)


def test_before_a_wall_it_may_turn_and_back_off() -> None:
    gate = VelocityGate()
    gate.command(Twist(0.3, 0.5), 0.0)
    gate.velocity(0.0, max_forward=0.0)
    assert gate.target == Twist(0.0, 0.5)
    gate.command(Twist(-0.3), 0.02)
    gate.velocity(0.02, max_forward=0.0)
    assert gate.target == Twist(-0.3)


def test_reversing_stops_at_zero_first() -> None:
    gate = VelocityGate(GateLimits(acceleration=0.4, deceleration=0.4))
    gate.command(Twist(0.1), 0.0)
    run(gate, 0.4)
    gate.command(Twist(-0.1), 0.42)
    passed = []
    for tick in range(40):
        passed.append(gate.velocity(0.42 + tick * TICK).linear)
    assert 0.0 in passed
    assert min(passed) == pytest.approx(-0.1)


def test_after_a_long_gap_it_starts_from_rest() -> None:
    gate = VelocityGate()
    gate.command(Twist(0.3), 0.0)
    run(gate, 0.5)
    gate.command(Twist(0.3), 5.0)
    assert gate.velocity(5.0) == REST


@settings(deadline=None)
@given(st.lists(st.tuples(st.floats(0, 0.4), twists, anything), max_size=40))
def test_no_input_breaks_a_limit(steps: list[tuple[float, Twist, float]]) -> None:
    limits = GateLimits()
    gate, now = VelocityGate(limits), 0.0
    before = gate.velocity(now)
    for wait, twist, speed in steps:
        now += wait
        gate.command(twist, now)
        after = gate.velocity(now, speed=speed, max_forward=0.3)
        assert -limits.max_linear <= after.linear <= 0.3
        assert abs(after.angular) <= limits.max_angular
        change = max(limits.acceleration, limits.deceleration) * wait + 1e-9
        assert abs(after.linear - before.linear) <= change
        assert abs(after.angular - before.angular) <= 4 * change
        before = after
