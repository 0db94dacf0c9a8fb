"""Which objects are there, from pictures in which one may be missed now and then."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from typing import Generic, Protocol, TypeVar


class Named(Protocol):
    """Something that is known again by its name."""

    @property
    def name(self) -> str: ...


Found = TypeVar("Found", bound=Named)

SEEN_IN, OF_PICTURES = 2, 3
"""An object has come when it is found in this many of this many pictures in a row."""
MEMORY = 2.0
"""Seconds after which an object that is not found again is gone."""


class ObjectPresence(Generic[Found]):
    """Reports objects or markers that come and go, from those found in each picture."""

    def __init__(self) -> None:
        self._recent: deque[frozenset[str]] = deque(maxlen=OF_PICTURES)
        self._last: dict[str, tuple[float, Found]] = {}

    def update(self, time: float, found: Sequence[Found]) -> tuple[list[Found], list[str]]:
        """Which have come with the picture of this time, and the names of those that are gone.

        Of several with the same name, the first counts.
        """
        surest = {one.name: one for one in reversed(found)}
        self._recent.append(frozenset(surest))
        come = []
        for name, one in surest.items():
            is_new = name not in self._last
            if is_new and sum(name in names for names in self._recent) < SEEN_IN:
                continue
            self._last[name] = time, one
            if is_new:
                come.append(one)
        return come, self.forget(time)

    def forget(self, now: float) -> list[str]:
        """The names of those that were not found for `MEMORY` seconds: they are gone."""
        gone = [name for name, (time, _) in self._last.items() if now - time > MEMORY]
        for name in gone:
            del self._last[name]
        return gone

    @property
    def present(self) -> tuple[Found, ...]:
        """Those that are there, each as it was found last, in the order they came."""
        return tuple(one for _, one in self._last.values())
