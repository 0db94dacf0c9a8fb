"""Motions of both kinds of base, measured in the simulated world against the closed form."""

import math
import os
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import pytest
import trio
from hypothesis import given, settings, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.signals import Pose2D, Twist
from hri.drive.velocity_limits import BaseLimits
from hri.hal.drive import DriveSystem, Odometry, Stop
from hri.hal.emergency_stop import EmergencyStop
from hri.hal.motion import Way
from hri.hal.motion_profile import Trapezoid
from hri.hal.pending import Interrupted, Pending
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.base import WATCHDOG
from hri.simulation.bases.simulated_base import SimulatedWheels
from hri.simulation.motors import SimulatedMotor
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
BACKWARD = BaseLimits().near_backward
BASES = {"a whole base": WHOLE, "two motors": TWO_MOTORS}


@dataclass(frozen=True)
class Measured:
    """The greatest velocities of a motion, and how far it went from where it began."""

    fastest: Twist
    farthest: Way


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

    def until_done(self, pending: Pending[None]) -> Measured:
        """Let time pass, and measure."""
        velocities, poses = [self.velocity()], [self.pose()]
        while not pending.is_done:
            self.clock.advance(0.01)
            velocities.append(self.velocity())
            poses.append(self.pose())
        pending.result()
        return Measured(
            Twist(
                max(abs(velocity.linear) for velocity in velocities),
                max(abs(velocity.angular) for velocity in velocities),
            ),
            Way(max(abs(pose.x) for pose in poses), max(abs(pose.heading) for pose in poses)),
        )


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
def test_half_a_meter_as_in_the_guide(robot: Robot) -> None:
    robot.drive.move_delta(0.5, 0.2, 0.4).wait()
    assert robot.clock.now() == pytest.approx(0.5 / 0.2 + 0.2 / 0.4, abs=0.06)
    assert robot.pose().x == pytest.approx(0.5, abs=0.001)
    assert robot.velocity() == Twist()


@pytest.mark.parametrize("distance", [50.0, -50.0, 20.01])
def test_a_move_beyond_the_longest_is_refused(robot: Robot, distance: float) -> None:
    with pytest.raises(HriError, match=r"longest_move \(20 m\)"):
        robot.drive.move_delta(distance, 20.0, 40.0)
    robot.clock.advance(1.0)
    assert robot.pose().x == 0.0


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
    done = robot.until_done(robot.drive.move_delta(distance, velocity, acceleration))
    cruise = min(velocity, robot.drive.max_linear if distance > 0 else BACKWARD)
    assert done.fastest.linear <= cruise + 1e-9
    assert done.farthest.linear <= 1.05 * abs(distance) + 0.005
    # A short move is sped up gently, and so does not go past its goal and come back.
    reachable = min(acceleration, 0.8 * robot.drive.max_acceleration, abs(distance) / 0.7**2)
    planned = Trapezoid(distance, cruise, reachable).duration
    assert planned - 0.02 <= robot.clock.now() <= planned + 0.5
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
    done = robot.until_done(robot.drive.turn_delta(angle, velocity, acceleration))
    cruise = min(velocity, robot.drive.max_angular)
    assert done.fastest.angular <= cruise + 1e-9
    assert done.farthest.angular <= 1.05 * abs(angle) + 0.01
    reachable = min(acceleration, 0.8 * robot.drive.max_angular_acceleration, abs(angle) / 0.6**2)
    planned = Trapezoid(angle, cruise, reachable).duration
    assert planned - 0.02 <= robot.clock.now() <= planned + 0.6
    robot.clock.advance(1.0)
    assert robot.pose().heading == pytest.approx(angle, abs=math.radians(0.1))
    assert robot.velocity() == Twist()
    robot.manager.close()


@pytest.mark.proves("H25", "H28")
def test_free_motion_is_an_arc_that_goes_on_until_countermanded(robot: Robot) -> None:
    robot.drive.move_and_turn(0.2, 0.4, -0.5, 1.0)
    robot.clock.advance(0.5)
    robot.clock.advance(0.2)  # the supervisor limits the jerk
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
    robot.clock.advance(0.8)
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
    assert ways[Stop.SMOOTH] == pytest.approx(0.3**2 / 2 / 0.4, abs=0.015)
    assert times[Stop.SMOOTH] == pytest.approx(0.3 / 0.4, abs=0.12)
    assert ways[Stop.ABRUPT] == pytest.approx(0.3**2 / 2 / 1.5, abs=0.005)
    assert times[Stop.ABRUPT] == pytest.approx(0.3 / 1.5, abs=0.06)


@pytest.mark.proves("H29")
def test_idle_power_holds_the_base_until_the_drive_is_given_back(robot: Robot) -> None:
    def pushed() -> float:
        before = robot.world.base.pose.x
        robot.world.push(0.1, robot.clock.now())
        robot.clock.advance(0.1)
        return robot.world.base.pose.x - before

    assert pushed() == pytest.approx(0.1)
    robot.drive.set_idle_power(60).wait()
    assert robot.world.is_held
    assert pushed() == pytest.approx(0.0, abs=1e-5)
    robot.drive.move_delta(0.1, 0.2, 0.4).wait()
    assert pushed() == pytest.approx(0.0, abs=1e-5)
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
    now = robot.clock.now()
    commands: list[Callable[[], object]] = [
        robot.drive.halt,
        lambda: robot.drive.set_velocity(Twist(0.3), now),
        lambda: robot.drive.set_idle_power(60),
        lambda: robot.drive.set_move_power(60),
    ]
    for command in commands:
        with pytest.raises(HriError, match="the drive is closed - obtain it"):
            command()
    robot.drive.stop(now)
    robot.clock.advance(1.0)
    assert robot.velocity() == Twist()
    assert not robot.world.is_held


def test_less_power_for_motions_speeds_up_more_slowly(robot: Robot) -> None:
    robot.drive.set_move_power(50).wait()
    robot.drive.move_delta(0.5, 0.3, 9.0).wait()
    acceleration = 0.8 * 0.5 * robot.drive.max_acceleration
    assert robot.clock.now() == pytest.approx(Trapezoid(0.5, 0.3, acceleration).duration, abs=0.12)


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


def test_a_callback_may_answer_another_command_with_the_next_motion(robot: Robot) -> None:
    answers: list[Pending[None]] = []
    first = robot.drive.move_delta(0.5, 0.2, 0.4)
    first.on_done(lambda _: answers.append(robot.drive.turn_delta(1.0, 0.5, 1.0)))
    robot.clock.advance(0.5)
    second = robot.drive.move_delta(0.2, 0.2, 0.4)
    with pytest.raises(Interrupted):
        second.result()
    answers[0].wait(10.0)
    assert robot.pose().heading == pytest.approx(1.0, abs=0.002)


STOPS: dict[str, Callable[[Robot], object]] = {
    "stop": lambda robot: robot.drive.stop(robot.clock.now()),
    "halt": lambda robot: robot.drive.halt(),
    "an abrupt halt": lambda robot: robot.drive.halt(Stop.ABRUPT),
}


@pytest.mark.parametrize("how", STOPS)
def test_no_callback_drives_on_after_a_stop(
    robot: Robot, how: str, caplog: pytest.LogCaptureFixture
) -> None:
    def patrol(_: object = None) -> None:
        robot.drive.move_delta(1.0, 0.3, 0.5).on_done(patrol)

    patrol()
    robot.clock.advance(1.0)
    STOPS[how](robot)
    robot.clock.advance(2.0)
    assert robot.velocity() == Twist()
    assert "the drive is being stopped - move it afterwards" in caplog.text
    robot.drive.move_delta(0.1, 0.2, 0.4).wait()


def test_cancelling_leaves_the_motion_alone_that_its_callback_began(robot: Robot) -> None:
    answers: list[Pending[None]] = []
    motion = robot.drive.move_delta(-0.5, 0.2, 0.4)
    motion.on_done(lambda _: answers.append(robot.drive.turn_delta(1.0, 0.5, 1.0)))
    robot.clock.advance(0.1)
    motion.cancel()
    answers[0].wait(10.0)
    assert robot.pose().heading == pytest.approx(1.0, abs=0.002)


def test_who_is_told_of_an_end_finds_the_drive_free(robot: Robot) -> None:
    """Even another thread may take it, which a lock that is held would keep out."""
    outcomes: list[str] = []

    def ask_elsewhere(_: object) -> None:
        asks = threading.Thread(target=lambda: robot.drive.stop(robot.clock.now()), daemon=True)
        asks.start()
        asks.join(5.0)
        outcomes.append("kept out" if asks.is_alive() else "let in")

    robot.drive.move_delta(0.1, 0.2, 0.4).on_done(ask_elsewhere)
    robot.clock.advance(2.0)
    robot.drive.move_delta(2.0, 0.2, 0.4).on_done(ask_elsewhere)
    robot.clock.advance(1.0)
    robot.drive.set_velocity(Twist(), robot.clock.now())
    assert outcomes == ["let in", "let in"]


class LooseCable(SimulatedWheels):
    """Wheels that sometimes cannot be reached."""

    is_loose = brakes_too = False

    def roll(self, twist: Twist, now: float) -> None:
        if self.is_loose:
            raise OSError("serial port gone")
        super().roll(twist, now)

    def brake(self, now: float) -> None:
        if self.is_loose and not self.brakes_too:
            raise OSError("serial port gone")
        super().brake(now)


@pytest.fixture
def cable() -> Iterator[tuple[Robot, LooseCable]]:
    robot = made(WHOLE)
    robot.manager.release(robot.drive)
    wheels = LooseCable(robot.manager.descriptions["world_base_line"], robot.manager)
    robot.manager.substitute("world_base_line", wheels)
    robot.drive = robot.manager.obtain("drive", DriveSystem)
    yield robot, wheels
    robot.manager.close()


LOST = "I lost the line to my wheels - unlatch the base first"


@pytest.mark.parametrize("brakes_too", [False, True])
def test_a_motion_whose_hardware_fails_ends_and_a_person_releases_the_base(
    cable: tuple[Robot, LooseCable], brakes_too: bool, caplog: pytest.LogCaptureFixture
) -> None:
    robot, wheels = cable
    wheels.brakes_too = brakes_too

    async def main() -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(robot.clock.drive)
            motion = robot.drive.move_delta(1.0, 0.3, 0.5)
            await robot.clock.sleep(1.0)
            wheels.is_loose = True
            with pytest.raises(HriError, match=LOST):
                await motion
            at_the_failure = robot.pose().x
            await robot.clock.sleep(2.0)
            assert robot.velocity() == Twist()
            if brakes_too:
                assert robot.pose().x - at_the_failure < 0.3**2 / 2 / 1.5 + 0.01
            wheels.is_loose = False
            with pytest.raises(HriError, match=LOST):
                await robot.drive.move_delta(0.1, 0.2, 0.4)
            assert isinstance(robot.drive, EmergencyStop)
            robot.drive.unlatch()
            await robot.clock.sleep(0.1)
            await robot.drive.move_delta(0.1, 0.2, 0.4)
            nursery.cancel_scope.cancel()

    trio.run(main)
    assert "serial port gone" in caplog.text


def test_hardware_that_fails_at_once_is_told_to_the_caller(
    cable: tuple[Robot, LooseCable],
) -> None:
    robot, wheels = cable
    wheels.is_loose = True
    with pytest.raises(HriError, match=LOST):
        robot.drive.move_delta(1.0, 0.3, 0.5).wait()
    with pytest.raises(HriError, match=LOST):
        robot.drive.move_and_turn(0.3, 0.5, 0.0, 1.0)


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
    robot = made(TWO_MOTORS)
    left, right = (robot.manager.obtain(id, SimulatedMotor) for id in ("left", "right"))
    robot.drive.move_delta(0.5, 0.2, 0.4).wait()
    now = robot.clock.now()
    assert left.counts(now) == pytest.approx(-1711 * 50, rel=0.002)
    assert right.counts(now) == pytest.approx(1711 * 50, rel=0.002)
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


class Encoder(SimulatedMotor):
    """A motor whose encoder can be unplugged."""

    is_unplugged = False

    def position(self, now: float) -> float:
        if self.is_unplugged:
            raise OSError("no encoder")
        return super().position(now)


def test_odometry_makes_up_for_polls_that_failed(caplog: pytest.LogCaptureFixture) -> None:
    clock = FakeClock()
    world = Description("world", "Hri.SimulatedWorld", {"voice": "voice"})
    manager = ResourceManager((world, *TWO_MOTORS), clock)
    manager.substitute("voice", ToneVoice(Description("voice", "Hri.EspeakVoice"), manager))
    encoder = Encoder(TWO_MOTORS[0], manager)
    manager.substitute("left", encoder)
    odometry, drive = manager.obtain("odometry", Odometry), manager.obtain("drive", DriveSystem)
    for step in range(10):
        drive.set_velocity(Twist(0.2), clock.now())
        encoder.is_unplugged = step in (5, 6)
        clock.advance(0.04)
    encoder.is_unplugged = False
    drive.stop(clock.now())
    clock.advance(1.0)
    world_base = manager.obtain("world", SimulatedWorld).base
    assert odometry.pose(clock.now()).x == pytest.approx(world_base.odometry.x, abs=0.001)
    assert world_base.odometry.x > 0.01
    assert caplog.text.count("a motor cannot be read: no encoder\n") == 1
    manager.close()


def test_odometry_that_was_closed_while_a_poll_waited_polls_no_more() -> None:
    robot = made(TWO_MOTORS)
    robot.manager.release(robot.drive)
    polls = threading.Thread(target=robot.clock.advance, args=(0.5,), daemon=True)
    with robot.odometry._lock:
        polls.start()
        while robot.clock.now() == 0.0:  # until the poll is due and waits for the lock
            os.sched_yield()
        robot.manager.release(robot.odometry)
    polls.join(5.0)
    assert not polls.is_alive()
    assert not robot.odometry.is_active
    robot.manager.release(robot.world)
    with pytest.raises(RuntimeError, match="nothing is left that could happen"):
        robot.clock.advance_until(lambda: robot.clock.now() > 100.0)
