"""A drive system that runs whole motions: drivers of a base say only how to send and measure."""

from __future__ import annotations

import math
from typing import ClassVar

from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.hal.drive import Stop, longest_move, too_long
from hri.hal.motion import Brake, MoveDelta, Ramp, SlowDown, TurnDelta
from hri.hal.motion_profile import Trapezoid
from hri.hal.pending import Pending, completed
from hri.hal.resource import Description
from hri.hal.steered_base import FULL_POWER, SteeredBase

SMOOTH = Twist(0.4, 1.6)
"""How fast a smooth stop slows down: m/s² and rad/s²."""
_HEADROOM = 0.8
"""Share of the greatest acceleration that motions plan with; the rest is left to catch up with."""


class MovingBase(SteeredBase):
    """Base of the drivers; they fill in what `SteeredBase` names."""

    parameters: ClassVar[tuple[str, ...]] = ("longest_move",)

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        longest_move(description)

    # --- power ---

    def set_idle_power(self, percent: float) -> Pending[None]:
        _within(percent, "idle power", least=0.0)
        with self._chassis.lock:
            self._refuse_closed()
            self._idle_power = percent
            if self._chassis.run is None:
                self._set_power(percent, self.manager.clock.now())
        return completed(self.manager.clock, None)

    def set_move_power(self, percent: float) -> Pending[None]:
        _within(percent, "move power", least=1.0)
        with self._chassis.lock:
            self._refuse_closed()
            self._move_power = percent
        return completed(self.manager.clock, None)

    # --- motions ---

    def move_delta(self, distance: float, velocity: float, acceleration: float) -> Pending[None]:
        _finite(distance, "distance", "meters")
        self._refuse_too_long(distance)
        _positive(velocity, "velocity", "m/s")
        _positive(acceleration, "acceleration", "m/s²")
        velocity = min(velocity, self.max_linear)
        acceleration = min(acceleration, self._limits.linear)
        self._refuse_while_stopping()
        return self._begin(MoveDelta(Trapezoid(distance, velocity, acceleration)))

    def turn_delta(self, angle: float, velocity: float, acceleration: float) -> Pending[None]:
        _finite(angle, "angle", "radians")
        _positive(velocity, "velocity", "rad/s")
        _positive(acceleration, "acceleration", "rad/s²")
        velocity = min(velocity, self.max_angular)
        acceleration = min(acceleration, self._limits.angular)
        self._refuse_while_stopping()
        return self._begin(TurnDelta(Trapezoid(angle, velocity, acceleration)))

    def move_and_turn(
        self,
        linear: float,
        linear_acceleration: float,
        angular: float,
        angular_acceleration: float,
    ) -> None:
        _finite(linear, "linear velocity", "m/s")
        _finite(angular, "angular velocity", "rad/s")
        _positive(linear_acceleration, "linear acceleration", "m/s²")
        _positive(angular_acceleration, "angular acceleration", "rad/s²")
        goal = Twist(_cut(linear, self.max_linear), _cut(angular, self.max_angular))
        acceleration = _slower(Twist(linear_acceleration, angular_acceleration), self._limits)
        self._refuse_while_stopping()
        begun = self._begin(Ramp(self._velocity(self.manager.clock.now()), goal, acceleration))
        if begun.is_done:
            begun.result()  # nobody else would be told why it ended at once

    def halt(self, how: Stop = Stop.SMOOTH) -> Pending[None]:
        with self._stopping():
            self._chassis.helm.let_go()
            if how is Stop.ABRUPT:
                return self._begin(Brake())
            start = self._velocity(self.manager.clock.now())
            return self._begin(SlowDown(start, _slower(SMOOTH, self._limits)))

    def _refuse_too_long(self, distance: float) -> None:
        if abs(distance) > (longest := self.longest_move):
            remedy = (
                f"if you meant {distance:g} cm, give {distance / 100:g} or use "
                f'obtain("{self.id}", "IDriveSystem"), the interface of 2003'
            )
            raise too_long(self.id, f"{distance:g} m", longest, remedy)

    @property
    def _limits(self) -> Twist:
        """The accelerations that motions may plan with, m/s² and rad/s²."""
        share = _HEADROOM * self._move_power / FULL_POWER
        return Twist(self.max_acceleration * share, self.max_angular_acceleration * share)


def _cut(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))


def _slower(one: Twist, other: Twist) -> Twist:
    return Twist(min(one.linear, other.linear), min(one.angular, other.angular))


def _finite(value: float, name: str, unit: str) -> None:
    if not math.isfinite(value):
        raise HriError(f"the {name} is {value} - give a finite number of {unit}")


def _positive(value: float, name: str, unit: str) -> None:
    if not (math.isfinite(value) and value > 0):
        raise HriError(f"the {name} is {value} - give {unit} above 0")


def _within(percent: float, name: str, least: float) -> None:
    if not least <= percent <= FULL_POWER:
        raise HriError(f"the {name} is {percent} - give a percentage from {least:g} to 100")
