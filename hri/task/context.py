"""What a task may use: the clock, events, resources, and the behaviors that run."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractAsyncContextManager, contextmanager
from dataclasses import dataclass, field, replace
from typing import Any, NoReturn, Protocol, TypeVar

from hri.behavior.behavior import Behavior
from hri.behavior.running import Networks
from hri.core.clock import Clock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.latest import Board
from hri.core.signals import Event
from hri.hal.resource_manager import ResourceManager
from hri.task.blocking_calls import Aside, Loop
from hri.task.claims import Claims
from hri.task.queue import EventQueue
from hri.task.task_run import Job, Task

B = TypeVar("B", bound=Behavior)
T = TypeVar("T")


class TaskFailed(HriError):
    """A task that says itself that it has failed."""


@dataclass(frozen=True, slots=True)
class Answer:
    """Yes or no, which gives itself when it is called."""

    is_yes: bool

    def __bool__(self) -> bool:
        return self.is_yes

    def __call__(self) -> bool:
        return self.is_yes


class Tasks(Loop, Protocol):
    """What a task may ask of the `TaskManager` that runs it."""

    claims: Claims
    running: list[Task]

    @property
    def installed(self) -> tuple[Task, ...]: ...
    def make(self, job: Job, *arguments: Any) -> Task: ...
    def install(self, job: Job, *arguments: Any) -> Task: ...
    def run(self, job: Job, *arguments: Any) -> Any: ...
    def raise_event(self, event: str | Event, /, **properties: Any) -> Event: ...
    def wait(self) -> Any: ...
    def take_away(self, name: str) -> None: ...
    def shutdown(self) -> None: ...


@dataclass
class TaskContext:
    """Lent to every task; made by the TaskManager."""

    clock: Clock
    events: EventBus
    resources: ResourceManager
    board: Board
    networks: Networks
    """The networks that run, to start, stop, swap, watch and inject into."""
    manager: Tasks
    task: Task
    """The task that this is lent to."""
    planned: Mapping[str, Behavior]
    """Behaviors by `network.id` of networks that have not been started yet."""
    chance: random.Random = field(default_factory=random.Random)
    """For what is drawn by lot; a run that is repeated draws the same again."""

    def lent_to(self, task: Task) -> TaskContext:
        """The same for another task."""
        return replace(self, task=task)

    @property
    def behaviors(self) -> dict[str, Behavior]:
        """All behaviors of the networks that run by `network.id`."""
        running = {
            f"{name}.{behavior.id}": behavior
            for name, runner in self.networks.runners.items()
            for behavior in runner.network.behaviors
        }
        return running or dict(self.planned)

    def find_behavior(self, cls: type[B]) -> B | None:
        """The running behavior of that class; None when no network has one."""
        for behavior in self.behaviors.values():
            if isinstance(behavior, cls):
                return behavior
        return None

    def behavior(self, cls: type[B]) -> B:
        """The running behavior of that class. Raises HriError when no network has one."""
        if (behavior := self.find_behavior(cls)) is not None:
            return behavior
        raise HriError(f"no {cls.__name__} runs - add one to a network of the app")

    @contextmanager
    def queue(self, *patterns: str) -> Iterator[EventQueue]:
        """Collect the events that fit any of the patterns while the body runs."""
        queue = EventQueue(self.clock)
        subscriptions = [self.events.subscribe(pattern, queue.put) for pattern in patterns]
        try:
            yield queue
        finally:
            for subscription in subscriptions:
                subscription.cancel()

    async def wait_for(self, *patterns: str, timeout: float = float("inf")) -> Event | None:
        """The next event that fits; None when none comes within `timeout` seconds."""
        with self.queue(*patterns) as queue, self.clock.move_on_after(timeout):
            return await queue.get()
        return None

    def claim(self, name: str, priority: int = 0) -> AbstractAsyncContextManager[None]:
        """Have "drive", "voice" or the like alone while the body runs; see `hri.task.claims`."""
        return self.manager.claims.claim(name, priority, self.task.name)

    async def blocking(self, function: Callable[..., T], *arguments: Any) -> T:
        """Run a function that waits or computes for long in a thread; what it returns or raises.

        Networks and other tasks go on meanwhile; fake time stands still. The function may call
        tasks as a plain script does, without a context: they run in this loop, and it waits for
        them. A task that is cancelled ends those and does not wait for the function, which goes on
        to its end.
        """
        found: T = await Aside(self.manager).run(function, *arguments)
        return found

    @property
    def termination_requested(self) -> Answer:
        """Whether the task should end; for loops that check it instead of being cancelled.

        May be called, as in 2003: `while not context.termination_requested():`.
        """
        return Answer(self.task.termination_requested)

    def fail(self, why: str) -> NoReturn:
        """End the task with the status FAILURE."""
        raise TaskFailed(why)
