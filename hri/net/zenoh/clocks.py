"""What time it is on another machine, from round trips: Cristian's algorithm.

F. Cristian, Probabilistic clock synchronization (Distributed Computing 3, 1989): the other clock
was read between question and answer, so half of the shortest round trip bounds the error.
"""

from __future__ import annotations

import math
from collections import deque
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
        self._trips: deque[RoundTrip] = deque(maxlen=KEPT)

    def take(self, trip: RoundTrip) -> None:
        """Learn from a round trip; one that ends before it begins is left out."""
        if trip.length >= 0 and math.isfinite(trip.theirs):
            self._trips.append(trip)

    @property
    def uncertainty(self) -> float:
        """Seconds that `ours` may be wrong by; infinite before the first round trip."""
        return min((trip.length / 2 for trip in self._trips), default=math.inf)

    def ours(self, theirs: float) -> float:
        """What our clock showed at a time of theirs. Raises ValueError before a round trip."""
        if not self._trips:
            raise ValueError("no round trip yet")
        best = min(self._trips, key=lambda trip: trip.length)
        return theirs - best.theirs + (best.asked + best.answered) / 2
