"""The task manager: starts tasks, knows which run, raises events, and ends them all."""

from __future__ import annotations

import random
from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import Any

import trio

from hri.behavior.behavior import Behavior, Context
from hri.behavior.running import Networks
from hri.core.signals import Event
from hri.task.blocked_loop import HoldUpWatch
from hri.task.blocking_calls import here
from hri.task.claims import Claims, forget_claims
from hri.task.context import TaskContext
from hri.task.order import obey
from hri.task.task import TaskType
from hri.task.task_run import Job, Task
from hri.task.thread import LoopThread


class TaskManager:
    """The tasks of one robot.

    From the robot loop its calls return at once, or what to await. A script, for which the loop
    runs in a thread, may use all of them too; there they block until they are done.
    """

    def __init__(self, context: Context, planned: Mapping[str, Behavior] | None = None) -> None:
        """`planned`: behaviors of networks that will be started, by `network.id`."""
        context.has_tasks = True
        self.clock = context.clock
        self.events = context.events
        self.claims = Claims(context.clock)
        self.running: list[Task] = []
        """Tasks that have been started and are not over."""
        self._installed: list[Task] = []
        self.thread: LoopThread | None = None
        """Where the loop runs; None when the caller runs it himself."""
        self.on_shutdown: Callable[[], object] = lambda: None
        """Ends the loop, where that is the task manager's business."""
        self._nursery: trio.Nursery | None = None
        self._hold_ups = HoldUpWatch(context)
        self.networks = Networks(context)
        """The networks that run beside the tasks."""
        is_to_repeat = context.resources.is_to_repeat
        self.context = TaskContext(
            context.clock,
            context.events,
            context.resources,
            context.board,
            self.networks,
            self,
            Task(self, _main, ()),
            planned or {},
            random.Random(context.seed_for("tasks") if is_to_repeat else None),
        )
        """What tasks are lent; each gets a copy with itself in it."""

    @property
    def installed(self) -> tuple[Task, ...]:
        """The installed tasks that are not over."""
        return tuple(self._installed)

    def live_in(self, nursery: trio.Nursery) -> None:
        """Let installed tasks run in a nursery; it must end with the robot loop.

        On real time, a task that holds the loop up is named from then on.
        """
        self._nursery = nursery
        if not self.clock.is_fake:
            nursery.start_soon(self._hold_ups.watch)

    def make(self, job: Job, *arguments: Any) -> Task:
        """A task that has not been started. Raises HriError for arguments that do not fit."""
        if isinstance(job, TaskType):
            arguments = job.bound(*arguments)
        return Task(self, job, arguments)

    def install(self, job: Job, *arguments: Any) -> Task:
        """Start a task and go on; it runs beside all others until it is over.

        Raises HriError for arguments that do not fit, RuntimeError while no robot lives.
        """
        task = self.make(job, *arguments)
        self.call(self._start, task)
        return task

    def run(self, job: Job, *arguments: Any) -> Any:
        """Run a task to its end; its result, None when it was cancelled.

        Raises what it fails with.
        """
        return self.await_or_block(self._run, self.make(job, *arguments))

    def raise_event(self, event: str | Event, /, **properties: Any) -> Event:
        """Raise an event by name, or one that was made before; it gets the time of now."""
        name = event if isinstance(event, str) else event.name
        if isinstance(event, Event):
            properties = {**event.properties, **properties}
        raised: Event = self.call(partial(self.events.raise_event, name, **properties))
        return raised

    def wait(self) -> Any:
        """Wait until no installed task runs any more."""
        return self.await_or_block(self._wait)

    def take_away(self, name: str) -> None:
        """Cancel the installed tasks that have claimed this; the others may not claim it any more.

        After "stop" a task must not begin to drive that was about to.
        """
        for task in tuple(self._installed):
            task.leave.refused.add(name)
            if name in task.leave.claimed:
                task.cancel()

    def shutdown(self) -> None:
        """Cancel all tasks; a second call does nothing."""
        for task in tuple(self.running):
            task.cancel()
        self.on_shutdown()

    def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Call a function in the robot loop, wherever this is called."""
        if (aside := here()) is not None and aside.manager is self:
            return aside.call(function, *arguments)
        if self.thread is None:
            return function(*arguments)
        return self.thread.call(function, *arguments)

    def await_or_block(self, job: Callable[..., Awaitable[Any]], *arguments: Any) -> Any:
        """In the robot loop, what to await; in a script, run it to its end and give its result."""
        if (aside := here()) is not None and aside.manager is self:
            return aside.wait_for(job, *arguments)
        if self.thread is None:
            return job(*arguments)
        return self.thread.run(job, *arguments)

    def _start(self, task: Task) -> None:
        if self._nursery is None:
            raise RuntimeError("tasks need a robot that lives - start its loop first")
        self.running.append(task)
        self._installed.append(task)
        # Through the clock, so that on fake time they begin one after the other.
        self.clock.soon(partial(self._nursery.start_soon, self._run_installed, task))

    async def _run(self, task: Task) -> Any:
        self.running.append(task)
        try:
            return await task.run_through(self.context)
        finally:
            self.running.remove(task)

    async def _run_installed(self, task: Task) -> None:
        forget_claims(task.leave)
        obey(task.said)
        try:
            await task.run(self.context)
        finally:
            self.running.remove(task)
            self._installed.remove(task)

    async def _wait(self) -> None:
        while self._installed:
            await self._installed[0].wait()


async def _main(context: TaskContext) -> None:
    """What the base context calls its own task; never run."""
