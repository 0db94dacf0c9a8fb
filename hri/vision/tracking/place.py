"""Where someone is in a picture."""

from __future__ import annotations

import math
from dataclasses import dataclass

FAR = 1e5
"""Pixels; nothing that far out is a place."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where someone's face is, seen or not, and how large: pixels."""

    x: float
    y: float
    breadth: float
    """From chin to hairline."""

    @property
    def is_somewhere(self) -> bool:
        """Whether anyone can be there: near the picture, and of some size."""
        return all(abs(edge) < FAR for edge in (self.x, self.y)) and 1.0 <= self.breadth < FAR

    def away(self, other: Place) -> float:
        """To another one across the picture, in sizes of the larger face."""
        away = abs(self.x - other.x) / max(self.breadth, other.breadth, 1.0)
        return away if math.isfinite(away) else math.inf
