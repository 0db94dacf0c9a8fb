"""A number made fit for use: limited, scaled, smoothed. Nothing comes out when nothing comes in.

NaN is not treated as a number. The largest double stands for infinity: it is how
a port of 2003 says that nothing is in range.
"""

from __future__ import annotations

import math

from hri.behavior.behavior import Behavior
from hri.behavior.library.arithmetic import send_number
from hri.behavior.ports import DBL_MAX, Input, InputPort, Output, Param
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
        if (value := _number(self.input)) is not None:
            self.clamped.send(min(self.maximum, max(self.minimum, value)))


class Scale(Behavior):
    """A number times a factor, plus an offset: from one unit to another."""

    category = "operators"
    factor = Param(1.0, "what it is multiplied with")
    offset = Param(0.0, "what is added then")
    input = Input[float]("double", "a number")
    scaled = Output[float]("double", "input * factor + offset")

    def compute(self, now: float, dt: float) -> None:
        if (value := _number(self.input)) is not None:
            value = math.copysign(math.inf, value) if _is_unbounded(value) else value
            send_number(self.scaled, value * self.factor + self.offset)


class Deadband(Behavior):
    """Takes the jitter around zero away: zero within the band, the rest moved towards zero."""

    category = "operators"
    width = Param(0.1, "half the width of the band", minimum=0)
    input = Input[float]("double", "a number")
    output = Output[float]("double", "without a jump: zero at the edge of the band")

    def compute(self, now: float, dt: float) -> None:
        if (value := _number(self.input)) is not None:
            self.output.send(deadband(value, self.width))


def deadband(value: float, width: float) -> float:
    """Zero within +-width; beyond it, what exceeds the band."""
    return math.copysign(max(0.0, abs(value) - width), value)


class Smooth(Behavior):
    """Follows a number slowly: after one time constant 63 % of a step are done.

    y += (x - y) (1 - exp(-dt / time_constant)), the closed form of a first-order low pass for a
    step: how often it ticks makes no difference. The first number passes as it is. Infinity passes
    too, and smoothing begins again, so that it hides no obstacle that comes into range.
    """

    category = "operators"
    time_constant = Param(0.5, "seconds; 0 passes all as it is", minimum=0)
    input = Input[float]("double", "a number")
    smoothed = Output[float]("double", "the number, without haste")

    def compute(self, now: float, dt: float) -> None:
        value = _number(self.input)
        if value is None:
            return
        if self._last is not None and not _is_unbounded(value) and self.time_constant > 0:
            # A clock that was set back must not make it run away.
            share = -math.expm1(min(self._time - now, 0.0) / self.time_constant)
            value = self._last * (1 - share) + value * share
        self._last = None if _is_unbounded(value) else value
        self._time = now
        self.smoothed.send(value)

    _last: float | None = None
    _time = 0.0


class RateLimit(Behavior):
    """Lets a number change no faster than allowed; after a tick without one it starts again.

    So it does with infinity, which passes as it is: it hides no obstacle that comes into range.
    """

    category = "operators"
    rising = Param(1.0, "most that is added in a second", minimum=0)
    falling = Param(1.0, "most that is taken away in a second", minimum=0)
    input = Input[float]("double", "a number; the first passes as it is")
    limited = Output[float]("double", "the number, on its way")

    def compute(self, now: float, dt: float) -> None:
        value, last = _number(self.input), self._last
        self._last = None
        if value is None:
            return
        if not _is_unbounded(value):
            if last is not None:
                # The value first: infinity times a dt of 0 then limits nothing.
                value = min(max(value, last - self.falling * dt), last + self.rising * dt)
            self._last = value
        self.limited.send(value)

    _last: float | None = None


def _number(port: InputPort[float]) -> float | None:
    """What comes in, None when that is nothing or no number."""
    value = port.value
    return None if value is None or math.isnan(value) else value


def _is_unbounded(value: float) -> bool:
    return abs(value) >= DBL_MAX
