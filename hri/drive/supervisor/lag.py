"""How late a base reports: the motion it was told, compared in time with the motion it reports.

The comparison asks at which delay the told motion fits the reported motion best. It is blind to how
far the wheels turn (a worn wheel, a carpet or a ramp scales the motion and does not delay it), and
it says nothing where several delays fit: at constant speed, while the wheels are blocked, or slip.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections import deque
from dataclasses import dataclass

from hri.core.signals import Twist
from hri.hal.drive import PATIENCE
from hri.hal.motion import Way

MOST_LAG = PATIENCE
"""Seconds from a told velocity to the report of the motion, with what the motors need."""
LONGEST = 1.2
"""Seconds; the largest delay that is tried. Wheels that show nothing for that long do not turn."""
STEP = 0.05
"""Seconds between two delays that are tried."""
WINDOW = 0.1
"""Seconds over which a motion is compared; single counts of an encoder do not matter then."""
EVERY = 0.03
"""Seconds between two comparisons."""
MEMORY = 1.0
"""Seconds after which a comparison counts for a third."""
LEAST_MOTION = 0.05
"""Meters a second over MEMORY; less motion shows no delay."""
FIT = 0.01
"""Part of the reported motion that the best delay may leave unexplained."""
MISFIT = 0.02
"""Part that each delay up to MOST_LAG must leave unexplained before a larger one is believed, and
at least CLEARLY times what the larger one leaves."""
CLEARLY = 4.0
IN_A_ROW = 4
"""Comparisons that must agree."""

Rims = tuple[float, float]
"""Meters, or meters a second, of the left and the right wheel."""


@dataclass(slots=True)
class _Fit:
    """How well the told motion fits the reported motion at one delay."""

    told: float = 0.0
    both: float = 0.0

    def add(self, told: Rims, reported: Rims, weight: float, decay: float) -> None:
        self.told = decay * self.told + weight * _product(told, told)
        self.both = decay * self.both + weight * _product(told, reported)

    def unexplained(self, reported: float) -> float:
        """Part of the reported motion, 0 to 1, that is not the told motion times some factor."""
        if self.told <= 0 or self.both <= 0:
            return 1.0
        return max(0.0, 1.0 - self.both**2 / (self.told * reported))


class Lag:
    """Follows the motion one base is told and the motion it reports."""

    def __init__(self, half_track: float) -> None:
        """Half the way between the wheels, meters."""
        self._half_track = half_track
        self.forget()

    def forget(self) -> None:
        """Begin again: nobody watched for a while, or what was found has been said."""
        self._told_at: list[float] = []
        self._told: list[Rims] = []
        """Meters that the wheels were told to roll until these times."""
        self._forget_reports()

    def _forget_reports(self) -> None:
        self._heard: deque[tuple[float, Rims]] = deque()
        """What the wheels have rolled until these times, over the last WINDOW."""
        self._fits = [_Fit() for _ in range(round(LONGEST / STEP) + 1)]
        self._reported = 0.0
        self._compared = -math.inf
        self._in_a_row = 0

    def tell(self, now: float, twist: Twist) -> None:
        """The wheels were told this velocity until now; call it at each turn."""
        if not self._told_at:
            self._told_at, self._told = [now], [(0.0, 0.0)]
            return
        dt, (left, right) = now - self._told_at[-1], self._told[-1]
        if dt <= 0:
            return
        rims = self._rims(twist.linear, twist.angular)
        self._told_at.append(now)
        self._told.append((left + rims[0] * dt, right + rims[1] * dt))
        if self._told_at[0] < now - 2 * (LONGEST + WINDOW):
            del self._told_at[: len(self._told_at) // 2], self._told[: len(self._told) // 2]

    def hear(self, time: float, rolled: Way) -> float | None:
        """How late this report of what the wheels rolled is, seconds; None unless it is surely
        later than MOST_LAG."""
        ways = self._rims(rolled.linear, rolled.angular)
        if not all(map(math.isfinite, ways)):
            return None
        if self._heard and not 0 <= time - self._heard[-1][0] <= WINDOW:
            self._forget_reports()  # from then on the delay may be another one
        self._heard.append((time, ways))
        while len(self._heard) > 2 and self._heard[1][0] <= time - WINDOW:
            self._heard.popleft()
        before, since = self._heard[0]
        if time - self._compared < EVERY or time - before < WINDOW:
            return None
        self._compare(before, time, (ways[0] - since[0], ways[1] - since[1]))
        lag = self._found()
        self._in_a_row = 0 if lag is None else self._in_a_row + 1
        return lag if self._in_a_row >= IN_A_ROW else None

    def _compare(self, before: float, time: float, reported: Rims) -> None:
        elapsed = min(EVERY * 2, time - self._compared)
        decay, weight = math.exp(-elapsed / MEMORY), elapsed / (time - before) ** 2
        self._compared = time
        self._reported = decay * self._reported + weight * _product(reported, reported)
        for number, fit in enumerate(self._fits):
            end, start = self._way_at(time - number * STEP), self._way_at(before - number * STEP)
            fit.add((end[0] - start[0], end[1] - start[1]), reported, weight, decay)

    def _found(self) -> float | None:
        if self._reported < 2 * LEAST_MOTION**2 * MEMORY:
            return None
        missing = [fit.unexplained(self._reported) for fit in self._fits]
        best = min(range(len(missing)), key=missing.__getitem__)
        least = min(missing[: round(MOST_LAG / STEP) + 1])
        is_sure = missing[best] <= FIT and least >= max(MISFIT, CLEARLY * missing[best])
        return best * STEP if is_sure and best < len(missing) - 1 else None

    def _way_at(self, time: float) -> Rims:
        """What the wheels were told to roll until a time; at rest before the first word."""
        index = bisect_left(self._told_at, time)
        if index == 0:
            return self._told[0] if self._told else (0.0, 0.0)
        if index == len(self._told_at):
            return self._told[-1]
        start, end = self._told_at[index - 1], self._told_at[index]
        share = (time - start) / (end - start)
        (left, right), (far_left, far_right) = self._told[index - 1], self._told[index]
        return left + share * (far_left - left), right + share * (far_right - right)

    def _rims(self, linear: float, angular: float) -> Rims:
        aside = self._half_track * angular
        return linear - aside, linear + aside


def _product(one: Rims, other: Rims) -> float:
    return one[0] * other[0] + one[1] * other[1]
