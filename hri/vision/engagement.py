"""Engagement of a person, from their distance and whether they look.

Two zones as on Furhat: who comes within the outer one and looks is on the way to engaging, who
comes within the inner one and looks is engaged, and stays so as far as the outer one. The four
levels are those of ROS4HRI's EngagementLevel.
"""

from __future__ import annotations

from dataclasses import dataclass

UNENGAGED, ENGAGING, ENGAGED, DISENGAGING = "unengaged", "engaging", "engaged", "disengaging"


@dataclass(frozen=True, slots=True)
class Zones:
    """Distances and times that decide; the defaults are Furhat's zones."""

    inner: float = 1.0
    """Meters; nearer and looking is engaged."""
    outer: float = 1.5
    """Meters; farther away nobody is engaged."""
    margin: float = 0.15
    """Meters beyond the outer zone that it takes to leave it."""
    patience: float = 3.0
    """Seconds of looking away after which they take part no more."""
    farewell: float = 2.0
    """Seconds of disengaging after which it is over."""


class Engagement:
    """One person's engagement."""

    def __init__(self, zones: Zones | None = None) -> None:
        self.level = UNENGAGED
        self._zones = zones or Zones()
        self._time = self._looked = self._changed = 0.0

    def update(self, time: float, distance: float, is_looking: bool) -> str:
        """The level, from the distance in meters at a time in seconds.

        A distance that is NaN is taken for far away.
        """
        if time < self._time:
            self._looked = self._changed = time
        self._time = time
        if is_looking:
            self._looked = time
        level = self._next(distance, is_looking)
        if level != self.level:
            self.level, self._changed = level, time
        return level

    def _next(self, distance: float, is_looking: bool) -> str:
        zones = self._zones
        is_near, is_within = distance < zones.inner, distance < zones.outer
        has_left = not distance < zones.outer + zones.margin
        is_over = has_left or self._time - self._looked > zones.patience
        if self.level == UNENGAGED:
            return ENGAGING if is_within and is_looking else UNENGAGED
        if self.level == ENGAGING:
            if is_near and is_looking:
                return ENGAGED
            return UNENGAGED if is_over else ENGAGING
        if self.level == ENGAGED:
            return DISENGAGING if is_over else ENGAGED
        if is_within and is_looking:
            return ENGAGED
        is_said = self._time - self._changed > zones.farewell
        return UNENGAGED if is_said else DISENGAGING
