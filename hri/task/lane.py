"""A lane runs one job at a time: what comes next takes the place of what runs."""

from __future__ import annotations

import logging
from collections.abc import Awaitable, Callable
from typing import Any

import trio

from hri.task.context import TaskContext

log = logging.getLogger("hri.task")


class Lane:
    """Jobs that would fight over one thing, such as the drive, go into one lane."""

    def __init__(self, context: TaskContext) -> None:
        self._context = context
        self._scope: trio.CancelScope | None = None

    @property
    def is_busy(self) -> bool:
        return self._scope is not None

    def start(self, job: Callable[..., Awaitable[Any]], *arguments: Any) -> None:
        """Start a coroutine function; the job that runs is cancelled."""
        self.stop()
        if self._context.nursery is None:
            raise RuntimeError("a lane needs a robot that lives")
        scope = self._scope = trio.CancelScope()
        self._context.nursery.start_soon(self._run, scope, job, arguments)

    def stop(self) -> None:
        """Cancel the job that runs, if any."""
        if self._scope is not None:
            self._scope.cancel()
            self._scope = None

    async def _run(
        self,
        scope: trio.CancelScope,
        job: Callable[..., Awaitable[Any]],
        arguments: tuple[Any, ...],
    ) -> None:
        try:
            with scope:
                await job(*arguments)
        except Exception as error:
            # One job that fails must not end the robot; the drive stops as its commands run dry.
            log.error("a job failed: %s", error, exc_info=error)
            name = getattr(job, "__name__", "job")
            self._context.events.raise_event("task.failed", task=name, error=str(error))
        finally:
            if self._scope is scope:
                self._scope = None
