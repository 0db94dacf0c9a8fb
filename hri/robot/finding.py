"""Tasks that find an object and go to it, or follow it: seeing and driving at once."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager

from hri.core.signals import FoundObject, Pose2D
from hri.drive.following import LOST_S, Ending, Following, FollowingManner
from hri.drive.navigation_tasks import come_to, follow_target, look_around
from hri.drive.target import Target
from hri.drive.tasks import turn
from hri.drive.tasks_2003 import checked
from hri.hal.camera import Camera
from hri.task.context import TaskContext
from hri.task.task import task
from hri.task.units import UNIT_DISTANCE, UNIT_TIME, in_si
from hri.vision.objects.object_behaviors import ObjRecRecognizer
from hri.vision.objects.object_tasks import recognizer_of

BEFORE = 0.6
"""Meters before an object at which it stops, when nobody says how many."""


class Thing(Target):
    """An object by its name."""

    clearance = 0.15
    remedy = "put it where the camera sees it"

    def __init__(self, recognizer: ObjRecRecognizer, name: str) -> None:
        self._recognizer, self._name = recognizer, name
        self._looked = -math.inf

    def is_seen(self, now: float) -> bool:
        return self.sight(now) is not None

    def look(self, following: Following, now: float, pose: Pose2D) -> float | None:
        time = self._recognizer.last.time
        if time <= self._looked:
            return None
        self._looked = time
        seen = self.sight(now)
        if seen is None:
            return None
        following.person = self._name
        following.see(now, pose, seen.bearing, seen.distance)
        return seen.distance

    def sight(self, now: float) -> FoundObject | None:
        """The surest of this name in the last picture; None when that was a while ago."""
        last = self._recognizer.last
        if now - last.time > LOST_S:
            return None
        return next((one for one in last.found if one.name == self._name), None)


async def find_object(context: TaskContext, name: str, distance: float = BEFORE) -> bool:
    """Look around for an object and come to it, `distance` meters before it; whether it was found.

    Of an object whose size is unknown nobody knows how far away it is: it only turns to it. Raises
    HriError when no network has an ObjRecRecognizer.
    """
    recognizer = recognizer_of(context)
    thing = Thing(recognizer, name)
    with _looking_ahead(context, recognizer):
        if not await look_around(context, thing):
            return False
        seen = thing.sight(context.clock.now())
        if seen is not None and math.isnan(seen.distance):
            await turn(context, seen.bearing)
            return True
        return await come_to(context, thing, distance)


@contextmanager
def _looking_ahead(context: TaskContext, recognizer: ObjRecRecognizer) -> Iterator[None]:
    """Meanwhile a camera on a neck looks where the base goes, not at people."""
    camera = context.resources.obtain(recognizer.camera_id, Camera)
    camera.look_ahead(True)
    try:
        yield
    finally:
        camera.look_ahead(recognizer.looks_ahead)
        context.resources.release(camera)


@task("Hri.FindObject")
async def find_object_task(context: TaskContext, name: str, distance: float = 0.0) -> None:
    """Look around for an object and come to it, in default units; 0 is a usual distance.

    Fails when it is not found, or cannot be reached.
    """
    before = in_si(UNIT_DISTANCE, distance) or BEFORE
    if not await checked(find_object(context, name, before)):
        context.fail(f"did not find {name} - {Thing.remedy}, or clear the way to it")


@task("Hri.FollowObject")
async def follow_object(
    context: TaskContext, name: str, distance: float = 0.0, seconds: float = 0.0
) -> Ending:
    """Follow an object, in default units; 0 is a usual distance, and no end.

    Gives how it ended, as Hri.FollowPerson does; `person` is the name of the object.
    """
    apart = in_si(UNIT_DISTANCE, distance) or FollowingManner().distance
    end = in_si(UNIT_TIME, seconds) or math.inf
    recognizer = recognizer_of(context)
    with _looking_ahead(context, recognizer):
        thing = Thing(recognizer, name)
        return await checked(follow_target(context, thing, apart, end))
