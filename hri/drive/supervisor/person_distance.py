"""Whether a person is near, by what the program says of the nearest one."""

from __future__ import annotations

import math

NEAR = 1.5
"""Meters; a person who is nearer slows the base down."""
FRESH = 1.0
"""Seconds that a distance is believed; then someone may be near."""


class Nearness:
    """The last word about the nearest person."""

    def __init__(self) -> None:
        self._distance, self._heard = math.inf, -math.inf

    def hear(self, distance: float, now: float) -> None:
        """How far the nearest person is, meters; infinite when surely nobody is about."""
        self._distance, self._heard = (distance if distance >= 0 else 0.0), now

    def is_near(self, now: float) -> bool:
        """Whether someone is near, or nobody knows."""
        return not (0 <= now - self._heard <= FRESH and self._distance >= NEAR)
