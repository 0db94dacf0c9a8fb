"""Conditions on events: all of them, any, one after the other, one without another.

door = sequence("door.opened", all_of("person.seen", "speech.heard"), within=10)
await when(context, door)                                 # the event that completed it
context.manager.install(raise_when, door, "visitor.came")  # an event of its own, each time

A pattern such as "head.*" is the simplest condition. `within` is in seconds, from the first event
that counts to the one that completes it.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

from hri.core.events import matches
from hri.core.signals import Event
from hri.task.context import TaskContext
from hri.task.queue import EventQueue

LONGEST = 100
"""How many events of the patterns in question are remembered; the oldest give way."""


class Condition(ABC):
    """Pure: looks at events in their order."""

    @property
    @abstractmethod
    def patterns(self) -> frozenset[str]:
        """The events it looks at."""

    @abstractmethod
    def met(self, events: Sequence[Event], start: int = 0) -> int | None:
        """The index of the event that completes it, of those from `start` on; None without."""


@dataclass(frozen=True)
class _One(Condition):
    pattern: str

    @property
    def patterns(self) -> frozenset[str]:
        return frozenset([self.pattern])

    def met(self, events: Sequence[Event], start: int = 0) -> int | None:
        for at in range(start, len(events)):
            if matches(self.pattern, events[at].name):
                return at
        return None


@dataclass(frozen=True)
class _Parts(Condition):
    parts: tuple[Condition, ...]

    @property
    def patterns(self) -> frozenset[str]:
        return frozenset().union(*(part.patterns for part in self.parts))


class _All(_Parts):
    def met(self, events: Sequence[Event], start: int = 0) -> int | None:
        ends = [end for part in self.parts if (end := part.met(events, start)) is not None]
        return max(ends) if len(ends) == len(self.parts) else None


class _Any(_Parts):
    def met(self, events: Sequence[Event], start: int = 0) -> int | None:
        ends = [end for part in self.parts if (end := part.met(events, start)) is not None]
        return min(ends, default=None)


class _Sequence(_Parts):
    def met(self, events: Sequence[Event], start: int = 0) -> int | None:
        end = start - 1
        for part in self.parts:
            if (next := part.met(events, end + 1)) is None:
                return None
            end = next
        return end


@dataclass(frozen=True)
class _Without(Condition):
    wanted: Condition
    unwanted: Condition

    @property
    def patterns(self) -> frozenset[str]:
        return self.wanted.patterns | self.unwanted.patterns

    def met(self, events: Sequence[Event], start: int = 0) -> int | None:
        while (end := self.wanted.met(events, start)) is not None:
            spoiled = self.unwanted.met(events, start)
            if spoiled is None or spoiled > end:
                return end
            start = spoiled + 1
        return None


@dataclass(frozen=True)
class _Within(Condition):
    wanted: Condition
    seconds: float

    @property
    def patterns(self) -> frozenset[str]:
        return self.wanted.patterns

    def met(self, events: Sequence[Event], start: int = 0) -> int | None:
        ends = []
        for begin in range(start, len(events)):
            end = self.wanted.met(events, begin)
            if end is not None and events[end].time - events[begin].time <= self.seconds:
                ends.append(end)
        return min(ends, default=None)


def all_of(*parts: str | Condition, within: float = math.inf) -> Condition:
    """Each part has come, in whatever order."""
    return _timed(_All(_conditions(parts)), within)


def any_of(*parts: str | Condition) -> Condition:
    """One part has come."""
    return _Any(_conditions(parts))


def sequence(*parts: str | Condition, within: float = math.inf) -> Condition:
    """The parts have come one after the other; others may come between."""
    return _timed(_Sequence(_conditions(parts)), within)


def without(wanted: str | Condition, unwanted: str | Condition) -> Condition:
    """The first has come and the second has not meanwhile; when it does, all begins anew."""
    return _Without(*_conditions((wanted, unwanted)))


async def when(context: TaskContext, condition: str | Condition) -> Event:
    """Wait until a condition is met by events from now on; the event that completes it."""
    with context.queue("*") as queue:
        return await _next(queue, *_conditions((condition,)))


async def raise_when(context: TaskContext, condition: str | Condition, name: str) -> None:
    """Raise an event each time a condition is met, for ever; each time begins anew.

    Raises ValueError for an event that would set itself off.
    """
    (condition,) = _conditions((condition,))
    if any(matches(pattern, name) for pattern in condition.patterns):
        raise ValueError(f'"{name}" is part of its own condition - choose another name')
    with context.queue("*") as queue:
        while True:
            await _next(queue, condition)
            context.events.raise_event(name)


async def _next(queue: EventQueue, condition: Condition) -> Event:
    """The event that completes a condition, of those from a queue."""
    events: list[Event] = []
    while True:
        event = await queue.get()
        if any(matches(pattern, event.name) for pattern in condition.patterns):
            events = [*events[-LONGEST + 1 :], event]
            if condition.met(events) is not None:
                return event


def _conditions(parts: Sequence[str | Condition]) -> tuple[Condition, ...]:
    if not parts:
        raise ValueError("a condition of nothing - name at least one event")
    return tuple(_One(part) if isinstance(part, str) else part for part in parts)


def _timed(condition: Condition, within: float) -> Condition:
    return condition if within == math.inf else _Within(condition, within)
