"""Follow a person and keep facing them."""

from hri import Robot
from hri.core import FakeClock
from hri.drive import follow
from hri.hal import Odometry

with Robot(config="simulated", clock=FakeClock()) as robot:
    robot.visitor.go(1.5, 1.0, after=3)
    robot.run(follow, "", 1.2, 12)  # whoever is seen, meters apart, seconds
    print(robot.resources.obtain("odometry", Odometry).pose(robot.clock.now()))
