from pathlib import Path

from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.robot import Robot
from hri.speech.recognizers.typed import TypedRecognizer
from hri.testing import live_for


def test_it_answers_and_counts():
    typed = Description("recognizer", "Hri.Typed")
    folder = str(Path(__file__).parent)
    robot = Robot(folder, "simulated", clock=FakeClock(), devices=[typed])
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    robot.clock.call_at(1.0, lambda: keyboard.type_line("hello", 1.0))
    robot.clock.call_at(4.0, lambda: keyboard.type_line("count to two", 4.0))
    events = live_for(robot, 10.0, *robot.app.load_tasks())
    said = [event.properties["text"] for event in events if event.name == "speech.said"]
    assert said == ["Hello, I am thing.", "1", "2"]
