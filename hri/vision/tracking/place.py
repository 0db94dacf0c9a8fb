"""Where someone is in a picture."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hri.core.signals import FaceBox

CROWN_TO_FEET = (-1.2, -0.9, 1.2, 8.9)
"""A standing adult in sizes of the face from its middle: left, top, right, bottom."""

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

    @property
    def body(self) -> FaceBox:
        """From crown to feet of someone who stands there."""
        left, top, right, bottom = (self.breadth * edge for edge in CROWN_TO_FEET)
        return FaceBox(self.x + left, self.y + top, right - left, bottom - top)

    @classmethod
    def on_body(cls, body: FaceBox) -> Place:
        """Where the face of someone is whose body goes from crown to feet."""
        _, top, _, bottom = CROWN_TO_FEET
        breadth = body.height / (bottom - top)
        return cls(body.x + body.width / 2, body.y - top * breadth, breadth)

    def away(self, other: Place) -> float:
        """To another one across the picture, in sizes of the larger face."""
        away = abs(self.x - other.x) / max(self.breadth, other.breadth, 1.0)
        return away if math.isfinite(away) else math.inf
