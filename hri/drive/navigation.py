"""The navigation tasks of 2003, in the units that `hri.task.units` tells.

Where a network with a command gate runs, they drive through the gate, which limits what they ask
for and stops at obstacles. Without one they command the drive system itself, and nothing looks
ahead.
"""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable
from typing import TypeVar

from hri.core.errors import HriError
from hri.drive import tasks as verbs
from hri.drive.behaviors import CommandGate
from hri.hal.drive import DriveSystem, Stop
from hri.hal.pending import Pending
from hri.task.context import TaskContext
from hri.task.task import task
from hri.task.units import (
    UNIT_ACCELERATION,
    UNIT_ANGLE,
    UNIT_ANGULAR_ACCELERATION,
    UNIT_ANGULAR_VELOCITY,
    UNIT_DISTANCE,
    UNIT_VELOCITY,
    get_default_units,
    in_si,
)

T = TypeVar("T")

ACCELERATION = 0.3
"""Meters a second squared, when nobody says more."""
ANGULAR_ACCELERATION = 1.0
"""Radians a second squared."""
NEARLY = 0.9
"""A motion that got less far, as a share of its goal, has failed."""


@task("Hri.DriveMoveDelta")
async def drive_move_delta(
    context: TaskContext, distance: float, velocity: float = 0.0, acceleration: float = 0.0
) -> None:
    """Drive straight ahead, backward when negative; a velocity or acceleration of 0 is a usual one.

    Fails when the way is not free, or another task takes the drive. Raises HriError for a distance
    beyond `longest_move` of the drive.
    """
    distance_m = in_si(UNIT_DISTANCE, distance)
    given = f"{distance:g} {get_default_units(UNIT_DISTANCE)} ({distance_m:g} m)"
    verbs.refuse_too_long(context, distance_m, given, "see set_default_units for the unit")
    await _move(
        context,
        distance_m,
        in_si(UNIT_VELOCITY, velocity) or verbs.CRUISE,
        in_si(UNIT_ACCELERATION, acceleration) or ACCELERATION,
    )


@task("Hri.DriveTurnDelta")
async def drive_turn_delta(
    context: TaskContext, angle: float, velocity: float = 0.0, acceleration: float = 0.0
) -> None:
    """Turn on the spot, left when positive; a velocity or acceleration of 0 is a usual one."""
    await _turn(
        context,
        in_si(UNIT_ANGLE, angle),
        in_si(UNIT_ANGULAR_VELOCITY, velocity) or verbs.TURN_RATE,
        in_si(UNIT_ANGULAR_ACCELERATION, acceleration) or ANGULAR_ACCELERATION,
    )


@task("Hri.TurnRelative")
async def turn_relative(context: TaskContext, angle: float, velocity: float = 0.0) -> None:
    """Turn on the spot, left when positive."""
    await drive_turn_delta(context, angle, velocity)


@task("Hri.MoveRelative")
async def move_relative(context: TaskContext, heading: float, motion: tuple[float, ...]) -> None:
    """Turn by `heading`, left when positive, then drive straight on.

    `motion` is [distance, angular velocity, linear velocity]; the velocities may be 0 or left out.
    """
    if not 1 <= len(motion) <= 3:
        raise HriError(f"a motion of {len(motion)} numbers - give [distance, angular, linear]")
    distance, angular, linear = (*motion, 0.0, 0.0)[:3]
    async with context.claim("drive"):
        if heading:
            await drive_turn_delta(context, heading, angular)
        await drive_move_delta(context, distance, linear)


@task("Hri.Stop")
async def stop(context: TaskContext) -> None:
    """Bring the base to rest, whatever task moves it."""
    if context.find_behavior(CommandGate) is not None:
        await verbs.stop(context)
    else:
        await _carry_out(context, lambda drive: drive.halt(Stop.SMOOTH))


async def _move(context: TaskContext, distance: float, speed: float, acceleration: float) -> None:
    async with context.claim("drive"):
        if context.find_behavior(CommandGate) is None:
            await _carry_out(context, lambda drive: drive.move_delta(distance, speed, acceleration))
        else:
            gone = await checked(verbs.move(context, distance, speed))
            _refuse_short(context, gone, distance, "m")


async def _turn(context: TaskContext, angle: float, rate: float, acceleration: float) -> None:
    async with context.claim("drive"):
        if context.find_behavior(CommandGate) is None:
            await _carry_out(context, lambda drive: drive.turn_delta(angle, rate, acceleration))
        else:
            gone = await checked(verbs.turn(context, angle, rate))
            _refuse_short(context, gone, angle, "rad")


async def _carry_out(context: TaskContext, command: Callable[[DriveSystem], Pending[None]]) -> None:
    """Give the drive a command and wait for its end; when that is cancelled, it comes to rest.

    The drive is given back once the command is over, so that giving it back brakes nothing.
    """
    drive = _drive(context)
    motion: Pending[None] | None = None
    try:
        motion = command(drive)
        await motion
    finally:
        if motion is None or motion.is_done:
            context.resources.release(drive)
        else:
            drive.halt(Stop.SMOOTH).on_done(lambda _: context.resources.release(drive))


async def checked(motion: Awaitable[T]) -> T:
    """What a motion comes to. Raises HriError for what it refuses: the caller's mistake."""
    try:
        return await motion
    except ValueError as error:
        raise HriError(str(error)) from error


def _refuse_short(context: TaskContext, gone: float, goal: float, unit: str) -> None:
    if gone * math.copysign(1.0, goal) < NEARLY * abs(goal):
        context.fail(f"got {gone:.2f} of {goal:.2f} {unit} far - clear the way and try again")


def _drive(context: TaskContext) -> DriveSystem:
    drive = context.resources.find(DriveSystem)
    if drive is None:
        raise HriError("no drive system in the configuration - add one")
    return drive
