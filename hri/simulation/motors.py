"""Simulated motors: each turns one wheel of the base, the one at its own y."""

from __future__ import annotations

import math
from typing import ClassVar

from hri.hal.motor import Motor
from hri.hal.resource import Description
from hri.simulation.in_world import InWorld

POSITION_FACTOR = 1711.0
"""Counts of the encoder for each centimeter the wheel rolls; negative for a motor that is mounted
the other way round."""
POWER_OUTPUT = (45.0, 0.0, 100.0)
"""Default, least and most, percent."""


class SimulatedMotor(InWorld, Motor):
    """A wheel motor with an encoder.

    Its parameters are those of the motors of 2003. `position_factor` gives the counts for each
    centimeter; `power_output` is the most power it uses, percent; `address` and `cycle_time` change
    nothing here.
    """

    parameters: ClassVar[tuple[str, ...]] = (
        "address",
        "power_output",
        "position_factor",
        "cycle_time",
    )

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        description.number_within("power_output", *POWER_OUTPUT)
        description.number("cycle_time", 0.0)
        if description.number("position_factor", POSITION_FACTOR) == 0:
            what = "position_factor is 0"
            raise description.error("position_factor", what, "write counts for each centimeter")
        if description.pose.y == 0:
            what = f"{description.id} has no y"
            raise description.error("y", what, "say how far to the left its wheel is, in cm")

    def _open(self) -> None:
        super()._open()
        self._y = self.manager.pose_of(self.id).y
        factor = self.description.number("position_factor", POSITION_FACTOR)
        self._counts_a_meter = factor * 100
        limits = self.world.base.limits
        self.max_velocity, self.max_acceleration = limits.linear, limits.acceleration
        self.world.axle.mount(self._y)
        self._start = self.world.rolled(self._y, self.manager.clock.now())

    def _close(self) -> None:
        now = self.manager.clock.now()
        self.world.brake_wheel(self._y, now)
        self.set_power(0.0, now)

    def set_velocity(self, velocity: float, now: float) -> None:
        self.world.roll_wheel(self._y, velocity if math.isfinite(velocity) else 0.0, now)

    def stop(self, now: float) -> None:
        self.world.brake_wheel(self._y, now)

    def set_power(self, percent: float, now: float) -> None:
        most = self.description.number_within("power_output", *POWER_OUTPUT)
        self.world.axle.power(self._y, min(percent, most) > 0)

    def counts(self, now: float) -> int:
        """What the encoder has counted since it was switched on."""
        way = self.world.rolled(self._y, now) - self._start
        return round(way * self._counts_a_meter)

    def position(self, now: float) -> float:
        return self.counts(now) / self._counts_a_meter

    def velocity(self, now: float) -> float:
        return self.world.wheel_velocity(self._y, now)
