"""Which objects are there, from pictures in which one may be missed now and then."""

from __future__ import annotations

from collections import deque

from hri.core.signals import FoundObject, Objects

SEEN_IN, OF_PICTURES = 2, 3
"""An object has come when it is found in this many of this many pictures in a row."""
MEMORY = 2.0
"""Seconds after which an object that is not found again is gone."""


class ObjectPresence:
    """Reports objects that come and go, from those found in each picture."""

    def __init__(self) -> None:
        self._recent: deque[frozenset[str]] = deque(maxlen=OF_PICTURES)
        self._last: dict[str, tuple[float, FoundObject]] = {}

    def update(self, objects: Objects) -> tuple[list[FoundObject], list[str]]:
        """Which have come with this picture, and the names of those that are gone."""
        surest = {one.name: one for one in reversed(objects.found)}
        self._recent.append(frozenset(surest))
        come = []
        for name, one in surest.items():
            is_new = name not in self._last
            if is_new and sum(name in names for names in self._recent) < SEEN_IN:
                continue
            self._last[name] = objects.time, one
            if is_new:
                come.append(one)
        return come, self.forget(objects.time)

    def forget(self, now: float) -> list[str]:
        """The names of those that were not found for `MEMORY` seconds: they are gone."""
        gone = [name for name, (time, _) in self._last.items() if now - time > MEMORY]
        for name in gone:
            del self._last[name]
        return gone

    @property
    def present(self) -> tuple[FoundObject, ...]:
        """Those that are there, each as it was found last, in the order they came."""
        return tuple(one for _, one in self._last.values())
