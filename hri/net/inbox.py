"""What has arrived for the ports of one behavior and waits for its tick.

A value with a count is sent in as many ticks, one value a tick. A value without is sent at every
tick until another one comes. When more arrives than ticks pass, strings wait, since each is a
message of its own; of numbers and truths, which are measurements, only the newest two are kept:
two, so that two networks of the same rate never find a tick empty because one is a bit late, and
only two, so that a command is never older than a tick.

With each value goes the time at which its sender spoke last, of whatever; a sender who has hung up
never spoke. What feeds a drive ends with that, what feeds anything else stays as it was said.
"""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

from hri.net import values
from hri.net.protocol import Item, Sender

KEPT = {"string": 1000}
"""How many values wait, by datatype; the oldest give way."""
KEPT_MEASUREMENTS = 2

Admits = Callable[[str, Sender], bool]
"""Whether a value for a port, from that sender, may come in."""


class _Waiting:
    """A value and the number of ticks it is still due for; None: until another one comes."""

    __slots__ = ("sender", "ticks", "value")

    def __init__(self, value: Any, ticks: int | None, sender: Sender) -> None:
        self.value = value
        self.ticks = ticks
        self.sender = sender


class Inbox:
    """Filled by the thread of a port, emptied by the robot loop."""

    def __init__(self, datatypes: Mapping[str, str]) -> None:
        """`datatypes` of the ports, by name."""
        self._datatypes = dict(datatypes)
        self._lock = threading.Lock()
        self._waiting: dict[str, deque[_Waiting]] = {
            port: deque(maxlen=KEPT.get(datatype, KEPT_MEASUREMENTS))
            for port, datatype in datatypes.items()
        }

    def put(self, *items: Item, sender: Sender) -> None:
        """Keep values for their ports; those for ports that are not there are none of ours.

        Raises ProtocolError, keeping none of them, when one has not its port's datatype.
        """
        ours = [item for item in items if item.port in self._datatypes]
        read = [values.read(self._datatypes[item.port], item.text) for item in ours]
        with self._lock:
            for item, value in zip(ours, read, strict=True):
                waiting = self._waiting[item.port]
                if waiting and waiting[-1].ticks is None:
                    waiting.pop()
                waiting.append(_Waiting(value, item.count, sender))

    def take(self, admits: Admits = lambda port, sender: True) -> dict[str, tuple[Any, float]]:
        """The values of this tick by port, each with when its sender spoke last, in seconds.

        What `admits` does not let in is forgotten.
        """
        taken = {}
        with self._lock:
            for port, waiting in self._waiting.items():
                while waiting and not admits(port, waiting[0].sender):
                    waiting.popleft()
                if waiting:
                    taken[port] = _next(waiting)
        return taken


def _next(waiting: deque[_Waiting]) -> tuple[Any, float]:
    first = waiting[0]
    if first.ticks is not None:
        first.ticks -= 1
        if not first.ticks:
            waiting.popleft()
    return first.value, -math.inf if first.sender.is_gone else first.sender.spoken
