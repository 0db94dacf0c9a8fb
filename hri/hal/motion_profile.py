"""Motion profiles and braking as pure arithmetic: speed up, cruise and slow down evenly."""

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


def stopping_speed(
    gap: float, reaction: float, deceleration: float, approach: float = 0.0
) -> float:
    """The speed, m/s, from which a base stands before what comes has crossed the gap, meters.

    `reaction` is in seconds, `approach` is how fast it comes: 0 for what stands. Solves
    u (r + v / a) + v r + v² / 2a = gap for v, with approach u, reaction r, and deceleration a. A
    gap that is NaN counts as none.
    """
    left = gap - approach * reaction
    if left == math.inf:
        return math.inf
    if not left > 0:
        return 0.0
    half = approach + deceleration * reaction
    return math.sqrt(half * half + 2 * deceleration * left) - half


def velocity_for(remaining: float, max_velocity: float, deceleration: float, dt: float) -> float:
    """The velocity for the next `dt` seconds on the way to a goal, meters or radians a second.

    `remaining` is signed: what is still to go. The velocity depends on where things are now, not on
    a plan made at the start, so a push or a slow base is made up for. Speeding up evenly is the
    supervisor's part. NaN gives NaN, which the supervisor refuses.
    """
    if math.isnan(remaining):
        return remaining
    # Going on for dt seconds and only then slowing down must still end at the goal.
    speed = min(stopping_speed(abs(remaining), dt, deceleration), max_velocity)
    return math.copysign(speed, remaining)


def toward(value: float, goal: float, change: float) -> float:
    """One step from a value to a goal, by at most `change`."""
    return min(goal, value + change) if value < goal else max(goal, value - change)
