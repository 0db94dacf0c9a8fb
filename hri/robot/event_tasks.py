"""What starts tasks when something happens: `[on]` of `app.toml`."""

from __future__ import annotations

from collections.abc import Sequence

from hri.core.signals import Event
from hri.task.context import TaskContext
from hri.task.task import TaskType
from hri.task.task_run import Task


async def start_on(pattern: str, jobs: Sequence[TaskType], context: TaskContext) -> None:
    """Start these tasks at each event that fits; one that still runs is not started again.

    A task gets those properties of the event that it has parameters for, and the event itself as
    `event`.
    """
    running: dict[TaskType, Task] = {}
    with context.queue(pattern) as queue:
        while True:
            event = await queue.get()
            for job in jobs:
                if job not in running or running[job].is_over:
                    started = job.with_those_it_takes(_values_of(event))
                    running[job] = context.manager.install(started)


def _values_of(event: Event) -> dict[str, object]:
    return {**event.properties, "event": event}
