"""Look surprised while something is near."""

from hri import Robot
from hri.core import FakeClock
from hri.hal import RangeSensor

with Robot(config="simulated", clock=FakeClock()) as robot:
    front = robot.resources.obtain("range_front", RangeSensor)
    robot.visitor.go(0.7, 0.0)
    for _ in range(8):
        distance = front.read(robot.clock.now()).distance  # meters
        print(f"{distance:.2f} m")
        robot.show("surprised" if distance < 1 else "happy", seconds=1)
        robot.wait(0.5)
