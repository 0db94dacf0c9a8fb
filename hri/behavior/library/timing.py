"""What depends on when: delays, memory, counts and limits with a memory."""

from __future__ import annotations

from collections import deque
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.effects import NOTHING
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import HriError

TOLERANCE = 1e-6
"""Seconds by which sums of tick times may be off."""


class Delay(Behavior):
    """Sends what came in, some time later; ticks without a value come later, too."""

    may_do = NOTHING
    delay_s = Param(1.0, "seconds", minimum=0, maximum=60)
    input = Input[Any]("any", "a value")
    delayed = Output[Any]("any", "the value of that time; the newest when several are due at once")

    def __init__(self, id: str = "", **parameters: Any) -> None:
        super().__init__(id, **parameters)
        self._waiting: deque[tuple[float, Any]] = deque()

    def compute(self, now: float, dt: float) -> None:
        if (value := self.input.value) is not None:
            self._waiting.append((now, value))
        while self._waiting and self._waiting[0][0] + self.delay_s <= now + TOLERANCE:
            self.delayed.send(self._waiting.popleft()[1])


class Latch(Behavior):
    """Keeps sending the last value that came in, until it is reset."""

    input = Input[Any]("any", "a value")
    reset = Input[bool]("boolean", "true forgets the value; goes before what comes in")
    latched = Output[Any]("any", "the last value; nothing before the first and after a reset")

    def compute(self, now: float, dt: float) -> None:
        if any(self.reset.values):
            self._value = None
        elif (value := self.input.value) is not None:
            self._value = value
        if self._value is not None:
            self.latched.send(self._value)

    _value: Any = None


class Threshold(Behavior):
    """Whether a number is high: true from the upper limit on, false from the lower one down.

    Between the limits it stays as it was, so that a noisy number does not make it flicker; at the
    start it is false. Nothing is sent when nothing comes in.
    """

    category = "operators"
    upper = Param(1.0, "becomes true at this number or above")
    lower = Param(0.5, "becomes false at this number or below")
    input = Input[float]("double", "a number")
    is_high = Output[bool]("boolean", "whether it is high")

    def check(self) -> None:
        if self.lower > self.upper:
            what = f"{self.id}: lower {self.lower:g} is above upper {self.upper:g}"
            raise HriError(f"{what} - swap them")

    def compute(self, now: float, dt: float) -> None:
        if (value := self.input.value) is not None:
            self._is_high = value >= self.upper or (self._is_high and value > self.lower)
            self.is_high.send(self._is_high)

    _is_high = False


class Counter(Behavior):
    """Counts how often its input becomes true; sends the count at every tick."""

    input = Input[bool]("boolean", "truths; any that is true counts, nothing is false")
    reset = Input[bool]("boolean", "true begins again at zero")
    count = Output[float]("double", "times it became true since the start or the last reset")

    def compute(self, now: float, dt: float) -> None:
        is_true = any(self.input.values)
        if is_true and not self._was_true:
            self._count += 1
        self._was_true = is_true
        if any(self.reset.values):
            self._count = 0
        self.count.send(float(self._count))

    _count = 0
    _was_true = False


class Timer(Behavior):
    """Sends, at every tick, for how long its input has been true without a break."""

    duration = Param(1.0, "seconds until it is over", minimum=0)
    input = Input[bool]("boolean", "truths; any that is true counts, nothing is false")
    elapsed = Output[float]("double", "seconds; 0 while the input is not true")
    is_over = Output[bool]("boolean", "true once it has been true for the duration")

    def compute(self, now: float, dt: float) -> None:
        if not any(self.input.values):
            self._since = None
        elif self._since is None:
            self._since = now
        elapsed = 0.0 if self._since is None else now - self._since
        self.elapsed.send(elapsed)
        self.is_over.send(self._since is not None and elapsed >= self.duration - TOLERANCE)

    _since: float | None = None
