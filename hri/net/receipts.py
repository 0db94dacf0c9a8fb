"""Events for the values that other programs send: a recording shows what came from outside."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hri.core.event_bus import EventBus
from hri.core.origin import BRIDGE, caused_by

RECEIVED = "network.received"
"""The event: `port` (`tag.port`) and `value`."""
A_SECOND = 2.0
"""Events of a port, over time; a stream of values is told as often."""
AT_ONCE = 10.0
"""Events of a port that may come faster."""
LONGEST = 500
"""Characters of a text that are told, and numbers of an array."""


class Receipts:
    """Raises `network.received` for each new value, within limits."""

    def __init__(self, tag: str, events: EventBus) -> None:
        self._tag, self._events = tag, events
        self._told: dict[str, Any] = {}
        """By port, the value that was told last, as long as it goes on."""
        self._allowance: dict[str, float] = {}

    def take(self, values: Mapping[str, Any], dt: float) -> None:
        """Look at the values of a tick of `dt` seconds, by port."""
        for port in self._told.keys() - values.keys():
            del self._told[port]
        for port, value in values.items():
            allowance = min(AT_ONCE, self._allowance.get(port, AT_ONCE) + A_SECOND * dt)
            if allowance >= 1.0 and (port not in self._told or self._told[port] != value):
                allowance -= 1.0
                self._told[port] = value
                short = value[:LONGEST] if isinstance(value, (str, tuple)) else value
                with caused_by(BRIDGE):
                    self._events.raise_event(RECEIVED, port=f"{self._tag}.{port}", value=short)
            self._allowance[port] = allowance
