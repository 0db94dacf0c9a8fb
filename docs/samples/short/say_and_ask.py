"""Say something, and ask something: yes, no, a nod or a shake of the head is an answer."""

from hri import Robot
from hri.core import FakeClock

with Robot(config="simulated", clock=FakeClock()) as robot:
    robot.events.subscribe("question.asked", lambda event: robot.visitor.nod(after=1))
    robot.say("Hello.")
    answer = robot.ask("Do you like music?")
    print("yes" if answer else "no" if answer is False else "no answer")
    robot.say("So do I." if answer else "What a pity.")
