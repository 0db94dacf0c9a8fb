"""Functions of a script that are called when something happens."""

from __future__ import annotations

import logging
from collections.abc import Callable
from functools import partial

from hri.core.signals import Event
from hri.task.context import TaskContext

log = logging.getLogger("hri.task")


async def at_event(context: TaskContext, name: str, handler: Callable[[Event], object]) -> None:
    """Call `handler(event)` beside the loop at each event that fits the name."""
    with context.queue(name) as queue:
        while True:
            event = await queue.get()
            await _call(context, name, partial(handler, event))


async def when_heard(context: TaskContext, rule: str, handler: Callable[..., object]) -> None:
    """Call `handler(**tags)` beside the loop whenever a sentence of the rule is heard."""
    with context.queue("speech.heard") as queue:
        while True:
            heard = (await queue.get()).properties
            if heard["rule"] == rule:
                await _call(context, f"<{rule}>", partial(handler, **heard["tags"]))


async def _call(context: TaskContext, what: str, function: Callable[[], object]) -> None:
    """Each call is a separate task: "stop" ends one that drives, and not those to come."""
    call = context.manager.install(_called, what, function)
    try:
        await call.wait()
    finally:
        call.cancel()


async def _called(context: TaskContext, what: str, function: Callable[[], object]) -> None:
    try:
        await context.blocking(function)
    except Exception as error:
        log.error("what was to be done at %s failed: %s", what, error, exc_info=error)
