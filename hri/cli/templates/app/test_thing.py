from pathlib import Path

from hri.core import FakeClock
from hri.hal import Description
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.speech.recognizers.typed import TypedRecognizer
from hri.testing import live_for


def test_it_answers_counts_asks_and_backs_off():
    typed = Description("recognizer", "Hri.Typed")
    folder = str(Path(__file__).parent)
    robot = Robot(folder, "simulated", clock=FakeClock(), devices=[typed])
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    world = robot.resources.obtain("world", SimulatedWorld)
    robot.clock.call_at(1.0, lambda: keyboard.type_line("hello", 1.0))
    robot.clock.call_at(4.0, lambda: keyboard.type_line("count to two", 4.0))
    robot.clock.call_at(10.0, lambda: keyboard.type_line("goodbye", 10.0))
    robot.clock.call_at(13.0, lambda: keyboard.type_line("yes please", 13.0))
    events = live_for(robot, 20.0, *robot.app.load_tasks())
    said = [event.properties["text"] for event in events if event.name == "speech.said"]
    assert said == ["Hello, I am thing.", "1", "2", "Shall I back off?", "Goodbye."]
    assert world.base.pose.x < -0.15
