import math

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Pose2D, Twist
from hri.simulation.base import STEP, WATCHDOG, Base, HardwareLimits, reachable
from hri.simulation.room import Room, Wall


def base_in(room: Room, **options: float) -> Base:
    return Base(lambda x, y, time: room.clearance(x, y), **options)  # type: ignore[arg-type]


def drive(base: Base, twist: Twist, start: float, end: float) -> None:
    """Command at 50 Hz, the way a network does."""
    for tick in range(round(start * 50), round(end * 50)):
        base.command(twist, tick / 50)
    base.advance(end)


def test_speeding_up_covers_the_way_of_a_trapezoid() -> None:
    base = base_in(Room())
    drive(base, Twist(0.3), 0.0, 4.0)
    drive(base, Twist(), 4.0, 6.0)
    # 0.6 s up to 0.3 m/s at 0.5 m/s^2, then steady until 4 s, then down at 1.5 m/s^2.
    assert base.odometry.x == pytest.approx(0.09 + 0.3 * 3.4 + 0.03, abs=1e-9)
    assert base.pose == base.odometry
    assert base.velocity == Twist()


def test_turning_in_place_stays_in_place() -> None:
    base = base_in(Room())
    drive(base, Twist(0.0, 1.0), 0.0, 2.0)
    drive(base, Twist(), 2.0, 4.0)
    # 0.5 s up to 1 rad/s at 2 rad/s^2, then steady until 2 s, then down at 6 rad/s^2.
    assert base.pose.heading == pytest.approx(0.25 + 1.5 + 1 / 12, abs=1e-3)
    assert (base.pose.x, base.pose.y) == (0.0, 0.0)


def test_a_steady_curve_is_a_circle() -> None:
    base = base_in(Room())
    drive(base, Twist(0.25, 0.5), 0.0, 1.0)
    start = base.pose
    drive(base, Twist(0.25, 0.5), 1.0, 1.0 + 4 * math.pi)
    left = start.x - 0.5 * math.sin(start.heading), start.y + 0.5 * math.cos(start.heading)
    assert math.dist(left, (base.pose.x, base.pose.y)) == pytest.approx(0.5, abs=1e-4)


def test_it_stops_when_no_command_comes() -> None:
    base = base_in(Room())
    drive(base, Twist(0.3), 0.0, 2.0)
    last = 2.0 - 1 / 50
    base.advance(last + WATCHDOG)
    assert base.velocity.linear == 0.3
    base.advance(last + WATCHDOG + 0.3 / HardwareLimits().braking + STEP)
    assert base.velocity == Twist()


def test_braking_is_faster_than_slowing_down() -> None:
    base = base_in(Room())
    drive(base, Twist(0.3), 0.0, 2.0)
    way = base.odometry.x
    base.brake(2.0)
    base.advance(3.0)
    assert base.odometry.x - way == pytest.approx(0.3**2 / 2 / HardwareLimits().braking, abs=1e-9)


def test_a_wall_stops_it_and_presses_the_bumper() -> None:
    base = base_in(Room([Wall(1.0, -1.0, 1.0, 1.0)]))
    drive(base, Twist(0.4), 0.0, 2.0)
    assert not base.is_touching
    drive(base, Twist(0.4), 2.0, 5.0)
    assert base.is_touching
    assert base.velocity.linear == 0.0
    assert base.pose.x + base.limits.radius == pytest.approx(1.0, abs=0.01)
    drive(base, Twist(-0.2), 5.0, 6.0)
    assert not base.is_touching


def test_it_can_turn_and_leave_where_it_touches() -> None:
    base = base_in(Room([Wall(0.1, -1.0, 0.1, 1.0)]))  # the wall has come into the body
    drive(base, Twist(0.3, 1.0), 0.0, 1.0)
    assert base.pose.x == 0.0
    assert base.pose.heading > 0.5
    drive(base, Twist(-0.3), 1.0, 4.0)
    assert math.hypot(base.pose.x, base.pose.y) > 0.3


@pytest.mark.parametrize("nonsense", [Twist(math.nan, 0.0), Twist(0.1, math.inf)])
def test_a_command_that_is_not_finite_means_standing_still(nonsense: Twist) -> None:
    assert reachable(nonsense, HardwareLimits()) == Twist()


@given(st.floats(-5, 5), st.floats(-9, 9))
def test_the_wheels_never_go_faster_than_they_can(linear: float, angular: float) -> None:
    limits = HardwareLimits()
    twist = reachable(Twist(linear, angular), limits)
    assert abs(twist.linear) + abs(twist.angular) * limits.track / 2 <= limits.wheel + 1e-9


@settings(max_examples=25, deadline=None)
@given(st.lists(st.floats(0.001, 0.7), min_size=1, max_size=30))
def test_where_it_is_does_not_depend_on_how_often_it_is_asked(slices: list[float]) -> None:
    room = Room([Wall(1.5, -2.0, 1.5, 2.0)])
    asked, left_alone = base_in(room, slip=0.01, seed=3), base_in(room, slip=0.01, seed=3)
    commands = {0.0: Twist(0.4, 0.3), 0.437: Twist(0.5, -0.2), 0.9: Twist(0.2, 1.0)}
    times = sorted({*commands, *(sum(slices[:i]) for i in range(len(slices))), 3.0})
    for time in times:
        if time in commands:
            asked.command(commands[time], time)
            left_alone.command(commands[time], time)
        elif time <= 3.0:
            asked.advance(time)
    left_alone.advance(3.0)
    assert asked.pose == left_alone.pose
    assert asked.odometry == left_alone.odometry


def test_slip_repeats_by_its_seed_and_is_small() -> None:
    def end(seed: int) -> Pose2D:
        base = base_in(Room(), slip=0.002, seed=seed)
        drive(base, Twist(0.5), 0.0, 22.0)
        assert base.odometry.y == 0.0
        assert abs(base.pose.x / base.odometry.x - 1) < 0.01
        return base.pose

    assert end(1) == end(1)
    assert end(1) != end(2)
