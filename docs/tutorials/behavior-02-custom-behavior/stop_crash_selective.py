"""The exercise: obstacles in front and behind are told apart."""

from hri.behavior import Behavior
from hri.behavior.ports import LINEAR_VELOCITY, Input, Output, Param


class StopCrashSelective(Behavior):
    """Passes a velocity on, or 0 when it leads nearer to something that is near."""

    category = "sample_code"
    stop_limit = Param(60.0, "centimeters; a reading below it stops the robot", minimum=0)
    forward_velocity = Input[float]("double", "cm/s", LINEAR_VELOCITY)
    front_sensor = Input[float]("double", "centimeters ahead")
    rear_sensor = Input[float]("double", "centimeters behind")
    velocity = Output[float]("double", "cm/s", LINEAR_VELOCITY)

    def compute(self, now: float, dt: float) -> None:
        velocity = self.forward_velocity.value or 0.0
        sensors = self.front_sensor if velocity > 0 else self.rear_sensor
        is_near = any(reading < self.stop_limit for reading in sensors.values)
        self.velocity.send(0.0 if is_near else velocity)
