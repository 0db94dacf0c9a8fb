"""Several tasks at once: until the first is done, or until all are.

both = Parallel(context)
driving = both.add_task(DriveMoveDelta, [50, 20, 20])
both.add_task(Wait, [2000])
first = await both.wait_for_first_task()

In a script `Parallel()` needs no context, and its waiting blocks.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import trio

from hri.task.context import TaskContext
from hri.task.script import get_task_manager
from hri.task.task_run import Job, Task


class Parallel:
    """Tasks that start together; nothing runs before one of the `wait_for` calls."""

    def __init__(self, context: TaskContext | None = None) -> None:
        """`context`: of the task that waits; None in a script."""
        if context is None and trio.lowlevel.in_trio_run():
            raise RuntimeError("inside of a task - write Parallel(context)")
        self._context = context or get_task_manager().context
        self._manager = self._context.manager
        self._tasks: list[Task] = []
        self._ended: list[Task] = []
        self._changed = trio.Event()

    def add_task(self, job: Job, arguments: Sequence[Any] = ()) -> Task:
        """Add a task; what it is doing, and has done, can be asked of it later.

        Raises HriError for arguments that do not fit.
        """
        task = self._manager.make(job, *arguments)
        self._tasks.append(task)
        return task

    def wait_for_first_task(self) -> Any:
        """Start all tasks, wait until one is done, and cancel the others; returns the first one.
        Raises ValueError without tasks.
        """
        if not self._tasks:
            raise ValueError("there is nothing to wait for - add_task first")
        return self._manager.await_or_block(self._first)

    def wait_for_all_tasks(self) -> Any:
        """Start all tasks and wait until all are over; the tasks, in the order they were added.

        One that fails does not end the others: look at their `status`.
        """
        return self._manager.await_or_block(self._all)

    async def _first(self) -> Task:
        await self._run(1)
        return self._ended[0]

    async def _all(self) -> list[Task]:
        await self._run(len(self._tasks))
        return self._tasks

    async def _run(self, count: int) -> None:
        """Run until a number of tasks are done, and cancel the others."""
        async with trio.open_nursery() as nursery:
            for task in self._tasks:
                nursery.start_soon(self._follow, task)
                # On fake time one begins after the other has settled.
                await self._context.clock.sleep(0)
            while len(self._ended) < count:
                self._changed = trio.Event()
                await self._changed.wait()
            for task in self._tasks:
                task.cancel()

    async def _follow(self, task: Task) -> None:
        await task.run(self._context)
        self._ended.append(task)
        self._context.clock.soon(lambda: self._changed.set())
