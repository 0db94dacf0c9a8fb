"""Do something when a button is pressed; here it is the bumper."""

from hri import Robot
from hri.core import FakeClock

with Robot(config="simulated", clock=FakeClock()) as robot:
    robot.on("speech.said", lambda event: print(event.properties["text"]))
    robot.on("bumper.pressed", lambda event: robot.say("Ouch!"))
    robot.visitor.bump(after=1)
    robot.wait(3)
