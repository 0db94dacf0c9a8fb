"""What a task may use: the clock, events, resources, and the behaviors that run."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TypeVar

import trio

from hri.behavior.behavior import Behavior, Context
from hri.core.clock import Clock
from hri.core.errors import HriError
from hri.core.events import EventBus
from hri.core.latest import Board
from hri.core.signals import Event
from hri.hal.manager import ResourceManager

B = TypeVar("B", bound=Behavior)

_LONGEST_QUEUE = 1000


class EventQueue:
    """Events that fit a pattern, kept until the task asks for them; the oldest give way."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._events: deque[Event] = deque(maxlen=_LONGEST_QUEUE)
        self._arrived = trio.Event()

    def put(self, event: Event) -> None:
        self._events.append(event)
        # Through the clock, so that on fake time those who wait wake one after the other.
        self._clock.soon(self._arrived.set)

    async def get(self) -> Event:
        """The next event; waits for it."""
        while not self._events:
            self._arrived = trio.Event()
            await self._arrived.wait()
        return self._events.popleft()


@dataclass
class TaskContext:
    """Lent by the robot to every task."""

    clock: Clock
    events: EventBus
    resources: ResourceManager
    board: Board
    behaviors: dict[str, Behavior]
    """All running behaviors by `network.id`."""
    nursery: trio.Nursery | None = None

    @classmethod
    def of(cls, context: Context, behaviors: dict[str, Behavior]) -> TaskContext:
        return cls(context.clock, context.events, context.resources, context.board, behaviors)

    def behavior(self, cls: type[B]) -> B:
        """The running behavior of that class. Raises HriError when no network has one."""
        for behavior in self.behaviors.values():
            if isinstance(behavior, cls):
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
