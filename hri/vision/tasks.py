"""Tasks with people in sight: wait for a person, look at a person."""

from __future__ import annotations

from hri.core.errors import HriError
from hri.core.signals import People, Person
from hri.task.context import TaskContext
from hri.task.task import task
from hri.vision.behaviors import Attention, PersonTracker

LOOK_EVERY = 0.05
"""Seconds between looks at who is there."""


@task("Hri.WaitForPerson")
async def wait_for_person(
    context: TaskContext, looking: bool = False, within: float = 0.0, timeout: float = float("inf")
) -> str | None:
    """Wait until someone is there; their id, or None when nobody comes in `timeout` seconds.

    With `looking`, until someone looks at the robot; with `within`, until someone is nearer than
    that, meters. Of several it is the one who is attended to. Raises HriError when no network has a
    PersonTracker.
    """
    end = context.clock.now() + timeout
    while True:
        people = people_of(context)
        fitting = [p.id for p in people.persons if _fits(p, looking, within)]
        if fitting:
            return people.attended if people.attended in fitting else fitting[0]
        if context.clock.now() >= end:
            return None
        await context.clock.sleep(LOOK_EVERY)


@task("Hri.LookAt")
async def look_at(context: TaskContext, person: str = "", seconds: float = 0.0) -> bool:
    """Let the eyes stay on a person, on who is attended to now without an id.

    Ends after `seconds`, with 0 when the person is gone; whether they were there to the end.
    Raises HriError when no network has an Attention and a PersonTracker.
    """
    attention = context.behavior(Attention)
    person = person or people_of(context).attended
    end = context.clock.now() + (seconds or float("inf"))
    async with context.claim("gaze"):
        attention.look_at(person)
        try:
            while is_here := people_of(context).person(person) is not None:
                if context.clock.now() >= end:
                    break
                await context.clock.sleep(LOOK_EVERY)
            return is_here
        finally:
            attention.look_at("")


def people_of(context: TaskContext) -> People:
    """Everyone who was seen last. Raises HriError when no network has a PersonTracker."""
    tracker = context.find_behavior(PersonTracker)
    if tracker is None:
        raise HriError("nobody looks out for people - add an Hri.PersonTracker to a network")
    return tracker.last


def _fits(person: Person, looking: bool, within: float) -> bool:
    """Whether someone is in sight, and looks or is near enough where that is asked for."""
    is_near = not within or person.distance < within
    return person.is_visible and is_near and (person.is_looking or not looking)
