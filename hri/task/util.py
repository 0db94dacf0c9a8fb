"""Small tasks that every program needs: Wait, RaiseEvent, WaitForEvent."""

from __future__ import annotations

import math

from hri.core.errors import HriError
from hri.core.quantities import millisecond
from hri.core.signals import Event
from hri.task.context import TaskContext
from hri.task.events import parse_query
from hri.task.library import tasks_by_name
from hri.task.task import task

__all__ = ["RaiseEvent", "Wait", "WaitForEvent"]

__getattr__, __dir__ = tasks_by_name(__name__, *__all__)


@task("Hri.Wait")
async def Wait(context: TaskContext, milliseconds: float) -> None:
    """Let some milliseconds pass, whatever the default unit of time is; fails for infinity."""
    if math.isinf(milliseconds):
        raise HriError(f"Hri.Wait: {milliseconds} is not a time - wait for an event instead")
    await context.clock.sleep(_seconds(milliseconds))


@task("Hri.RaiseEvent")
async def RaiseEvent(context: TaskContext, text: str) -> None:
    """Raise an event, written like `Door.Opened?count=2`; see `hri.task.events`."""
    context.manager.raise_event(parse_query(text))


@task("Hri.WaitForEvent")
async def WaitForEvent(
    context: TaskContext, pattern: str, milliseconds: float = math.inf
) -> Event | None:
    """The next event that fits, such as "Door.*"; None when none comes in time."""
    return await context.wait_for(pattern, timeout=_seconds(milliseconds))


def _seconds(milliseconds: float) -> float:
    if math.isnan(milliseconds):
        raise HriError("nan is not a time - give milliseconds")
    return milliseconds * millisecond
