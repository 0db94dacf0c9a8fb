"""What the counts of two wheel encoders tell: how far the base came, and how fast it goes."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from hri.core.signals import Twist
from hri.hal.motion import Way
from hri.hal.wheels import WheelPair

WINDOW = 0.1
"""Seconds over which a velocity is measured: several reports, since each comes a little early or
late, and a few counts even when the base creeps."""
SLACK = 0.1
"""Seconds that the reports before and after a way may have come off their time."""
HEADROOM = 1.5
"""How many times faster than its fastest a wheel may turn, pushed or downhill."""
AT_ZERO = 0.005
"""Meters from 0 within which counters that restarted are first read, beside what the wheels may
have rolled since the last report."""
REBOOT = 0.3
"""Seconds without a report in which a base may have restarted, unseen; it does not drive then."""
COASTED = 0.03
"""Meters from 0 within which its counters are then."""


@dataclass(frozen=True, slots=True)
class Encoders:
    """The encoders of two wheels."""

    meters_per_count: float
    track: float
    """Meters between the wheels."""
    bits: int
    """Of the counters, which run over."""
    fastest: float
    """Of a wheel's rim, m/s."""


class Odometer:
    """Adds up counts, across overruns, never faster than wheels can roll.

    Reports come late and in bursts, so what was rolled too fast for the time since the last report
    counts with the next ones. A leap that SLACK does not explain moves nothing, and neither do
    counters that restart at 0, as after a reset of the base.
    """

    def __init__(self, encoders: Encoders) -> None:
        self._encoders = encoders
        half = encoders.track / 2
        self._wheels = WheelPair(half, -half)
        self._counts: tuple[int, int] | None = None
        self._ways = (0.0, 0.0)
        self._owed = (0.0, 0.0)
        """Meters that the counts show beyond `_ways`."""
        self._time = 0.0
        """Of the last counts."""
        self._history: deque[tuple[float, float, float]] = deque(maxlen=64)

    @property
    def rolled(self) -> Way:
        """How far the base came since the beginning."""
        twist = self._wheels.base(*self._ways)
        return Way(twist.linear, twist.angular)

    @property
    def velocity(self) -> Twist | None:
        """Over the last WINDOW; None before there is one."""
        if len(self._history) < 2:
            return None
        (began, *before), (now, *after) = self._history[0], self._history[-1]
        if now <= began:
            return None
        left, right = (
            (end - start) / (now - began) for start, end in zip(before, after, strict=True)
        )
        return self._wheels.base(left, right)

    def add(self, left: int, right: int, now: float) -> None:
        """What the counters show at a time, in seconds."""
        if self._counts is not None:
            self._roll((left, right), self._counts, max(0.0, now - self._time))
        self._counts, self._time = (left, right), now
        self._remember(now)

    def _roll(self, new: tuple[int, int], old: tuple[int, int], elapsed: float) -> None:
        """Take the way between two counts, or as much of it as wheels can roll in that time."""
        fastest = HEADROOM * self._encoders.fastest
        steps = self._meters(new[0] - old[0], new[1] - old[1])
        owed = self._owed[0] + steps[0], self._owed[1] + steps[1]
        if self._has_restarted(new, old, elapsed):
            self._owed = 0.0, 0.0
            self._history.clear()
        elif _longer(owed) > fastest * (elapsed + SLACK):
            self._history.clear()
        else:
            self._owed = owed
        way = _longer(self._owed)
        share = min(1.0, fastest * elapsed / way) if way else 0.0
        left, right = self._owed[0] * share, self._owed[1] * share
        self._ways = self._ways[0] + left, self._ways[1] + right
        self._owed = self._owed[0] - left, self._owed[1] - right

    def _has_restarted(self, new: tuple[int, int], old: tuple[int, int], elapsed: float) -> bool:
        """Whether the counters began at 0 since: what they show then is short, and the way back
        there was too far for the time, or nobody saw it."""
        fastest = HEADROOM * self._encoders.fastest
        here, there = _longer(self._meters(*new)), _longer(self._meters(*old))
        step = _longer(self._meters(new[0] - old[0], new[1] - old[1]))
        if here >= there or not elapsed:
            return False
        if elapsed > REBOOT:
            return here <= COASTED and here < step
        return step > fastest * elapsed and here <= fastest * elapsed + AT_ZERO

    def _meters(self, left: int, right: int) -> tuple[float, float]:
        """Ways of both wheels for counts, or for differences of counts."""
        half, meters = 1 << self._encoders.bits - 1, self._encoders.meters_per_count
        signed = ((count + half) % (2 * half) - half for count in (left, right))
        return next(signed) * meters, next(signed) * meters

    def _remember(self, now: float) -> None:
        """Keep one value that is WINDOW old, and all since."""
        history = self._history
        if history and now < history[-1][0]:
            history.clear()
        history.append((now, *self._ways))
        while len(history) > 2 and history[1][0] <= now - WINDOW:
            history.popleft()


def _longer(ways: tuple[float, float]) -> float:
    return max(map(abs, ways))
