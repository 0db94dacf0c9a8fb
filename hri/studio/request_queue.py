"""Requests that wait for the robot's loop. Stop is not one among others: it waits in no queue,
comes first, and nothing can push it out.
"""

from __future__ import annotations

import threading
from collections import Counter, deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

STOP, RELEASE = "stop", "release"
"""The commands that stop the robot, and that let it move again."""
MOST_REQUESTS = 100
"""Requests that wait for the robot."""
MOST_OF_A_KIND = 20
"""Requests of one command that wait: no command takes the place of all others."""
MOST_STOPS = 1000
"""Stops that wait for an answer. All others are carried out too, without one."""


@dataclass(frozen=True, slots=True)
class Request:
    """What someone asks of the robot through the server."""

    number: int
    """By which the server knows the answer."""
    command: str
    arguments: dict[str, Any]


Refused = tuple[int, str]
"""The number of a request, and why it is not carried out."""


class RequestQueue:
    """Filled by the thread that reads the link, emptied by the robot's loop."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: deque[Request] = deque()
        self._kinds: Counter[str] = Counter()
        self._stops: list[int] | None = None
        """The numbers of the stops that wait for an answer; None while no stop waits."""
        self._on_stop: Callable[[], object] = lambda: None

    def put(self, request: Request) -> list[Refused]:
        """Let a request wait; those that are refused for it, which may be itself."""
        with self._lock:
            if request.command == STOP:
                return self._put_stop(request.number)
            if self._kinds[request.command] >= MOST_OF_A_KIND:
                return [(request.number, _full(self._kinds[request.command], request.command))]
            if len(self._waiting) >= MOST_REQUESTS:
                return [(request.number, _full(len(self._waiting), "other"))]
            self._kinds[request.command] += 1
            self._waiting.append(request)
            return []

    def _put_stop(self, number: int) -> list[Refused]:
        """A release that was asked for before a stop must not come after it."""
        self._stops = [] if self._stops is None else self._stops
        if len(self._stops) < MOST_STOPS:
            self._stops.append(number)
        undone = [one.number for one in self._waiting if one.command == RELEASE]
        self._waiting = deque(one for one in self._waiting if one.command != RELEASE)
        del self._kinds[RELEASE]
        self._on_stop()
        why = "a stop came after it - release the robot again"
        return [(one, why) for one in undone]

    def take(self) -> Request | None:
        """The request that has waited longest; None when none waits."""
        with self._lock:
            if not self._waiting:
                return None
            request = self._waiting.popleft()
            self._kinds[request.command] -= 1
            return request

    def take_stop(self) -> list[int] | None:
        """The numbers by which stop was asked for since the last call; None when it was not."""
        with self._lock:
            stops, self._stops = self._stops, None
            return stops

    def call_on_stop(self, callback: Callable[[], object]) -> None:
        """Call back whenever a stop comes, from any thread, and at once when one waits."""
        with self._lock:
            self._on_stop = callback
            if self._stops is not None:
                callback()


def _full(count: int, kind: str) -> str:
    return f"{count} {kind} requests wait for the robot already - ask again when it goes on"
