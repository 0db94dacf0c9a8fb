"""Conditions on events: all of them, any, one after the other, one without another.

door = sequence("door.opened", all_of("person.seen", "speech.heard"), within=10)
await when(context, door)                                 # the event that completed it
context.manager.install(raise_when, door, "visitor.came")  # raises an event, each time

A pattern such as "head.*" is the simplest condition. `within` is in seconds, from the first event
that counts to the one that completes it.

An event is looked at once, when it comes, and is not kept. For each part the latest event from
which on it has been met is stored: no more is needed by the parts that follow it and by the times
around it, however long ago it was.
"""

from __future__ import annotations

import itertools
import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from hri.core.event_bus import matches
from hri.core.signals import Event
from hri.task.context import TaskContext
from hri.task.queue import EventQueue


class Begin(NamedTuple):
    """An event that a condition may begin with; the latest is the greatest."""

    order: int
    time: float
    outer: Begin | None
    """Where the condition around this one begins."""


ANYWHERE = Begin(0, 0.0, None)
"""For a condition that no other is around: it does not matter where it begins."""

Match = Callable[[Event, Begin | None], Begin | None]
"""Looks at the next event, from which on the condition may begin; None while it may not yet.

Returns the latest event from which on the condition has been met; None while it has not.
"""


class Condition(ABC):
    """What is to happen."""

    @property
    @abstractmethod
    def patterns(self) -> frozenset[str]:
        """The events it looks at."""

    @abstractmethod
    def match(self) -> Match:
        """Look for it among the events from now on."""


@dataclass(frozen=True)
class _One(Condition):
    pattern: str

    @property
    def patterns(self) -> frozenset[str]:
        return frozenset([self.pattern])

    def match(self) -> Match:
        since: Begin | None = None

        def see(event: Event, begin: Begin | None) -> Begin | None:
            nonlocal since
            if begin is not None and matches(self.pattern, event.name):
                since = begin
            return since

        return see


@dataclass(frozen=True)
class _Parts(Condition):
    parts: tuple[Condition, ...]

    @property
    def patterns(self) -> frozenset[str]:
        return frozenset().union(*(part.patterns for part in self.parts))


class _All(_Parts):
    def match(self) -> Match:
        parts = [part.match() for part in self.parts]

        def see(event: Event, begin: Begin | None) -> Begin | None:
            begins = [met for part in parts if (met := part(event, begin)) is not None]
            return min(begins) if len(begins) == len(parts) else None

        return see


class _Any(_Parts):
    def match(self) -> Match:
        parts = [part.match() for part in self.parts]

        def see(event: Event, begin: Begin | None) -> Begin | None:
            begins = [met for part in parts if (met := part(event, begin)) is not None]
            return max(begins, default=None)

        return see


class _Sequence(_Parts):
    def match(self) -> Match:
        parts = [part.match() for part in self.parts]
        since: list[Begin | None] = [None] * len(parts)

        def see(event: Event, begin: Begin | None) -> Begin | None:
            # Each part may begin once the one before it was met, by an earlier event.
            begins = [begin, *since[:-1]]
            since[:] = [part(event, begin) for part, begin in zip(parts, begins, strict=True)]
            return since[-1]

        return see


@dataclass(frozen=True)
class _Without(Condition):
    wanted: Condition
    unwanted: Condition

    @property
    def patterns(self) -> frozenset[str]:
        return self.wanted.patterns | self.unwanted.patterns

    def match(self) -> Match:
        wanted, unwanted = self.wanted.match(), self.unwanted.match()
        since: Begin | None = None

        def see(event: Event, begin: Begin | None) -> Begin | None:
            nonlocal wanted, unwanted, since
            if unwanted(event, begin) is not None:
                wanted, unwanted = self.wanted.match(), self.unwanted.match()
            else:
                since = wanted(event, begin) or since
            return since

        return see


@dataclass(frozen=True)
class _Within(Condition):
    wanted: Condition
    seconds: float

    @property
    def patterns(self) -> frozenset[str]:
        return self.wanted.patterns

    def match(self) -> Match:
        wanted, orders = self.wanted.match(), itertools.count()
        since: Begin | None = None

        def see(event: Event, begin: Begin | None) -> Begin | None:
            nonlocal since
            here = None if begin is None else Begin(next(orders), event.time, begin)
            met = wanted(event, here)
            if met is not None and event.time - met.time <= self.seconds:
                since = met.outer
            return since

        return see


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
    """The first has come and the second has not meanwhile; when it does, all begins again."""
    return _Without(*_conditions((wanted, unwanted)))


async def when(context: TaskContext, condition: str | Condition) -> Event:
    """Wait until a condition is met by events from now on; the event that completes it."""
    with context.queue("*") as queue:
        return await _next(queue, *_conditions((condition,)))


async def raise_when(context: TaskContext, condition: str | Condition, name: str) -> None:
    """Raise an event each time a condition is met, for ever; each time begins again.

    Raises ValueError for an event that would set itself off.
    """
    (condition,) = _conditions((condition,))
    if any(matches(pattern, name) for pattern in condition.patterns):
        raise ValueError(
            f'the condition of "{name}" contains "{name}" itself - choose another name'
        )
    with context.queue("*") as queue:
        while True:
            await _next(queue, condition)
            context.events.raise_event(name)


async def _next(queue: EventQueue, condition: Condition) -> Event:
    """The event that completes a condition, of those from a queue."""
    match = condition.match()
    while True:
        event = await queue.get()
        if match(event, ANYWHERE) is not None:
            return event


def _conditions(parts: Sequence[str | Condition]) -> tuple[Condition, ...]:
    if not parts:
        raise ValueError("a condition of nothing - name at least one event")
    return tuple(_One(part) if isinstance(part, str) else part for part in parts)


def _timed(condition: Condition, within: float) -> Condition:
    return condition if within == math.inf else _Within(condition, within)
