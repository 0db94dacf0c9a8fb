"""A battery that time and motion empty."""

from __future__ import annotations

from dataclasses import dataclass

IDLE_LIFE = 4 * 3600.0
"""Seconds a full battery lasts when the robot only listens."""
RANGE = 3000.0
"""Meters the wheels turn on a full battery."""


@dataclass(frozen=True, slots=True)
class Charge:
    """What the battery held at a moment; what it holds later follows from that."""

    level: float
    """0 (empty) to 1 (full)."""
    time: float = 0.0
    """Seconds."""
    way: float = 0.0
    """Meters the wheels had turned by then."""

    def level_at(self, time: float, way: float) -> float:
        """0 to 1, after standing and driving until then."""
        used = (time - self.time) / IDLE_LIFE + (way - self.way) / RANGE
        return min(1.0, max(0.0, self.level - used))
