"""The spoken order that a task carries out.

A task that takes `speech.heard` from a queue obeys whoever said that until it asks for the next
event; so do the tasks that it installs meanwhile. Nothing else is an order.
"""

from __future__ import annotations

import math
from contextvars import ContextVar

from hri.core.signals import Event

NEVER = -math.inf
"""When the order was said that nobody gave."""

_said: ContextVar[float] = ContextVar("said", default=NEVER)


def said() -> float:
    """When a person began to say the order that is carried out, in seconds; NEVER without one."""
    return _said.get()


def obey(when: float) -> None:
    """Let the running task carry out an order that was said then, or none: NEVER."""
    _said.set(when)


def said_in(event: Event) -> float:
    """When a person began to say what was heard, in seconds; NEVER for any other event."""
    if event.name != "speech.heard":
        return NEVER
    return float(event.properties.get("start", event.time))
