"""Functions that wait, run in a thread beside the loop, and the plain calls of tasks they make.

A function run by `TaskContext.blocking` may call tasks as a plain script does: they run in the loop
of the robot that runs it, and the function waits for them. When its task is cancelled, so are they.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from contextvars import ContextVar
from typing import Any, Protocol

import trio

from hri.core.clock import Clock, FakeClock
from hri.core.event_bus import EventBus


class Loop(Protocol):
    """The robot loop, as all that runs in it or beside it sees its `TaskManager`."""

    clock: Clock
    events: EventBus

    def call(self, function: Callable[..., Any], *arguments: Any) -> Any: ...
    def await_or_block(self, job: Callable[..., Awaitable[Any]], *arguments: Any) -> Any: ...


class Aside:
    """A function that runs beside the loop of a task manager."""

    def __init__(self, manager: Loop) -> None:
        self.manager = manager
        self._clock = manager.clock if isinstance(manager.clock, FakeClock) else None
        self._scopes: set[trio.CancelScope] = set()
        self._is_over = False

    async def run(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """What the function returns or raises; fake time stands still, but for tasks it calls."""

        def work() -> Any:
            # The thread has a copy of the context, so that nobody else sees this.
            _aside.set(self)
            return function(*arguments)

        if self._clock is not None:
            self._clock.hold()
        try:
            return await trio.to_thread.run_sync(work, abandon_on_cancel=True)
        finally:
            self._is_over = True
            for scope in self._scopes:
                scope.cancel()
            if self._clock is not None:
                self._clock.release()

    def wait_for(self, job: Callable[..., Awaitable[Any]], *arguments: Any) -> Any:
        """Called in the thread: run a coroutine function in the loop to its end, and wait."""

        async def run() -> Any:
            with trio.CancelScope() as scope:
                self._scopes.add(scope)
                if self._is_over:
                    scope.cancel()
                try:
                    return await self._in_time(job, *arguments)
                finally:
                    self._scopes.discard(scope)
            raise RuntimeError("the task that ran this beside the loop has ended")

        return trio.from_thread.run(run)

    async def _in_time(self, job: Callable[..., Awaitable[Any]], *arguments: Any) -> Any:
        if self._clock is None or self._is_over:
            return await job(*arguments)
        self._clock.release()
        try:
            return await job(*arguments)
        finally:
            self._clock.hold()

    def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Called in the thread: call a function in the loop."""
        return trio.from_thread.run_sync(function, *arguments)


_aside: ContextVar[Aside | None] = ContextVar("aside", default=None)


def here() -> Aside | None:
    """The function beside the loop that the caller is in; None in the loop and in a script."""
    return None if trio.lowlevel.in_trio_run() else _aside.get()
