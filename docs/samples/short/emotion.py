"""Let the robot feel something, and ask it why."""

from hri import Robot
from hri.core import FakeClock

with Robot(config="simulated", clock=FakeClock()) as robot:
    robot.feel("praise")
    robot.wait(1)
    print(robot.why())
