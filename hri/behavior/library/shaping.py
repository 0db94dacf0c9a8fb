"""A number made fit for use: limited, scaled, smoothed. Nothing comes out when nothing comes in."""

from __future__ import annotations

import math

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import HriError


class Clamp(Behavior):
    """Keeps a number within limits."""

    category = "operators"
    minimum = Param(0.0, "the least that is sent")
    maximum = Param(1.0, "the most that is sent")
    input = Input[float]("double", "a number")
    clamped = Output[float]("double", "the number, or the limit it exceeds")

    def check(self) -> None:
        if self.minimum > self.maximum:
            what = f"{self.id}: minimum {self.minimum:g} is above maximum {self.maximum:g}"
            raise HriError(f"{what} - swap them")

    def compute(self, now: float, dt: float) -> None:
        if (value := self.input.value) is not None:
            self.clamped.send(min(self.maximum, max(self.minimum, value)))


class Scale(Behavior):
    """A number times a factor, plus an offset: from one unit to another."""

    category = "operators"
    factor = Param(1.0, "what it is multiplied with")
    offset = Param(0.0, "what is added then")
    input = Input[float]("double", "a number")
    scaled = Output[float]("double", "input * factor + offset")

    def compute(self, now: float, dt: float) -> None:
        if (value := self.input.value) is not None:
            self.scaled.send(value * self.factor + self.offset)


class Deadband(Behavior):
    """Takes the jitter around zero away: zero within the band, the rest moved towards zero."""

    category = "operators"
    width = Param(0.1, "half the width of the band", minimum=0)
    input = Input[float]("double", "a number")
    output = Output[float]("double", "without a jump: zero at the edge of the band")

    def compute(self, now: float, dt: float) -> None:
        if (value := self.input.value) is not None:
            self.output.send(deadband(value, self.width))


def deadband(value: float, width: float) -> float:
    """Zero within +-width; beyond it, what exceeds the band."""
    return math.copysign(max(0.0, abs(value) - width), value)


class Smooth(Behavior):
    """Follows a number slowly: after one time constant 63 % of a step are done.

    y += (x - y) (1 - exp(-dt / time_constant)), the closed form of a first-order low pass for a
    step: how often it ticks makes no difference. The first number passes as it is. What is not
    finite passes too, and smoothing begins anew.
    """

    category = "operators"
    time_constant = Param(0.5, "seconds; 0 passes all as it is", minimum=0)
    input = Input[float]("double", "a number")
    smoothed = Output[float]("double", "the number, without haste")

    def compute(self, now: float, dt: float) -> None:
        value = self.input.value
        if value is None:
            return
        if self._last is not None and math.isfinite(value) and self.time_constant > 0:
            share = -math.expm1((self._time - now) / self.time_constant)
            value = self._last + (value - self._last) * share
        self._last = value if math.isfinite(value) else None
        self._time = now
        self.smoothed.send(value)

    _last: float | None = None
    _time = 0.0


class RateLimit(Behavior):
    """Lets a number change no faster than allowed; after a tick without one it starts anew."""

    category = "operators"
    rising = Param(1.0, "most that is added in a second", minimum=0)
    falling = Param(1.0, "most that is taken away in a second", minimum=0)
    input = Input[float]("double", "a number; the first passes as it is")
    limited = Output[float]("double", "the number, on its way")

    def compute(self, now: float, dt: float) -> None:
        value, last = self.input.value, self._last
        if value is not None:
            if last is not None:
                value = min(last + self.rising * dt, max(last - self.falling * dt, value))
            self.limited.send(value)
        self._last = value

    _last: float | None = None
