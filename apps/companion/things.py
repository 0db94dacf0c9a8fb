"""What the companion does with things: it learns, names, places, finds and forgets them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Protocol

from hri.core import FoundObject, HriError, Person
from hri.hal import Camera
from hri.robot import find_object
from hri.task import TaskContext
from hri.vision import NoCamera, NothingShown, forget_object, learn_object, objects_of

LOOKING_S = 5.0
"""How long a thing is shown."""
AHEAD = math.radians(15)
"""To each side; what is farther aside is on the left or on the right."""
WORDS: Mapping[str, str] = {
    "learned": "Got it. Now I know your {thing}.",
    "nothing_shown": "I don't see your {thing}. Hold it up close, and say: this is my {thing}.",
    "no_camera": "I don't have a camera to see your {thing} with.",
    "not_learned": "I couldn't see enough of your {thing}. Hold it closer, in better light.",
    "sees": "I see {things}.",
    "sees_nothing": "I don't see anything I know.",
    "sees_at": "I see your {thing} {place}.",
    "not_in_sight": "I don't see your {thing} right now. Say: find my {thing}.",
    "found": "Here's your {thing}.",
    "not_found": "I looked around, but I couldn't find your {thing}.",
    "forgotten": "Okay, I forgot your {thing}.",
    "unknown_thing": "I don't know your {thing} yet. Hold it up and say: this is my {thing}.",
}
"""What it says of them; `replies.toml` may say otherwise in [unasked]."""


class Teller(Protocol):
    """Who sees things, and speaks of them."""

    context: TaskContext
    camera: Camera

    def person(self) -> Person | None:
        """The one it attends to, when they are in sight."""

    def words(self, key: str, **facts: str) -> str:
        """What it says, by a key of WORDS."""

    def tell(self, key: str, **facts: str) -> None:
        """Say it."""


async def learn(context: TaskContext, teller: Teller, thing: str) -> None:
    """Look at what is held up, and say whether that was enough."""
    try:
        await learn_object(context, thing, LOOKING_S)
    except NoCamera:
        teller.tell("no_camera", thing=thing)
    except NothingShown:
        teller.tell("nothing_shown", thing=thing)
    except HriError:
        teller.tell("not_learned", thing=thing)
    else:
        teller.tell("learned", thing=thing)


async def forget(context: TaskContext, teller: Teller, thing: str) -> None:
    """Forget it, and say so."""
    try:
        await forget_object(context, thing)
    except HriError:
        teller.tell("unknown_thing", thing=thing)
    else:
        teller.tell("forgotten", thing=thing)


async def find(context: TaskContext, teller: Teller, thing: str) -> None:
    """Look around for it, and go there."""
    is_found = teller.camera.is_on and await find_object(context, thing)
    teller.tell("found" if is_found else "not_found", thing=thing)


def seen_words(teller: Teller) -> str:
    """What is in sight."""
    names = [f"your {name}" for name in dict.fromkeys(one.name for one in _seen(teller))]
    if teller.person() is not None:
        names.append("you")
    if not names:
        return teller.words("sees_nothing")
    *others, last = names
    return teller.words("sees", things=f"{', '.join(others)} and {last}" if others else last)


def where_words(teller: Teller, thing: str) -> str:
    """Where a thing is."""
    for one in _seen(teller):
        if one.name == thing:
            return teller.words("sees_at", thing=thing, place=_place(one))
    return teller.words("not_in_sight", thing=thing)


def _seen(teller: Teller) -> tuple[FoundObject, ...]:
    return objects_of(teller.context) if teller.camera.is_on else ()


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
