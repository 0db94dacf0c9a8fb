"""The last events, each kind counted separately: frequent ones must not push out speech."""

from __future__ import annotations

import heapq
import itertools
from collections import deque
from collections.abc import Mapping
from operator import itemgetter
from typing import Generic, TypeVar

T = TypeVar("T")

CONVERSATION = frozenset({"speech.heard", "speech.rejected", "speech.said"})
"""Events that the page shows as lines of the conversation."""
FLOOD = frozenset({"odometry"})
"""Events that come many times a second. The topic `base` has the newest."""
MOST_LINES, MOST_FLOOD, MOST_OTHERS = 200, 20, 300


_NUMBERS = itertools.count()
"""By which events of all memories are in order."""


class EventMemory(Generic[T]):
    """Remembers as many events of each kind as its shelf holds; the oldest are forgotten."""

    def __init__(self, most_flood: int = MOST_FLOOD) -> None:
        self._lines, self._flood, self._others = (
            deque[tuple[int, T]](maxlen=most) for most in (MOST_LINES, most_flood, MOST_OTHERS)
        )

    def __bool__(self) -> bool:
        return any(self._shelves)

    @property
    def _shelves(self) -> tuple[deque[tuple[int, T]], ...]:
        return self._lines, self._flood, self._others

    def add(self, event: Mapping[str, object], kept: T) -> None:
        """Remember an event, as what is to be `kept` of it."""
        name = event.get("event")
        shelf = (
            self._lines if name in CONVERSATION else self._flood if name in FLOOD else self._others
        )
        shelf.append((next(_NUMBERS), kept))

    def all(self) -> list[T]:
        """All that is remembered, the oldest first."""
        return [kept for _, kept in heapq.merge(*self._shelves, key=itemgetter(0))]

    def take(self) -> list[T]:
        """The same, which is forgotten then."""
        found = self.all()
        for shelf in self._shelves:
            shelf.clear()
        return found

    def extend(self, other: EventMemory[T]) -> None:
        """Remember what another memory does, too."""
        for shelf, more in zip(self._shelves, other._shelves, strict=True):
            shelf.extend(more)
