"""Events kept for a task until it asks for them."""

from __future__ import annotations

from collections import deque

import trio

from hri.core.clock import Clock
from hri.core.event_bus import matches
from hri.core.signals import Event
from hri.task.order import NEVER, obey, said_in

LONGEST = 1000
"""How many events a queue keeps; beyond it the oldest give way."""


class EventQueue:
    """Events in the order they were raised; the oldest give way when nobody asks."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._events: deque[Event] = deque(maxlen=LONGEST)
        self._waiting = trio.lowlevel.ParkingLot()

    def __len__(self) -> int:
        return len(self._events)

    def put(self, event: Event) -> None:
        self._events.append(event)
        # Through the clock, so that on fake time those who wait wake one after the other.
        for _ in range(len(self._waiting)):
            self._clock.soon(self._waiting.unpark)

    def keep(self, *patterns: str) -> None:
        """Forget the events that fit none of the patterns."""
        kept = [event for event in self._events if _fits(event, patterns)]
        self._events = deque(kept, LONGEST)

    async def get(self, pattern: str = "*") -> Event:
        """The next event, of those that fit; waits for it. Several may wait at once.

        What the task does with `speech.heard` is an order, see `hri.task.order`.
        """
        obey(NEVER)
        while True:
            for event in self._events:
                if matches(pattern, event.name):
                    self._events.remove(event)
                    obey(said_in(event))
                    return event
            await self._waiting.park()


def _fits(event: Event, patterns: tuple[str, ...]) -> bool:
    return any(matches(pattern, event.name) for pattern in patterns)
