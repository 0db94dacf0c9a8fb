"""Whether a base falls silent again and again while it drives."""

from __future__ import annotations

from collections import deque

MOST, WITHIN = 3, 10.0
"""Limit of silences, and its period in seconds."""


class Silences:
    """When the base fell silent, and was stopped for it."""

    def __init__(self) -> None:
        self._times: deque[float] = deque(maxlen=MOST)

    def add(self, now: float) -> bool:
        """One more; whether that is one too many, after which counting begins again."""
        self._times.append(now)
        is_too_many = len(self._times) == MOST and now - self._times[0] <= WITHIN
        if is_too_many:
            self._times.clear()
        return is_too_many
