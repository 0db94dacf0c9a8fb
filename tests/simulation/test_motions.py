"""Motions of both kinds of base, measured in the simulated world against the closed form."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import pytest
import trio
from hypothesis import given, settings
from hypothesis import strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.signals import Pose2D, Twist
from hri.hal.drive import DriveSystem, Odometry, Stop
from hri.hal.manager import ResourceManager
from hri.hal.pending import Interrupted, Pending
from hri.hal.profile import Trapezoid
from hri.hal.resource import Description
from hri.simulation.base import WATCHDOG
from hri.simulation.world import SimulatedWorld

from .conftest import ToneVoice

WHOLE = (
    Description("drive", "Hri.SimulatedDrive"),
    Description("odometry", "Hri.SimulatedOdometry"),
)
TWO_MOTORS = (
    Description("left", "Evolution.RCMMotor", {"y": "19", "position_factor": "-1711"}),
    Description("right", "Evolution.RCMMotor", {"y": "-19", "position_factor": "1711"}),
    Description("drive", "Evolution.Diff2Drive", members=("left", "right")),
    Description("odometry", "Evolution.Diff2Odometry", members=("left", "right")),
)
BASES = {"a whole base": WHOLE, "two motors": TWO_MOTORS}


@dataclass
class Robot:
    """A base with what measures it."""

    clock: FakeClock
    manager: ResourceManager
    drive: DriveSystem
    odometry: Odometry
    world: SimulatedWorld

    def pose(self) -> Pose2D:
        return self.odometry.pose(self.clock.now())

    def velocity(self) -> Twist:
        return self.odometry.velocity(self.clock.now())

    def fastest_until_done(self, pending: Pending[None]) -> Twist:
        """Let time pass; the greatest velocities that were measured."""
        linear = angular = 0.0
        while not pending.is_done:
            self.clock.advance(0.01)
            linear = max(linear, abs(self.velocity().linear))
            angular = max(angular, abs(self.velocity().angular))
        pending.result()
        return Twist(linear, angular)


def made(devices: tuple[Description, ...]) -> Robot:
    clock = FakeClock()
    world = Description("world", "Hri.SimulatedWorld", {"voice": "voice"})
    manager = ResourceManager((world, *devices), clock)
    manager.check()
    manager.substitute("voice", ToneVoice(Description("voice", "Hri.EspeakVoice"), manager))
    return Robot(
        clock,
        manager,
        manager.obtain("drive", DriveSystem),
        manager.obtain("odometry", Odometry),
        manager.obtain("world", SimulatedWorld),
    )


@pytest.fixture(params=BASES.values(), ids=BASES)
def robot(request: pytest.FixtureRequest) -> Iterator[Robot]:
    robot = made(request.param)
    yield robot
    robot.manager.close()


@pytest.mark.proves("H25", "H27")
def test_half_a_metre_as_in_the_guide(robot: Robot) -> None:
    robot.drive.move_delta(0.5, 0.2, 0.4).wait()
    assert robot.clock.now() == pytest.approx(0.5 / 0.2 + 0.2 / 0.4, abs=0.06)
    assert robot.pose().x == pytest.approx(0.5, abs=0.001)
    assert robot.velocity() == Twist()


@pytest.mark.proves("H25", "H27")
def test_a_quarter_turn_as_in_the_guide(robot: Robot) -> None:
    robot.drive.turn_delta(math.pi / 2, math.pi / 6, math.pi / 3).wait()
    assert robot.clock.now() == pytest.approx(3.0 + 0.5, abs=0.06)
    assert robot.pose().heading == pytest.approx(math.pi / 2, abs=math.radians(0.1))
    assert math.hypot(robot.pose().x, robot.pose().y) < 0.001


@pytest.mark.proves("H25")
@pytest.mark.parametrize("devices", BASES.values(), ids=BASES)
@settings(deadline=None, max_examples=25)
@given(st.floats(-1.5, 1.5), st.floats(0.02, 0.6), st.floats(0.05, 1.0))
def test_a_move_keeps_to_its_profile(
    devices: tuple[Description, ...], distance: float, velocity: float, acceleration: float
) -> None:
    robot = made(devices)
    fastest = robot.fastest_until_done(robot.drive.move_delta(distance, velocity, acceleration))
    cruise = min(velocity, robot.drive.max_linear)
    assert fastest.linear <= cruise + 1e-9
    reachable = min(acceleration, 0.8 * robot.drive.max_acceleration)
    planned = Trapezoid(distance, cruise, reachable).duration
    assert robot.clock.now() == pytest.approx(planned, abs=0.08)
    robot.clock.advance(1.0)
    assert robot.pose().x == pytest.approx(distance, abs=0.001)
    assert robot.velocity() == Twist()
    robot.manager.close()


@pytest.mark.proves("H25")
@pytest.mark.parametrize("devices", BASES.values(), ids=BASES)
@settings(deadline=None, max_examples=25)
@given(st.floats(-7, 7), st.floats(0.05, 2.0), st.floats(0.2, 4.0))
def test_a_turn_keeps_to_its_profile(
    devices: tuple[Description, ...], angle: float, velocity: float, acceleration: float
) -> None:
    robot = made(devices)
    fastest = robot.fastest_until_done(robot.drive.turn_delta(angle, velocity, acceleration))
    cruise = min(velocity, robot.drive.max_angular)
    assert fastest.angular <= cruise + 1e-9
    reachable = min(acceleration, 0.8 * robot.drive.max_angular_acceleration)
    assert robot.clock.now() == pytest.approx(Trapezoid(angle, cruise, reachable).duration, abs=0.1)
    robot.clock.advance(1.0)
    assert robot.pose().heading == pytest.approx(angle, abs=math.radians(0.1))
    assert robot.velocity() == Twist()
    robot.manager.close()


@pytest.mark.proves("H25", "H28")
def test_free_motion_is_an_arc_that_goes_on_until_countermanded(robot: Robot) -> None:
    robot.drive.move_and_turn(0.2, 0.4, -0.5, 1.0)
    robot.clock.advance(0.5)
    assert robot.velocity().linear == pytest.approx(0.2, abs=0.01)
    start = robot.pose()
    robot.clock.advance(10 * WATCHDOG)
    assert robot.velocity().linear == pytest.approx(0.2, abs=1e-6)
    assert robot.velocity().angular == pytest.approx(-0.5, abs=1e-6)
    # The circle of radius v / w, with its middle to the right.
    middle = start.x + 0.4 * math.sin(start.heading), start.y - 0.4 * math.cos(start.heading)
    end = robot.pose()
    assert math.dist(middle, (end.x, end.y)) == pytest.approx(0.4, abs=0.002)
    assert end.heading - start.heading == pytest.approx(-0.5 * 10 * WATCHDOG, abs=0.001)
    robot.drive.move_and_turn(0.0, 0.4, 0.0, 1.0)
    robot.clock.advance(0.6)
    assert robot.velocity() == Twist()


@pytest.mark.proves("H26", "H27")
def test_both_ways_to_stop_have_their_own_profile(robot: Robot) -> None:
    ways, times = {}, {}
    for how in Stop:
        robot.drive.move_and_turn(0.3, 0.4, 0.0, 1.0)
        robot.clock.advance(2.0)
        start, began = robot.pose(), robot.clock.now()
        robot.drive.halt(how).wait()
        ways[how], times[how] = robot.pose().x - start.x, robot.clock.now() - began
        assert robot.velocity() == Twist()
    # v^2 / 2a and v / a with the decelerations of 0.4 and 1.5 m/s^2.
    assert ways[Stop.SMOOTH] == pytest.approx(0.3**2 / 2 / 0.4, abs=0.01)
    assert times[Stop.SMOOTH] == pytest.approx(0.3 / 0.4, abs=0.06)
    assert ways[Stop.ABRUPT] == pytest.approx(0.3**2 / 2 / 1.5, abs=0.005)
    assert times[Stop.ABRUPT] == pytest.approx(0.3 / 1.5, abs=0.06)


@pytest.mark.proves("H29")
def test_idle_power_holds_the_base_until_the_drive_is_given_back(robot: Robot) -> None:
    def pushed() -> float:
        before = robot.world.base.pose.x
        robot.world.push(0.1, robot.clock.now())
        return robot.world.base.pose.x - before

    assert pushed() == pytest.approx(0.1)
    robot.drive.set_idle_power(60).wait()
    assert robot.world.is_held
    assert pushed() == 0.0
    robot.drive.move_delta(0.1, 0.2, 0.4).wait()
    assert pushed() == 0.0
    robot.manager.release(robot.drive)
    assert not robot.world.is_held
    assert pushed() == pytest.approx(0.1)


def test_giving_the_drive_back_stops_it(robot: Robot) -> None:
    pending = robot.drive.move_delta(2.0, 0.3, 0.5)
    robot.clock.advance(2.0)
    robot.manager.release(robot.drive)
    with pytest.raises(Interrupted, match="the drive was closed"):
        pending.result()
    robot.clock.advance(1.0)
    assert robot.velocity() == Twist()
    with pytest.raises(HriError, match="the drive is closed - obtain it"):
        robot.drive.halt()


def test_less_power_for_motions_speeds_up_more_slowly(robot: Robot) -> None:
    robot.drive.set_move_power(50).wait()
    robot.drive.move_delta(0.5, 0.3, 9.0).wait()
    acceleration = 0.8 * 0.5 * robot.drive.max_acceleration
    assert robot.clock.now() == pytest.approx(Trapezoid(0.5, 0.3, acceleration).duration, abs=0.06)


OTHERS: dict[str, Callable[[Robot], object]] = {
    "another command": lambda robot: robot.drive.turn_delta(0.1, 1.0, 1.0),
    "a velocity": lambda robot: robot.drive.set_velocity(Twist(), robot.clock.now()),
    "was stopped": lambda robot: robot.drive.stop(robot.clock.now()),
}


@pytest.mark.proves("H27")
@pytest.mark.parametrize("why", OTHERS)
def test_a_second_command_replaces_the_first_and_says_so(robot: Robot, why: str) -> None:
    first = robot.drive.move_delta(2.0, 0.3, 0.5)
    robot.clock.advance(1.0)
    OTHERS[why](robot)
    with pytest.raises(Interrupted, match=f"drive: .*{why}"):
        first.result()
    robot.clock.advance(2.0)
    assert robot.velocity() == Twist()


def test_cancelling_stops_the_base(robot: Robot) -> None:
    pending = robot.drive.move_delta(2.0, 0.3, 0.5)
    robot.clock.advance(1.5)
    pending.cancel()
    robot.clock.advance(0.3)
    assert robot.velocity() == Twist()


@pytest.mark.proves("H27")
def test_the_next_motion_may_be_asked_for_when_one_is_over(robot: Robot) -> None:
    ends: list[float] = []

    def back(_: object) -> None:
        robot.drive.move_delta(-0.2, 0.2, 0.4).on_done(lambda _: ends.append(robot.pose().x))

    robot.drive.move_delta(0.2, 0.2, 0.4).on_done(back)
    robot.clock.advance(5.0)
    assert ends == [pytest.approx(0.0, abs=0.001)]


@pytest.mark.proves("H27")
def test_motions_can_be_awaited_in_the_robot_loop(robot: Robot) -> None:
    async def main() -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(robot.clock.drive)
            await robot.drive.move_delta(0.3, 0.2, 0.4)
            await robot.drive.turn_delta(-1.0, 0.5, 1.0)
            nursery.cancel_scope.cancel()

    trio.run(main)
    assert robot.pose().x == pytest.approx(0.3, abs=0.001)
    assert robot.pose().heading == pytest.approx(-1.0, abs=0.002)


def test_a_base_that_is_held_up_fails_and_rests(robot: Robot) -> None:
    robot.drive.turn_delta(math.pi, 1.0, 1.5).wait()
    with pytest.raises(HriError, match=r"drive: it moved 230\.0 cm of 400\.0 cm - see"):
        robot.drive.move_delta(4.0, 0.5, 0.5).wait()  # the wall is 2.5 m behind the start
    robot.clock.advance(1.0)
    assert robot.velocity() == Twist()


@pytest.mark.parametrize("nonsense", [math.nan, math.inf, -math.inf])
def test_numbers_that_are_not_finite_are_refused(robot: Robot, nonsense: float) -> None:
    drive = robot.drive
    commands: list[Callable[[], object]] = [
        lambda: drive.move_delta(nonsense, 0.2, 0.4),
        lambda: drive.move_delta(1.0, nonsense, 0.4),
        lambda: drive.move_delta(1.0, 0.2, nonsense),
        lambda: drive.turn_delta(nonsense, 0.2, 0.4),
        lambda: drive.turn_delta(1.0, 0.2, nonsense),
        lambda: drive.move_and_turn(nonsense, 0.4, 0.0, 1.0),
        lambda: drive.move_and_turn(0.2, 0.4, nonsense, 1.0),
        lambda: drive.set_idle_power(nonsense),
        lambda: drive.set_move_power(nonsense),
    ]
    for command in commands:
        with pytest.raises(HriError, match=f"{nonsense} - give "):
            command()
    robot.clock.advance(0.5)
    assert robot.velocity() == Twist()


@pytest.mark.parametrize("least", [0.0, -0.2])
def test_velocities_and_accelerations_must_be_above_0(robot: Robot, least: float) -> None:
    with pytest.raises(HriError, match=r"the velocity is .* above 0"):
        robot.drive.move_delta(1.0, least, 0.4)
    with pytest.raises(HriError, match=r"the acceleration is .* above 0"):
        robot.drive.turn_delta(1.0, 0.4, least)
    with pytest.raises(HriError, match=r"the angular acceleration is .* above 0"):
        robot.drive.move_and_turn(0.1, 0.4, 0.1, least)
    with pytest.raises(HriError, match="the move power is 0 - give a percentage from 1 to 100"):
        robot.drive.set_move_power(0)


@pytest.mark.proves("H28")
def test_the_base_stops_when_time_no_longer_reaches_the_motion(robot: Robot) -> None:
    robot.drive.move_and_turn(0.2, 0.4, 0.0, 1.0)
    robot.clock.advance(1.0)
    # The program hangs: the world goes on, but no timer runs.
    later = robot.clock.now() + WATCHDOG + 0.3
    assert robot.odometry.velocity(later) == Twist()


def test_a_group_needs_two_motors_apart() -> None:
    one, two = TWO_MOTORS[0], Description("right", "Hri.SimulatedMotor", {"y": "19"})
    group = Description("drive", "Hri.Diff2Drive", members=("left", "right"))
    with pytest.raises(AuthoringError, match="left and right have the same y"):
        ResourceManager((one, two, group), FakeClock()).obtain("drive", DriveSystem)
    lonely = Description("drive", "Hri.Diff2Drive", members=("left",))
    with pytest.raises(AuthoringError, match="1 members - name two motors"):
        ResourceManager((one, lonely), FakeClock()).check()


@pytest.mark.proves("H06", "H07")
def test_motors_count_in_their_own_direction() -> None:
    from hri.simulation.motors import SimulatedMotor

    robot = made(TWO_MOTORS)
    left, right = (robot.manager.obtain(id, SimulatedMotor) for id in ("left", "right"))
    robot.drive.move_delta(0.5, 0.2, 0.4).wait()
    now = robot.clock.now()
    assert left.counts(now) == pytest.approx(-1711 * 50, rel=0.001)
    assert right.counts(now) == pytest.approx(1711 * 50, rel=0.001)
    robot.drive.turn_delta(math.pi, 1.0, 1.0).wait()
    now = robot.clock.now()
    assert left.position(now) == pytest.approx(0.5 - 0.19 * math.pi, abs=0.001)
    assert right.position(now) == pytest.approx(0.5 + 0.19 * math.pi, abs=0.001)


@pytest.mark.proves("H06")
def test_what_two_motors_add_up_is_where_the_base_is() -> None:
    robot = made(TWO_MOTORS)
    for linear, angular in ((0.2, 0.5), (0.3, -0.8), (-0.1, 0.2), (0.25, 0.0)):
        robot.drive.move_and_turn(linear, 0.4, angular, 1.0)
        robot.clock.advance(2.0)
    believed, true = robot.pose(), robot.world.base.odometry
    assert math.dist((believed.x, believed.y), (true.x, true.y)) < 0.002
    assert believed.heading == pytest.approx(true.heading, abs=0.001)


@pytest.mark.proves("H27")
def test_a_thread_may_drive_while_the_robot_loop_runs(robot: Robot) -> None:
    def script() -> None:
        robot.drive.move_delta(0.3, 0.2, 0.4).wait()
        robot.drive.turn_delta(1.0, 0.5, 1.0).wait()

    async def main() -> None:
        robot.clock.hold()  # as a robot does, whose time passes only while its script waits
        async with trio.open_nursery() as nursery:
            nursery.start_soon(robot.clock.drive)
            await trio.to_thread.run_sync(script)
            nursery.cancel_scope.cancel()

    trio.run(main)
    assert robot.pose().x == pytest.approx(0.3, abs=0.001)
    assert robot.pose().heading == pytest.approx(1.0, abs=0.002)
    planned = Trapezoid(0.3, 0.2, 0.4).duration + Trapezoid(1.0, 0.5, 1.0).duration
    assert robot.clock.now() == pytest.approx(planned, abs=0.15)
