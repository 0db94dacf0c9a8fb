"""The navigation tasks of 2003 on the drive itself, and what they hold of it."""

import pytest

from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.drive import tasks as verbs
from hri.drive.navigation import drive_move_delta, drive_turn_delta, stop
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.resource import Description
from hri.task.context import TaskContext
from tests.task.stage import Stage


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
        with pytest.raises(HriError, match=r"the velocity is .* above 0"):
            await drive_move_delta(context, 5.0, -1.0)
        with pytest.raises(ValueError, match="cannot go nan"):
            await verbs.move(context, float("nan"))
        assert users(context) == (0, 0)
        assert await verbs.move(context, 0.1) == pytest.approx(0.1, abs=0.01)
        await verbs.stop(context)
        assert users(context) == (1, 0), "the gate that was started for it stays"

    drivable().run(drive)


def test_a_cancelled_motion_ends_gently_and_then_gives_the_drive_back() -> None:
    async def drive(context: TaskContext) -> None:
        odometry = context.resources.obtain("odometry", Odometry)

        def speed() -> float:
            return odometry.velocity(context.clock.now()).linear

        with context.clock.move_on_after(2.0):
            await drive_move_delta(context, 200.0, 30.0)
        assert users(context)[0] == 1
        await context.clock.sleep(0.2)
        # 0.4 m/s^2; a drive that is given back brakes with 1.5.
        assert speed() == pytest.approx(0.3 - 0.2 * 0.4, abs=0.03)
        await context.clock.sleep(1.0)
        assert odometry.velocity(context.clock.now()) == Twist()
        assert users(context)[0] == 0
        context.resources.release(odometry)

    drivable().run(drive)


def test_a_task_refuses_a_move_beyond_the_longest_in_the_unit_it_was_given_in() -> None:
    async def drive(context: TaskContext) -> None:
        with pytest.raises(HriError, match=r"a move of 5000 cm \(50 m\) is longer than longest"):
            await drive_move_delta(context, 5000.0)

    drivable().run(drive)
