from pathlib import Path

from hri.core import FakeClock
from hri.hal import Description
from hri.robot import Robot
from hri.speech.recognizers.typed import TypedRecognizer
from hri.testing import live_for


def test_it_keeps_time_and_says_a_fortune():
    devices = [Description("recognizer", "Hri.Typed"), Description("camera", "Hri.BlankCamera")]
    folder = str(Path(__file__).parent)
    robot = Robot(folder, "simulated", clock=FakeClock(), devices=devices)
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    robot.clock.call_at(1.0, lambda: keyboard.type_line("set a timer for five seconds", 1.0))
    robot.clock.call_at(4.0, lambda: keyboard.type_line("tell my fortune", 4.0))
    events = live_for(robot, 9.0, *robot.app.load_tasks())
    said = [event.properties["text"] for event in events if event.name == "speech.said"]
    fortune = "You will soon speak to a robot."
    assert said == ["Okay, I'll let you know.", fortune, "5 seconds are over."]
