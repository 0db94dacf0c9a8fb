"""The navigation tasks of 2003 on the drive itself, and what they hold of it."""

from pathlib import Path

import pytest

from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.drive import tasks as verbs
from hri.drive.tasks_2003 import drive_move_delta, drive_turn_delta, stop
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.resource import Description
from hri.simulation.navigation_trips import SENSORS, devices
from hri.simulation.world import SimulatedWorld
from hri.task.context import TaskContext, TaskFailed
from tests.task.stage import Stage

WALL_AHEAD = """
[robot]
start = [1, 2]
[person]
at = [1, 3.5]
[[wall]]
from = [3, 0]
to = [3, 4]
"""


def drivable() -> Stage:
    return Stage(
        Description("world", "Hri.SimulatedWorld", {"voice": "mute"}),
        Description("mute", "Hri.EspeakVoice"),
        Description("drive", "Hri.SimulatedDrive"),
        Description("odometry", "Hri.SimulatedOdometry"),
    )


def users(context: TaskContext) -> tuple[int, int]:
    """How many hold the drive and the odometry."""
    drive = context.resources.obtain("drive", DriveSystem)
    odometry = context.resources.obtain("odometry", Odometry)
    counts = drive.reservations - 1, odometry.reservations - 1
    context.resources.release(drive)
    context.resources.release(odometry)
    return counts


def test_motions_give_back_what_they_took() -> None:
    async def drive(context: TaskContext) -> None:
        await drive_move_delta(context, 5.0)
        await drive_turn_delta(context, 0.2)
        await stop(context)
        with pytest.raises(HriError, match=r"the velocity is -1 cm/sec - give one above 0"):
            await drive_move_delta(context, 5.0, -1.0)
        with pytest.raises(HriError, match=r"the acceleration is nan rad/sec\^2 - "):
            await drive_turn_delta(context, 0.2, 1.0, float("nan"))
        with pytest.raises(ValueError, match="cannot go nan"):
            await verbs.move(context, float("nan"))
        assert await verbs.move(context, 0.1) == pytest.approx(0.1, abs=0.01)
        await verbs.stop(context)
        assert users(context) == (1, 0), "the gate that was started for them stays"

    drivable().run(drive)


def test_a_cancelled_motion_ends_gently() -> None:
    async def drive(context: TaskContext) -> None:
        odometry = context.resources.obtain("odometry", Odometry)

        def speed() -> float:
            return odometry.velocity(context.clock.now()).linear

        with context.clock.move_on_after(2.0):
            await drive_move_delta(context, 200.0, 30.0)
        await context.clock.sleep(0.2)
        # The gate slows down with 0.5 m/s^2; a drive that is let go brakes with 1.5.
        assert speed() == pytest.approx(0.3 - 0.2 * 0.5, abs=0.03)
        await context.clock.sleep(1.0)
        assert odometry.velocity(context.clock.now()) == Twist()
        context.resources.release(odometry)

    drivable().run(drive)


def test_where_no_network_runs_it_stops_before_what_its_sensors_see(tmp_path: Path) -> None:
    path = tmp_path / "room.toml"
    path.write_text(WALL_AHEAD)
    stage = Stage(*devices(path, 0, SENSORS["three sensors"]))
    world = stage.context.resources.obtain("world", SimulatedWorld)

    async def drive(context: TaskContext) -> None:
        with pytest.raises(TaskFailed, match=r"got 1\.\d\d of 4.00 m far - clear the way"):
            await drive_move_delta(context, 400.0)

    stage.run(drive)
    assert 2.0 < world.base.pose.x < 3.0 - world.base.limits.radius - 0.2
    assert stage.names().count("bumper.pressed") == 0


def test_stop_brings_a_drive_to_rest_that_no_gate_steers() -> None:
    async def drive(context: TaskContext) -> None:
        base = context.resources.obtain("drive", DriveSystem)
        base.move_and_turn(0.2, 0.4, 0.0, 1.0)
        await context.clock.sleep(1.0)
        await stop(context)
        assert not context.networks.runners
        odometry = context.resources.obtain("odometry", Odometry)
        assert odometry.velocity(context.clock.now()) == Twist()
        context.resources.release(odometry)
        context.resources.release(base)

    drivable().run(drive)


def test_a_task_refuses_a_move_beyond_the_longest_in_the_unit_it_was_given_in() -> None:
    async def drive(context: TaskContext) -> None:
        with pytest.raises(HriError, match=r"a move of 5000 cm \(50 m\) is longer than longest"):
            await drive_move_delta(context, 5000.0)

    drivable().run(drive)
