"""Velocities that end before an obstacle: the custom behavior of the guide and its exercise.

Lengths in centimeters and velocities in cm/s, as the files of 2003 have them. A sensor that sends
nothing is ignored, as in 2003, by the exercise too: where that could hurt, put `Hri.CommandGate`
behind them, for which such a sensor sees an obstacle. A NaN reading counts as near.
"""

from __future__ import annotations

import math

from hri.behavior.behavior import Behavior
from hri.behavior.ports import LINEAR_VELOCITY, Input, InputPort, Output, Param


class StopCrash(Behavior):
    """Passes a velocity on, or 0, in both directions, while something is nearer than the limit."""

    keeps_inputs = False
    category = "sample_code"
    stop_limit = Param(60.0, "centimeters; a reading below it stops the robot", minimum=0)
    forward_velocity = Input[float]("double", "cm/s; only the first link counts", LINEAR_VELOCITY)
    range_sensor = Input[float]("double", "readings in centimeters, any count of links")
    velocity = Output[float]("double", "cm/s; 0 when no velocity comes in", LINEAR_VELOCITY)

    def compute(self, now: float, dt: float) -> None:
        velocity = _of_first_link(self.forward_velocity)
        self.velocity.send(velocity if _is_free(self.range_sensor, self.stop_limit) else 0.0)


class StopCrashSelective(Behavior):
    """Stops driving forward before obstacles in front, and backward before those behind."""

    keeps_inputs = False
    category = "sample_code"
    stop_limit = Param(60.0, "centimeters; a reading below it stops the robot", minimum=0)
    forward_velocity = Input[float]("double", "cm/s; only the first link counts", LINEAR_VELOCITY)
    front_sensor = Input[float]("double", "centimeters ahead, any count of links")
    rear_sensor = Input[float]("double", "centimeters behind, any count of links")
    velocity = Output[float]("double", "cm/s; 0 when no velocity comes in", LINEAR_VELOCITY)

    def compute(self, now: float, dt: float) -> None:
        velocity = _of_first_link(self.forward_velocity)
        sensors = self.front_sensor if velocity > 0 else self.rear_sensor
        self.velocity.send(velocity if _is_free(sensors, self.stop_limit) else 0.0)


def _of_first_link(port: InputPort[float]) -> float:
    """What the first link carries, 0 when that is nothing or no number; the others do not count."""
    value = port.sources[0].value if port.sources else None
    return 0.0 if value is None or math.isnan(value) else value


def _is_free(sensors: InputPort[float], limit: float) -> bool:
    # Written this way, a NaN reading does not pass.
    return all(reading >= limit for reading in sensors.values)
