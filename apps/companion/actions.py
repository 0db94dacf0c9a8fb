"""What the companion does when a reply names it as its `action`; an app's own tasks come first.

Each is over in one step, and what it returns is said instead of the reply.
"""

from __future__ import annotations

import math

from hri.core import Event
from hri.drive import navigation_tasks
from hri.robot import verbs
from hri.task import TaskContext, immediate

from .companion import QUIET_SECONDS, Companion

ARRIVED = 0.9
"""Share of a way after which it does not say that something was in the way."""


@immediate
def move(context: TaskContext, distance: float = 0.5) -> str | None:
    """Drive straight ahead, or back, in meters."""
    companion = Companion.of(context)
    return companion.drive(_go, companion, distance)


async def _go(context: TaskContext, companion: Companion, distance: float) -> None:
    travelled = await verbs.move(context, distance)
    if abs(travelled) < ARRIVED * abs(distance):
        companion.emotion.feel("stuck")
        companion.tell("blocked")


@immediate
def turn(context: TaskContext, angle: float = 90.0) -> str | None:
    """Turn to the left, or to the right, in degrees."""
    return Companion.of(context).drive(verbs.turn, math.radians(angle))


@immediate
def come(context: TaskContext) -> str | None:
    """Drive to the person."""
    companion = Companion.of(context)
    return companion.drive(_come_here, companion)


async def _come_here(context: TaskContext, companion: Companion) -> None:
    if not companion.camera.is_on or not await navigation_tasks.come_here(context):
        companion.tell("nobody")


@immediate
def follow(context: TaskContext) -> str | None:
    """Drive behind the person."""
    companion = Companion.of(context)
    return companion.drive(_go_along, companion)


async def _go_along(context: TaskContext, companion: Companion) -> None:
    said: list[float] = []

    def lose(event: Event) -> None:
        """Say it as soon as they are out of sight, and not each time."""
        if not said:
            said.append(event.time)
            companion.tell("lost")

    lost = context.events.subscribe("target.lost", lose)
    try:
        if companion.person() is None or not await navigation_tasks.follow(context):
            companion.tell("nobody")
    finally:
        lost.cancel()


@immediate
def stop(context: TaskContext) -> None:
    """Stand still, and fall silent."""
    Companion.of(context).halt()


@immediate
def release(context: TaskContext) -> None:
    """Let a base move again that waits for a person."""
    Companion.of(context).guard.release()


@immediate
def quiet(context: TaskContext) -> None:
    """Fall silent for a while."""
    companion = Companion.of(context)
    companion.hush()
    companion.be_quiet(QUIET_SECONDS)


@immediate
def no_sounds(context: TaskContext) -> None:
    """Say only words: no giggles, sighs and the like."""
    Companion.of(context).voice.makes_sounds = False


@immediate
def sounds_again(context: TaskContext) -> None:
    """Make sounds that are not words, as before."""
    Companion.of(context).voice.makes_sounds = True


@immediate
def no_fidgeting(context: TaskContext) -> None:
    """Keep the base still while nothing happens."""
    Companion.of(context).fidgets = False


@immediate
def fidget_again(context: TaskContext) -> None:
    """Move the base a little while nothing happens, as before."""
    Companion.of(context).fidgets = True


@immediate
def sleep(context: TaskContext) -> None:
    """Fall asleep: it hears "wake up" and little else."""
    Companion.of(context).fall_asleep()


@immediate
def wake(context: TaskContext) -> str | None:
    """Wake up; if it was awake, say that."""
    companion = Companion.of(context)
    if not companion.is_asleep:
        return companion.words("awake")
    companion.wake()
    return None


@immediate
def eyes(context: TaskContext, eyes: str = "shut") -> None:
    """Turn the camera on if they are "open", else off."""
    Companion.of(context).switch_camera(eyes == "open")
