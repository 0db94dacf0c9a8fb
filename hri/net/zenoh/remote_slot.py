"""A slot of the board that lives on another robot: `anna/battery`.

Where its address stands in a network or a task, the newest value of that robot is read, and what is
written goes there. A robot that is silent is a sensor that was lost: the slot empties.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hri.core.latest import Latest

SILENCE = 0.18
"""Seconds without a word after which a value counts no more; a drive stops by then, too."""
REPEAT = 0.05
"""Seconds after which a value that stays is sent again."""


@dataclass(frozen=True, slots=True)
class Arrival:
    """When a value was made, sent, and came; seconds of our clock."""

    datatype: str
    made: float
    sent: float
    now: float

    @property
    def age(self) -> float:
        """Seconds since the value was made."""
        return max(self.now - self.made, 0.0)

    @property
    def is_fresh(self) -> bool:
        """Whether it was on its way for less than a silence."""
        return self.now - self.sent <= SILENCE

    @property
    def spoken(self) -> float:
        """When its sender stood by it last."""
        return min(self.sent, self.now)


class RemoteSlot(Latest[Any]):
    """Filled by `arrive`, from any thread; what is `set` here is sent away."""

    def __init__(self, address: str, send: Callable[[RemoteSlot], object]) -> None:
        """`send` gets the slot after each value that was set here."""
        super().__init__()
        self.robot, _, self.name = address.partition("/")
        self._send = send
        self._guard = threading.Lock()
        self._heard = 0.0
        self.is_written = False
        """Whether values are set here, and go to the other robot."""
        self.datatype = ""
        """Of what arrives."""
        self.age = 0.0
        """Seconds from where the value was made to its arrival."""

    def set(self, value: Any, time: float, spoken: float | None = None, writer: str = "") -> None:
        self.is_written = True
        super().set(value, time, spoken, writer)
        self._send(self)

    def clear(self) -> None:
        had_one = self.value is not None
        super().clear()
        if self.is_written and had_one:
            self._send(self)

    def arrive(self, value: Any, came: Arrival) -> None:
        """Take a value of the other robot; None for one that is empty there."""
        with self._guard:
            self._heard, self.datatype, self.age = came.now, came.datatype, came.age
            if value is None or not came.is_fresh:
                super().clear()
            else:
                super().set(value, came.now, came.spoken, self.robot)

    def fell_silent(self, now: float) -> bool:
        """Whether the other robot was silent for too long; then it is emptied, once."""
        with self._guard:
            is_silent = not self.is_written and now - self._heard > SILENCE
            if not is_silent or self.value is None:
                return False
            super().clear()
            return True
