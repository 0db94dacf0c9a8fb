"""What the counts of two wheel encoders tell: how far the base came, and how fast it goes."""

from __future__ import annotations

import math
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
    """Adds up counts, across overruns; a leap that no wheel can make is a new beginning.

    So counters that a reset of the base puts to 0 move nothing.
    """

    def __init__(self, encoders: Encoders) -> None:
        self._encoders = encoders
        half = encoders.track / 2
        self._wheels = WheelPair(half, -half)
        self._counts: tuple[int, int] | None = None
        self._ways = (0.0, 0.0)
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
            ways = self._steps(left, right)
            elapsed = max(0.0, now - self._history[-1][0]) + SLACK
            if max(map(abs, ways)) > HEADROOM * self._encoders.fastest * elapsed:
                self._history.clear()
            else:
                self._ways = self._ways[0] + ways[0], self._ways[1] + ways[1]
        self._counts = left, right
        self._remember(now)

    def _steps(self, left: int, right: int) -> tuple[float, float]:
        """Meters that both wheels rolled since the last counts."""
        assert self._counts is not None
        size = 1 << self._encoders.bits
        steps = (
            math.remainder(new - old, size) * self._encoders.meters_per_count
            for new, old in zip((left, right), self._counts, strict=True)
        )
        return next(steps), next(steps)

    def _remember(self, now: float) -> None:
        """Keep one value that is WINDOW old, and all since."""
        history = self._history
        if history and now < history[-1][0]:
            history.clear()
        history.append((now, *self._ways))
        while len(history) > 2 and history[1][0] <= now - WINDOW:
            history.popleft()
