"""Who holds the robot loop up: while one task computes or blocks, every network waits."""

from __future__ import annotations

import logging
import math
from contextvars import ContextVar
from time import perf_counter

import trio

from hri.behavior.behavior import Context

log = logging.getLogger("hri.task")

CURRENT: ContextVar[str] = ContextVar("name of the task that runs", default="")
NOTED = 0.005
"""Seconds; a step of a task that takes longer can be why a network missed its interval."""
TOO_LONG = 0.2
"""Seconds; a step of a task that takes longer is reported even when no network missed anything."""
BETWEEN_REPORTS = 5.0
"""Seconds between two reports."""


class HoldUpWatch(trio.abc.Instrument):
    """Measures each step of each task, from where it wakes to where it waits again."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._began = perf_counter()
        self._report_after = -math.inf

    async def watch(self) -> None:
        """Watch the loop that this runs in, until cancelled."""
        trio.lowlevel.add_instrument(self)
        try:
            await trio.sleep_forever()
        finally:
            trio.lowlevel.remove_instrument(self)

    def before_task_step(self, task: trio.lowlevel.Task) -> None:
        self._began = perf_counter()

    def after_task_step(self, task: trio.lowlevel.Task) -> None:
        took = perf_counter() - self._began
        if took < NOTED or not (name := task.context.get(CURRENT, "")):
            return
        now = self._context.clock.now()
        self._context.held_up_by, self._context.held_up_at = name, now
        if took >= TOO_LONG and now >= self._report_after:
            self._report_after = now + BETWEEN_REPORTS
            remedy = "use `await context.blocking(function)` for what takes time"
            log.warning("%s held all networks up for %.1f s - %s", name, took, remedy)
