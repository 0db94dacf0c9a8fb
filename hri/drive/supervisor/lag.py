"""How late a base reports: the motion it was told, compared in time with the motion it reports.

The comparison asks at which delay the told motion fits the reported motion best. It is blind to how
far the wheels turn (a worn wheel, a carpet or a ramp scales the motion and does not delay it), and
it says nothing where several delays fit: at constant speed, while the wheels are blocked, or slip.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections import deque
from collections.abc import Iterator

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


DELAYS = [number * STEP for number in range(round(LONGEST / STEP) + 1)]
"""Seconds; those that are tried."""


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
        self._told_squared = [0.0] * len(DELAYS)
        """The told motion times itself, by the delay at which it is compared; what was compared
        lately counts most."""
        self._products = [0.0] * len(DELAYS)
        """The told motion times the reported one."""
        self._reported_squared = 0.0
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
        left, right = reported
        self._reported_squared *= decay
        self._reported_squared += weight * (left * left + right * right)
        ways = zip(self._told_until(before), self._told_until(time), strict=True)
        for number, ((left_0, right_0), (left_1, right_1)) in enumerate(ways):
            told_left, told_right = left_1 - left_0, right_1 - right_0
            self._told_squared[number] *= decay
            self._told_squared[number] += weight * (told_left**2 + told_right**2)
            self._products[number] *= decay
            self._products[number] += weight * (told_left * left + told_right * right)

    def _found(self) -> float | None:
        if self._reported_squared < 2 * LEAST_MOTION**2 * MEMORY:
            return None
        missing = [
            _unexplained(told, both, self._reported_squared)
            for told, both in zip(self._told_squared, self._products, strict=True)
        ]
        best = min(range(len(missing)), key=missing.__getitem__)
        least = min(missing[: round(MOST_LAG / STEP) + 1])
        is_sure = missing[best] <= FIT and least >= max(MISFIT, CLEARLY * missing[best])
        return best * STEP if is_sure and best < len(missing) - 1 else None

    def _told_until(self, now: float) -> Iterator[Rims]:
        """What the wheels were told to roll until a time, and until each delay before; at rest
        before the first word."""
        times, told = self._told_at, self._told or [(0.0, 0.0)]
        index = len(times)
        for delay in DELAYS:
            time = now - delay
            index = bisect_left(times, time, 0, index)
            if index in (0, len(times)):
                yield told[max(0, index - 1)]
                continue
            start, end = times[index - 1], times[index]
            share = (time - start) / (end - start)
            (left, right), (far_left, far_right) = told[index - 1], told[index]
            yield left + share * (far_left - left), right + share * (far_right - right)

    def _rims(self, linear: float, angular: float) -> Rims:
        aside = self._half_track * angular
        return linear - aside, linear + aside


def _unexplained(told: float, both: float, reported: float) -> float:
    """Part of the reported motion, 0 to 1, that is not the told motion times some factor."""
    if told <= 0 or both <= 0:
        return 1.0
    return max(0.0, 1.0 - both**2 / (told * reported))
