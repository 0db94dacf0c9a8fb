"""What has arrived for the ports of one behavior and waits for its tick.

A value with a count is sent in as many ticks, one value a tick. A value without is sent at every
tick until another one comes. When several values arrive in a tick, strings are queued, since each
is a separate message; of numbers and truths, which are measurements, only the newest two are kept:
two, so that two networks of the same rate never find a tick empty because one is a bit late, and
only two, so that a command is never older than a tick.

With each value goes the time at which its sender spoke last, of whatever; a sender who has hung up
never spoke. Values for a drive expire when their sender falls silent, all others stay as sent.
"""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

from hri.net import values
from hri.net.malleable_protocol import Item, Sender

KEPT = {"string": 1000}
"""How many values wait, by datatype; the oldest give way."""
KEPT_MEASUREMENTS = 2
KEPT_CHARACTERS = 1_000_000
"""Of all strings that wait at one port; the oldest give way, the newest never."""

Admits = Callable[[str, Sender], bool]
"""Whether a value for a port, from that sender, may come in."""


class _Waiting:
    """A value and the number of ticks it is still due for; None: until another one comes."""

    __slots__ = ("sender", "ticks", "value")

    def __init__(self, value: Any, ticks: int | None, sender: Sender) -> None:
        self.value = value
        self.ticks = ticks
        self.sender = sender


class _Queue:
    """The values that wait at one port, the oldest first."""

    def __init__(self, most: int) -> None:
        self._values: deque[_Waiting] = deque()
        self._most = most
        self._characters = 0

    def __bool__(self) -> bool:
        return bool(self._values)

    @property
    def first(self) -> _Waiting:
        return self._values[0]

    def append(self, value: _Waiting) -> None:
        """In the place of one that waited only for another to come."""
        if self._values and self._values[-1].ticks is None:
            self._forget(self._values.pop())
        self._values.append(value)
        self._characters += _length(value)
        while len(self._values) > self._most or self._is_full():
            self.drop()

    def drop(self) -> None:
        self._forget(self._values.popleft())

    def _forget(self, value: _Waiting) -> None:
        self._characters -= _length(value)

    def _is_full(self) -> bool:
        return self._characters > KEPT_CHARACTERS and len(self._values) > 1


def _length(waiting: _Waiting) -> int:
    return len(waiting.value) if isinstance(waiting.value, str) else 0


class Inbox:
    """Filled by the thread of a port, emptied by the robot loop."""

    def __init__(self, datatypes: Mapping[str, str]) -> None:
        """`datatypes` of the ports, by name."""
        self._datatypes = dict(datatypes)
        self._lock = threading.Lock()
        self._waiting = {
            port: _Queue(KEPT.get(datatype, KEPT_MEASUREMENTS))
            for port, datatype in datatypes.items()
        }

    def put(self, *items: Item, sender: Sender) -> None:
        """Store values for their ports; those for unknown ports are ignored. Raises ProtocolError,
        storing none of them, when one does not have its port's datatype.
        """
        ours = [item for item in items if item.port in self._datatypes]
        read = [values.read(self._datatypes[item.port], item.text) for item in ours]
        with self._lock:
            for item, value in zip(ours, read, strict=True):
                self._waiting[item.port].append(_Waiting(value, item.count, sender))

    def take(self, admits: Admits = lambda port, sender: True) -> dict[str, tuple[Any, float]]:
        """The values of this tick by port, each with when its sender spoke last, in seconds.

        What `admits` does not let in is forgotten.
        """
        taken = {}
        with self._lock:
            for port, waiting in self._waiting.items():
                while waiting and not admits(port, waiting.first.sender):
                    waiting.drop()
                if waiting:
                    taken[port] = _next(waiting)
        return taken


def _next(waiting: _Queue) -> tuple[Any, float]:
    first = waiting.first
    if first.ticks is not None:
        first.ticks -= 1
        if not first.ticks:
            waiting.drop()
    return first.value, -math.inf if first.sender.is_gone else first.sender.spoken
