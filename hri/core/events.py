"""Events by name: raised once, delivered in the order their listeners came."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hri.core.clock import Clock
from hri.core.signals import Event

Listener = Callable[[Event], object]


@dataclass(slots=True)
class Subscription:
    """A listener's place in the bus; `cancel()` ends it, a second call does nothing."""

    pattern: str
    listener: Listener
    bus: EventBus

    def cancel(self) -> None:
        if self in self.bus.subscriptions:
            self.bus.subscriptions.remove(self)


class EventBus:
    """Carries events between behaviors, tasks and recordings; used from the robot loop only."""

    def __init__(self, clock: Clock) -> None:
        self.clock = clock
        self.subscriptions: list[Subscription] = []

    def raise_event(self, name: str, /, **properties: Any) -> Event:
        """Tell all listeners whose pattern fits, now."""
        event = Event(name, self.clock.now(), properties)
        for subscription in tuple(self.subscriptions):
            if matches(subscription.pattern, name):
                subscription.listener(event)
        return event

    def subscribe(self, pattern: str, listener: Listener) -> Subscription:
        """Listen; `*` in the pattern stands for any run of characters."""
        subscription = Subscription(pattern, listener, self)
        self.subscriptions.append(subscription)
        return subscription


def matches(pattern: str, name: str) -> bool:
    """Whether a name fits a pattern; `*` stands for any characters, all others for themselves.

    Takes the leftmost place for each part, which finds a fit where there is one, in linear time.
    """
    first, *parts = pattern.split("*")
    if not parts:
        return pattern == name
    last = parts.pop()
    if len(name) < len(first) + len(last) or not name.startswith(first):
        return False
    at, end = len(first), len(name) - len(last)
    for part in parts:
        found = name.find(part, at, end)
        if found < 0:
            return False
        at = found + len(part)
    return name.endswith(last)
