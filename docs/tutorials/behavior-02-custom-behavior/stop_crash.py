"""A custom behavior: stops the robot before it runs into something."""

from hri.behavior import Behavior
from hri.behavior.ports import LINEAR_VELOCITY, Input, Output, Param


class StopCrashBehavior(Behavior):
    """Passes a velocity on, or 0 while something is nearer than the limit."""

    category = "sample_code"
    stop_limit = Param(60.0, "centimeters; a reading below it stops the robot", minimum=0)
    forward_velocity = Input[float]("double", "cm/s", LINEAR_VELOCITY)
    range_sensor = Input[float]("double", "centimeters, from as many sensors as there are")
    velocity = Output[float]("double", "cm/s", LINEAR_VELOCITY)

    def compute(self, now: float, dt: float) -> None:
        velocity = 0.0
        if self.forward_velocity.sources:
            velocity = self.forward_velocity.sources[0].value or 0.0
        if any(reading < self.stop_limit for reading in self.range_sensor.values):
            velocity = 0.0
        self.velocity.send(velocity)
