"""Events by name: raised once, delivered in the order their listeners came."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from hri.core.clock import Clock, since_1970
from hri.core.errors import HriError
from hri.core.origin import BRIDGE, caused_by, origin
from hri.core.signals import Event

Listener = Callable[[Event], object]

# fmt: off
OWN_SUBJECTS = frozenset((
    "alarm", "battery", "behavior", "bumper", "button", "camera", "cliff", "drive",
    "emotion", "emotions", "face", "fleet", "gesture", "grammar", "hand", "head", "idle", "marker",
    "mcp", "memory", "microphone", "motion", "network", "object", "odometry", "person", "question",
    "recording", "replies", "speech", "stimulus", "studio", "target", "task", "vision",
    "visitor", "window",
))
# fmt: on
"""What the robot's own events are about: the first word of their names."""
OWN_KEYS = frozenset(("t", "event", "outside", "origin"))
"""What the line of an event in a recording says beside its properties."""

log = logging.getLogger("hri.events")


@dataclass(eq=False, slots=True)
class Subscription:
    """A listener's place in the bus; `cancel()` ends it, a second call does nothing."""

    pattern: str
    listener: Listener
    bus: EventBus
    has_failed: bool = False

    def cancel(self) -> None:
        if self in self.bus.subscriptions:
            self.bus.subscriptions.remove(self)

    def tell(self, event: Event) -> None:
        """Let the listener hear an event; what it fails with is for the log."""
        try:
            self.listener(event)
        except Exception as error:
            if not self.has_failed:
                what = 'a listener to "%s" failed at %s, logged once: %s'
                log.error(what, self.pattern, event.name, error, exc_info=error)
            self.has_failed = True


class EventBus:
    """Carries events between behaviors, tasks and recordings; used from the robot loop only."""

    def __init__(self, clock: Clock) -> None:
        self.clock = clock
        self.subscriptions: list[Subscription] = []

    def raise_event(self, name: str, /, **properties: Any) -> Event:
        """Call all listeners whose pattern matches, now; a failing one does not affect the
        others. It has the origin of what goes on now (`hri.core.origin`).
        """
        return self._tell(Event(name, properties=properties, origin=origin()))

    def raise_from_outside(self, event: Event) -> Event:
        """Raise an event of another program, now and marked as such.

        Raises HriError as `check_from_outside` does.
        """
        check_from_outside(event)
        with caused_by(BRIDGE):
            return self._tell(replace(event, is_from_outside=True, origin=BRIDGE))

    def _tell(self, event: Event) -> Event:
        event = replace(event, time=self.clock.now(), since_1970=since_1970(self.clock))
        for subscription in tuple(self.subscriptions):
            if matches(subscription.pattern, event.name):
                subscription.tell(event)
        return event

    def subscribe(self, pattern: str, listener: Listener) -> Subscription:
        """Listen; `*` in the pattern stands for any run of characters."""
        subscription = Subscription(pattern, listener, self)
        self.subscriptions.append(subscription)
        return subscription


def is_own(name: str) -> bool:
    """Whether the robot itself raises events of that name, or obeys them."""
    return name.partition(".")[0] in OWN_SUBJECTS


def check_from_outside(event: Event) -> None:
    """Raise HriError for an event that would pass for what the robot has sensed or done itself."""
    if is_own(event.name):
        raise HriError(f'only the robot itself raises "{event.name}" - choose another name')
    for name in OWN_KEYS & event.properties.keys():
        raise HriError(f'"{event.name}" has a property "{name}" - choose another name for it')


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
