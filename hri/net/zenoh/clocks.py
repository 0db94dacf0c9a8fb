"""What time it is on another machine, from round trips: Cristian's algorithm.

F. Cristian, Probabilistic clock synchronization (Distributed Computing 3, 1989): the other clock
was read between question and answer, so half of the shortest round trip bounds the error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

KEPT = 8
"""Round trips of which the shortest counts: older ones say less, since clocks drift."""


@dataclass(frozen=True, slots=True)
class RoundTrip:
    """One question for the time; all in seconds."""

    asked: float
    answered: float
    """Of our clock."""
    theirs: float
    """Their clock, some time between."""

    @property
    def length(self) -> float:
        """How long it took."""
        return self.answered - self.asked


class OtherClock:
    """Compares the clock of someone else with ours."""

    def __init__(self) -> None:
        self._trips: tuple[RoundTrip, ...] = ()
        # Replaced as a whole: another thread reads it meanwhile.
        self._best: RoundTrip | None = None

    def take(self, trip: RoundTrip) -> None:
        """Learn from a round trip; one that ends before it begins is left out."""
        if trip.length >= 0 and math.isfinite(trip.theirs):
            self._trips = (*self._trips, trip)[-KEPT:]
            self._best = min(self._trips, key=lambda one: one.length)

    @property
    def uncertainty(self) -> float:
        """Seconds that `ours` may be wrong by; infinite before the first round trip."""
        return math.inf if self._best is None else self._best.length / 2

    def ours(self, theirs: float) -> float:
        """What our clock showed at a time of theirs. Raises ValueError before a round trip."""
        if (best := self._best) is None:
            raise ValueError("no round trip yet")
        return theirs - best.theirs + (best.asked + best.answered) / 2
