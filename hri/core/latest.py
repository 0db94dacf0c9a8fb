"""The newest value of something, shared between parts that run at their own pace."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Generic, TypeVar

T = TypeVar("T")


class Latest(Generic[T]):
    """One slot: a writer never waits, a reader gets the newest value and its time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._value: T | None = None
        self._time = 0.0
        self._spoken: float | None = None
        self.writer = ""
        """The last writer: `network.behavior.output`; empty for a task."""

    def set(self, value: T, time: float, spoken: float | None = None, writer: str = "") -> None:
        """Write at `time`, in seconds; `spoken` as in `hri.behavior.ports.OutputPort`."""
        with self._lock:
            self._value, self._time, self._spoken = value, time, spoken
            self.writer = writer

    def get(self) -> tuple[T | None, float]:
        """The value and its time in seconds; (None, 0.0) before the first."""
        with self._lock:
            return self._value, self._time

    @property
    def spoken(self) -> float | None:
        """When someone outside, on whose word the value rests, spoke last; None: nobody."""
        return self._spoken

    def clear(self) -> None:
        with self._lock:
            self._value = None

    @property
    def value(self) -> T | None:
        return self._value


class Board:
    """Named slots: where networks of different rates, and tasks, meet."""

    def __init__(self) -> None:
        self._slots: dict[str, Latest[Any]] = {}
        self.remote: Callable[[str], Latest[Any]] | None = None
        """Makes the slots of other robots, which have a slash: `anna/battery`; None where none can
        be reached. To be set before the robot lives."""

    def slot(self, name: str) -> Latest[Any]:
        """The slot of that name, made on first use."""
        if name not in self._slots:
            make = self.remote if "/" in name else None
            self._slots[name] = Latest() if make is None else make(name)
        return self._slots[name]

    def __contains__(self, name: str) -> bool:
        """Whether a slot of that name was used."""
        return name in self._slots
