"""A loop on fake time with a task manager, and nothing else."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

import trio

from hri.core.signals import Event
from hri.task.task_manager import TaskManager
from hri.testing import context as lend


class Stage:
    """Runs tasks in fake time; keeps the events they raised."""

    def __init__(self, *devices: Any) -> None:
        self.context = TaskManager(lend(*devices)).context
        self.clock = self.context.clock
        self.manager = self.context.manager
        self.events: list[Event] = []
        self.context.events.subscribe("*", self.events.append)

    def run(self, job: Callable[..., Awaitable[Any]], *arguments: Any) -> Any:
        """Run a job to its end; what it returns."""
        results = []

        async def main() -> None:
            async with trio.open_nursery() as nursery:
                self.manager.live_in(nursery)
                nursery.start_soon(self.clock.drive)
                self.clock.soon(lambda: nursery.start_soon(self.context.networks.run))
                results.append(await self.manager.run(job, *arguments))
                nursery.cancel_scope.cancel()

        try:
            trio.run(main)
        except* Exception as group:
            raise group.exceptions[0] from None
        finally:
            self.context.networks.close()
        return results[0]

    def names(self) -> list[str]:
        return [event.name for event in self.events]
