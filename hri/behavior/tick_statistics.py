"""Statistics of a running network: durations of its behaviors, lateness and number of its ticks."""

from __future__ import annotations

from collections import Counter, deque
from dataclasses import dataclass, field


@dataclass(slots=True)
class Timing:
    """Durations of something that happens repeatedly, seconds."""

    count: int = 0
    total: float = 0.0
    longest: float = 0.0
    last: float = 0.0
    missed: int = 0
    """Ticks that were missed because this took longest."""

    @property
    def mean(self) -> float:
        return self.total / self.count if self.count else 0.0

    def add(self, seconds: float) -> None:
        self.count += 1
        self.total += seconds
        self.last = seconds
        self.longest = max(self.longest, seconds)


@dataclass
class Statistics:
    """Statistics of a network; times in seconds."""

    behaviors: dict[str, Timing] = field(default_factory=dict)
    """How long each behavior took, by its id."""
    lateness: Timing = field(default_factory=Timing)
    """How long after its deadline each tick began."""
    ticks: int = 0
    missed: int = 0
    causes: Counter[str] = field(default_factory=Counter)
    """How many ticks were missed by cause: a behavior, what held the loop up, or "" for neither."""
    slowest: str = ""
    """What took longest in the last missed interval: a behavior, or "" when the tick began late."""
    failures: int = 0
    """Exceptions that behaviors have raised."""
    recent: deque[float] = field(default_factory=lambda: deque(maxlen=1000))
    """How long the last ticks took."""
