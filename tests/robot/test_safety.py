"""The base stops when what is above it stops talking."""

import pytest

from hri.core.clock import FakeClock
from hri.core.signals import Twist
from hri.drive.behaviors import CommandGate
from hri.drive.tasks import move
from hri.hal.drive import DriveSystem, Odometry
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.testing import live_for
from tests.devices import BLIND, UNSEEN


def fail(now, dt):
    raise OSError("the cable is off")


class Ride:
    """Drives ahead; after three seconds something happens; poses are noted all the while."""

    def __init__(self, happening, distance=10.0):
        robot = Robot(config="simulated", clock=FakeClock(), devices=[UNSEEN, BLIND])
        odometry = robot.resources.obtain("odometry", Odometry)
        self.way = {}

        async def drive(context):
            await move(context, distance)

        async def spoil(context):
            await context.clock.sleep(3.0)
            happening(robot)

        async def watch(context):
            while True:
                now = context.clock.now()
                self.way[round(now, 1)] = odometry.pose(now).x
                await context.clock.sleep(0.1)

        live_for(robot, 6.0, drive, spoil, watch)

    def check(self, stopped_after):
        assert self.way[3.0] > 0.5, "it drove"
        assert self.way[5.9] == pytest.approx(self.way[round(3.0 + stopped_after, 1)], abs=0.005)


def test_a_gate_that_fails_stops_the_base():
    def happening(robot):
        robot.context.behavior(CommandGate).compute = fail

    Ride(happening).check(stopped_after=1.0)


def test_a_network_that_no_longer_ticks_stops_the_base():
    def happening(robot):
        for runner in robot.runners:
            if runner.network.name == "moving":
                runner.tick = lambda now: 0.0

    # Half a second until the base's own watchdog, and the way it needs to come to rest.
    Ride(happening).check(stopped_after=1.7)


def test_a_task_that_writes_nonsense_moves_nothing():
    def happening(robot):
        slot = robot.board.slot("drive.command")
        slot.set(Twist(float("nan"), float("inf")), robot.clock.now())
        robot.context.behavior(CommandGate).halt()

    Ride(happening).check(stopped_after=1.2)


def test_a_drive_that_gets_nonsense_stands_still():
    robot = Robot(config="simulated", clock=FakeClock(), devices=[UNSEEN, BLIND])
    drive = robot.resources.obtain("drive", DriveSystem)
    odometry = robot.resources.obtain("odometry", Odometry)
    for twist in (Twist(float("nan"), 0.0), Twist(float("inf"), float("nan"))):
        drive.set_velocity(twist, robot.clock.now())
        robot.clock.advance(0.3)
    assert odometry.pose(robot.clock.now()).x == 0.0
    robot.close()


def test_a_bump_ends_a_way_back_too():
    def happening(robot):
        robot.resources.obtain("world", SimulatedWorld).bump(robot.clock.now())

    ride = Ride(happening, distance=-2.0)
    assert ride.way[3.0] < -0.35, "it drove"
    assert ride.way[5.9] == pytest.approx(ride.way[4.0], abs=0.005)


def test_stop_is_obeyed_where_no_task_of_an_app_listens():
    def happening(robot):
        robot.resources.obtain("world", SimulatedWorld).say("stop moving", robot.clock.now())

    ride = Ride(happening)
    assert ride.way[5.9] < 2.0
    assert ride.way[5.9] == pytest.approx(ride.way[5.5], abs=0.02)
