"""Motion profiles as pure arithmetic: speed up evenly, cruise, slow down evenly, stand."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Trapezoid:
    """A way from rest to rest: meters or radians, seconds.

    Where the way is too short to reach the velocity, the trapezoid is a triangle.
    """

    distance: float
    """With its sign."""
    velocity: float
    """Never exceeded; above 0."""
    acceleration: float
    """Of both ends; above 0."""

    @property
    def peak(self) -> float:
        """The velocity that is reached: v, or sqrt(a |d|) of a triangle."""
        return min(self.velocity, math.sqrt(self.acceleration * abs(self.distance)))

    @property
    def duration(self) -> float:
        """Seconds from rest to rest: v/a + |d|/v, or 2 sqrt(|d|/a) of a triangle."""
        peak = self.peak
        return peak / self.acceleration + abs(self.distance) / peak if peak > 0 else 0.0

    def position(self, time: float) -> float:
        """The way covered `time` seconds after the start; the ends hold before and after."""
        if time <= 0:
            return 0.0
        if time >= self.duration:
            return self.distance
        ramp = self.peak / self.acceleration
        if time < ramp:
            covered = self.acceleration * time**2 / 2
        elif time < self.duration - ramp:
            covered = self.peak * (time - ramp / 2)
        else:
            covered = abs(self.distance) - self.acceleration * (self.duration - time) ** 2 / 2
        return math.copysign(covered, self.distance)


def toward(value: float, goal: float, change: float) -> float:
    """One step from a value to a goal, by at most `change`."""
    return min(goal, value + change) if value < goal else max(goal, value - change)
