"""Actions of the companion with things: it learns, names, places, finds and forgets them."""

from __future__ import annotations

import math

from hri.core import FoundObject, HriError
from hri.robot import find_object
from hri.task import TaskContext, immediate
from hri.vision import NoCamera, NothingShown, forget_object, learn_object, objects_of

from .acquaintance import after_the_reply
from .companion import Companion
from .hands import POINTED_FOR, pointed_at

LOOKING_S = 5.0
"""How long a thing is shown."""
AHEAD = math.radians(15)
"""To each side; what is farther aside is on the left or on the right."""


@immediate
def learn(context: TaskContext, thing: str) -> None:
    """Look at what is held up, and say whether that was enough."""
    companion = Companion.of(context)
    companion.lessons.start(_learn, companion, thing)


async def _learn(context: TaskContext, companion: Companion, thing: str) -> None:
    await after_the_reply(context, companion)  # which asks to hold it up
    try:
        await learn_object(context, thing, LOOKING_S)
    except NoCamera:
        companion.tell("no_camera", thing=thing)
    except NothingShown:
        companion.tell("nothing_shown", thing=thing)
    except HriError:
        companion.tell("not_learned", thing=thing)
    else:
        companion.tell("learned", thing=thing)


@immediate
def forget(context: TaskContext, thing: str) -> None:
    """Forget a thing, and say so."""
    companion = Companion.of(context)
    companion.lessons.start(_forget, companion, thing)


async def _forget(context: TaskContext, companion: Companion, thing: str) -> None:
    try:
        await forget_object(context, thing)
    except HriError:
        companion.tell("unknown_thing", thing=thing)
    else:
        companion.tell("forgotten", thing=thing)


@immediate
def find(context: TaskContext, thing: str) -> str | None:
    """Look around for a thing, and go there."""
    companion = Companion.of(context)
    return companion.drive(_find, companion, thing)


async def _find(context: TaskContext, companion: Companion, thing: str) -> None:
    is_found = companion.camera.is_on and await find_object(context, thing)
    companion.tell("found" if is_found else "not_found", thing=thing)


@immediate
def see(context: TaskContext) -> str:
    """Name the thing that someone points at, or else all in sight."""
    companion = Companion.of(context)
    if (thing := _pointed_at(companion)) is not None:
        return companion.words("sees_pointed", thing=thing.name)
    names = [f"your {name}" for name in dict.fromkeys(one.name for one in _seen(companion))]
    if companion.person() is not None:
        names.append("you")
    if not names:
        return companion.words("sees_nothing")
    *others, last = names
    return companion.words("sees", things=f"{', '.join(others)} and {last}" if others else last)


@immediate
def where(context: TaskContext, thing: str) -> str:
    """Say where a thing is."""
    companion = Companion.of(context)
    for one in _seen(companion):
        if one.name == thing:
            return companion.words("sees_at", thing=thing, place=_place(one))
    return companion.words("not_in_sight", thing=thing)


def _pointed_at(companion: Companion) -> FoundObject | None:
    """What someone points at, or did a moment ago."""
    if companion.pointed is None:
        return None
    time, hand = companion.pointed
    if companion.context.clock.now() - time > POINTED_FOR:
        return None
    return pointed_at(hand, _seen(companion))


def _seen(companion: Companion) -> tuple[FoundObject, ...]:
    return objects_of(companion.context) if companion.camera.is_on else ()


def _place(one: FoundObject) -> str:
    if abs(one.bearing) < AHEAD:
        side = "in front of me"
    else:
        side = "on my left" if one.bearing > 0 else "on my right"
    if math.isnan(one.distance):
        return side
    if one.distance < 1:
        return f"{side}, about {round(10 * one.distance) * 10} centimeters away"
    return f"{side}, about {one.distance:.1f} meters away".replace(".0 meters", " meters")
