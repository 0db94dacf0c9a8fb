from pathlib import Path

from hri.core.clock import FakeClock
from hri.robot import Robot
from hri.testing import live_for


def test_it_greets_and_counts():
    robot = Robot(str(Path(__file__).parent), "simulated", clock=FakeClock())
    events = live_for(robot, 10.0, *robot.app.load_tasks())
    said = [event.properties["text"] for event in events if event.name == "speech.said"]
    assert said == ["Hello, I am thing.", "one", "two", "three"]
