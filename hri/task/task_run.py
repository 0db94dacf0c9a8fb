"""One run of a task: how it is doing, what came of it, and the events it waits for."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Awaitable, Callable
from enum import Enum
from functools import partial
from typing import Any, Protocol

import trio

from hri.core.errors import HriError, first_of
from hri.core.event_bus import EventBus, Subscription, matches
from hri.core.signals import Event
from hri.hal.pending import Interrupted
from hri.task.blocked_loop import CURRENT
from hri.task.blocking_calls import Loop
from hri.task.claims import Leave
from hri.task.failure import with_place
from hri.task.order import said
from hri.task.queue import EventQueue

log = logging.getLogger("hri.task")

Job = Callable[..., Awaitable[Any]]
"""A coroutine function that takes a TaskContext and its arguments; every TaskType is one."""


class TaskStatus(Enum):
    """How a task is doing."""

    READY = "ready"
    """Not started yet."""
    RUNNING = "running"
    SUCCESS = "success"
    FAILURE = "failure"
    CANCELLED = "cancelled"


class Lender(Protocol):
    """A TaskContext, of which each task is lent a copy with itself in it."""

    def lent_to(self, task: Task) -> object: ...


class Task:
    """One run of a job; made by a TaskManager or a Parallel."""

    def __init__(self, manager: Loop, job: Job, arguments: tuple[Any, ...]) -> None:
        self.name = name_of(job)
        self.status = TaskStatus.READY
        self.result: Any = None
        """What the job returned; None before, and without success."""
        self.error: Exception | None = None
        """Why it has failed; Interrupted when another task took what it had claimed."""
        self.termination_requested = False
        self.leave = Leave()
        self.said = said()
        """When the order was said that whoever made it carries out, in seconds."""
        self._manager = manager
        self._job = job
        self._arguments = arguments
        self._scope = trio.CancelScope()
        self._ended = trio.Event()
        self._queue = EventQueue(manager.clock)
        self._enabled: Counter[str] = Counter()
        self._subscription: Subscription | None = None

    def __repr__(self) -> str:
        return f"<Task {self.name} {self.status.value}>"

    @property
    def is_over(self) -> bool:
        return self.status not in (TaskStatus.READY, TaskStatus.RUNNING)

    def cancel(self) -> None:
        """End it at the next point where it waits; from any thread, and more than once."""
        self.termination_requested = True
        if not self.is_over:
            self._manager.call(self._cancel)

    def wait(self) -> Any:
        """Wait until it is over; its status. Raises nothing when it failed: see `error`.

        In a task it is awaited, in a script it blocks.
        """
        return self._manager.await_or_block(self._wait)

    async def run(self, context: Lender) -> None:
        """Run the job to its end; called once, by whoever made it.

        A failure is kept in `error`, told to the log with its file and line, and raised as the
        event `task.failed`.
        """
        try:
            await self.run_through(context)
        except Interrupted as error:
            log.info("%s was interrupted: %s", self.name, error)
        except Exception as error:
            tell_failure(self._manager.events, self._job, error, _surprise(error))

    async def run_through(self, context: Lender) -> Any:
        """Run the job to its end and give its result; its failure is raised here, too."""
        if self.is_over:
            return None
        self.status, outcome = TaskStatus.RUNNING, TaskStatus.CANCELLED
        outer = CURRENT.set(self.name)
        try:
            with self._scope:
                self.result = await self._job(context.lent_to(self), *self._arguments)
                outcome = TaskStatus.SUCCESS
        except Exception as raised:
            self.error = error = _unwrapped(raised)
            if not isinstance(error, Interrupted):
                outcome = TaskStatus.FAILURE
            elif self._scope.cancel_called:
                return None
            if error is not raised:
                raise error from raised
            raise
        finally:
            CURRENT.reset(outer)
            self._end(outcome)
        return self.result

    async def _wait(self) -> TaskStatus:
        await self._ended.wait()
        return self.status

    def _cancel(self) -> None:
        if self.status is TaskStatus.READY:
            self._end(TaskStatus.CANCELLED)
        self._scope.cancel()

    def _end(self, outcome: TaskStatus) -> None:
        self.status = outcome
        self._enabled.clear()
        self._listen()
        # Through the clock, so that on fake time those who wait wake one after the other.
        self._manager.clock.soon(self._ended.set)

    # --- events ---

    def enable_event(self, pattern: str) -> None:
        """Keep the events that fit from now on, until as many `disable_event` were called."""
        self._enabled[pattern] += 1
        self._listen()

    def disable_event(self, pattern: str) -> None:
        """Take one `enable_event` back; what then nobody wants is forgotten. Raises HriError."""
        if not self._enabled[pattern]:
            raise HriError(f'{self.name}: "{pattern}" is not enabled - call enable_event first')
        self._enabled[pattern] -= 1
        self._enabled += Counter()  # leaves out what counts zero
        self._listen()
        self._queue.keep(*self._enabled)

    async def wait_for_event(self, pattern: str, timeout: float = float("inf")) -> Event | None:
        """The next event that fits, kept or still to come; None after `timeout` seconds.

        What is raised while nobody waits and no `enable_event` asked for is lost.
        """
        self.enable_event(pattern)
        try:
            with self._manager.clock.move_on_after(timeout):
                return await self._queue.get(pattern)
        finally:
            self.disable_event(pattern)
        return None

    def _listen(self) -> None:
        """Listen on the bus as long as anything is enabled."""
        if self._enabled and self._subscription is None:
            self._subscription = self._manager.events.subscribe("*", self._hear)
        elif not self._enabled and self._subscription is not None:
            self._subscription.cancel()
            self._subscription = None

    def _hear(self, event: Event) -> None:
        if any(matches(pattern, event.name) for pattern in self._enabled):
            self._queue.put(event)


def name_of(job: Job) -> str:
    """What a job is called in logs and events."""
    if isinstance(id := getattr(job, "id", None), str):
        return id  # of a TaskType
    if isinstance(job, partial):
        return name_of(job.func)
    return getattr(job, "__name__", "task")


def tell_failure(
    events: EventBus, job: Job, error: Exception, traceback: Exception | None = None
) -> None:
    """Tell the log of a failed task, with file and line, and raise `task.failed`."""
    log.error("%s failed: %s", name_of(job), with_place(error, job), exc_info=traceback)
    events.raise_event("task.failed", task=name_of(job), error=str(error))


def _unwrapped(error: Exception) -> Exception:
    """What ended a job; of a nursery in which all were interrupted, the first that was."""
    if isinstance(error, ExceptionGroup):
        interrupted, others = error.split(Interrupted)
        if interrupted is not None and others is None:
            return first_of(interrupted)
    return error


def _surprise(error: Exception) -> Exception | None:
    """The error when the log should show where it came from: our own say all in a line."""
    return None if isinstance(error, HriError) else error
