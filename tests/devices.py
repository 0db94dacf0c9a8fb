"""Simulated devices: some pass for real ones, and some make a robot that is typed to."""

from hri import Robot
from hri.hal.microphone import Microphone
from hri.hal.resource import Description

SMALL_SCREEN = Description("screen", "Hri.OffscreenScreen", {"width": "32", "height": "24"})
UNSEEN = Description("screen", "Hri.BlankScreen")
BLIND = Description("camera", "Hri.BlankCamera")
"""Seeing and drawing cost most of the time of a life; where they are of no concern a robot does
neither."""
TYPED = (
    UNSEEN,
    Description("recognizer", "Hri.Typed"),
    BLIND,
    Description("microphone", "Hri.MemoryMicrophone"),
)
"""Of a robot that hears what is typed, sees nothing, and costs little time."""


def live_microphone(robot: Robot) -> None:
    """Let whatever stands for the microphone pass for a real one."""
    robot.resources.obtain("microphone", Microphone).is_hardware = True
