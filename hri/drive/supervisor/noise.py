"""How much of what a base says makes no sense: bytes that belong to no whole report or answer."""

from __future__ import annotations

import math

MEMORY = 1.0
"""Seconds after which a byte counts for a third."""
FEWEST = 200
"""Bytes without which nothing is said."""


class Noise:
    """The share of senseless bytes of late."""

    def __init__(self) -> None:
        self._all = self._senseless = 0.0
        self._time: float | None = None

    @property
    def share(self) -> float:
        """0 to 1; 0 before FEWEST bytes have come."""
        return self._senseless / self._all if self._all >= FEWEST else 0.0

    def add(self, count: int, senseless: int, now: float) -> None:
        """Count the bytes received since the last call, and the garbage among them."""
        elapsed = 0.0 if self._time is None else max(0.0, now - self._time)
        decay, self._time = math.exp(-elapsed / MEMORY), now
        self._all = decay * self._all + count
        self._senseless = decay * self._senseless + senseless
