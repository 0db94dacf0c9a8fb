"""The navigation tasks of 2003, in the units of `hri.task.units`.

They are the verbs of `hri.drive.tasks`, so all of them go through a command gate; where none runs
they start one.
"""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable
from functools import partial
from typing import TypeVar

from hri.core.errors import HriError
from hri.core.quantities import Quantity
from hri.drive import tasks as verbs
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

NEARLY = 0.9
"""A motion that got less far, as a share of its goal, has failed."""
UNNOTICED = {"m": 0.005, "rad": 0.02}
"""What may be missing at the end of a small motion, of which half must be gone."""


@task("Hri.DriveMoveDelta")
async def drive_move_delta(
    context: TaskContext, distance: float, velocity: float = 0.0, acceleration: float = 0.0
) -> None:
    """Drive straight ahead, backward when negative; a velocity or acceleration of 0 is a usual one.

    The gate may allow less of both. Fails when the way is not free, or another task takes the
    drive. Raises HriError for a distance beyond `longest_move` of the drive, and for a velocity or
    acceleration below 0.
    """
    distance_m = in_si(UNIT_DISTANCE, distance)
    given = f"{distance:g} {get_default_units(UNIT_DISTANCE)} ({distance_m:g} m)"
    verbs.refuse_too_long(context, distance_m, given, "see set_default_units for the unit")
    speed = _given("velocity", UNIT_VELOCITY, velocity)
    rise = _given("acceleration", UNIT_ACCELERATION, acceleration)
    await _gone(context, partial(verbs.move, context, distance_m, speed, rise), distance_m, "m")


@task("Hri.DriveTurnDelta")
async def drive_turn_delta(
    context: TaskContext, angle: float, velocity: float = 0.0, acceleration: float = 0.0
) -> None:
    """Turn on the spot, left when positive; a velocity or acceleration of 0 is a usual one.

    Fails and raises as `drive_move_delta`.
    """
    angle_rad = in_si(UNIT_ANGLE, angle)
    rate = _given("velocity", UNIT_ANGULAR_VELOCITY, velocity)
    rise = _given("acceleration", UNIT_ANGULAR_ACCELERATION, acceleration)
    await _gone(context, partial(verbs.turn, context, angle_rad, rate, rise), angle_rad, "rad")


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
    await verbs.stop(context)


def _given(name: str, quantity: Quantity, value: float) -> float | None:
    """In SI units; None for 0, which is a usual one. Raises HriError for one below 0."""
    if not 0 <= value < math.inf:
        unit = get_default_units(quantity)
        raise HriError(f"the {name} is {value:g} {unit} - give one above 0, or 0 for a usual one")
    return in_si(quantity, value) or None


async def _gone(
    context: TaskContext, motion: Callable[[], Awaitable[float]], goal: float, unit: str
) -> None:
    """Wait for a motion. Fails the task when it did not get to its goal."""
    async with context.claim("drive"):
        gone = await checked(motion())
    whole = abs(goal)
    missing = whole - gone * math.copysign(1.0, goal)
    if missing > max((1 - NEARLY) * whole, min(UNNOTICED[unit], whole / 2)):
        context.fail(f"got {gone:.2f} of {goal:.2f} {unit} far - clear the way and try again")


async def checked(motion: Awaitable[T]) -> T:
    """What a motion comes to. Raises HriError for what it refuses: the caller's mistake."""
    try:
        return await motion
    except ValueError as error:
        raise HriError(str(error)) from error
