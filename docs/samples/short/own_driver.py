"""Write a driver: a range sensor that asks your hardware."""

from hri import Robot
from hri.core import FakeClock, RangeReading
from hri.hal import Description, RangeSensor


class Ruler(RangeSensor):
    """Always sees something 20 cm ahead."""

    is_hardware = False  # so that it may run on simulated time

    def read(self, now: float) -> RangeReading:
        return RangeReading(self.id, 0.2, now)


robot = Robot(config="simulated", clock=FakeClock())
robot.resources.substitute(
    "range_front", Ruler(Description("range_front", "My.Ruler"), robot.resources)
)
with robot:
    print(f"traveled {robot.move(1.0):.2f} m")
