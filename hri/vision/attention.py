"""Picks the person the robot attends to, with hysteresis."""

from __future__ import annotations

import math
from collections.abc import Iterable

from hri.core.signals import Person
from hri.vision.engagement import DISENGAGING, ENGAGED, ENGAGING, UNENGAGED

WEIGHTS = {ENGAGED: 2.0, ENGAGING: 1.0, DISENGAGING: 0.7, UNENGAGED: 0.0}
"""What taking part counts."""
LOOKING = 1.0
"""What looking at the robot counts."""
NEARNESS = 0.5
"""What it counts to stand at the robot; half as much one `REACH` away."""
REACH = 1.5
"""Meters."""
LEAD = 0.6
"""Margin by which another person must exceed the attended one ..."""
HOLD = 1.5
"""... for this many seconds."""
PATIENCE = 1.0
"""Seconds for which it stays with someone who is out of sight."""


class Attending:
    """Chooses one person and stays with them until another is clearly more, for some time."""

    def __init__(self) -> None:
        self.chosen = ""
        self._seen = self._rival_since = -math.inf
        self._rival = ""

    def choose(self, time: float, persons: Iterable[Person]) -> str:
        """Id of the one to attend to at a time in seconds; empty when nobody is there."""
        claims = {person.id: claim(person) for person in persons if person.is_visible}
        if time < self._seen:
            self._seen = self._rival_since = time
        if self.chosen in claims:
            self._seen = time
        elif time - self._seen > PATIENCE:
            self.chosen = ""
        best = max(claims, key=lambda id: claims[id], default="")
        if not self.chosen:
            self.chosen = best
            self._seen = time
        elif self._is_displaced(time, best, claims):
            self.chosen, self._rival = best, ""
        return self.chosen

    def _is_displaced(self, time: float, best: str, claims: dict[str, float]) -> bool:
        """Whether the best of the others has been more for long enough."""
        if best == self.chosen or self.chosen not in claims:
            self._rival = ""
            return False
        if claims[best] < claims[self.chosen] + LEAD:
            self._rival = ""
            return False
        if self._rival != best:
            self._rival, self._rival_since = best, time
        return time - self._rival_since >= HOLD


def claim(person: Person) -> float:
    """How much someone asks for attention, by taking part, looking, and being near."""
    distance = person.distance if math.isfinite(person.distance) else 2 * REACH
    nearness = NEARNESS * REACH / (REACH + max(0.0, distance))
    return WEIGHTS[person.engagement] + LOOKING * person.looking + nearness
