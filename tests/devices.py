"""Simulated devices that pass for real ones, for tests of what a robot does with real people."""

from hri import Robot
from hri.hal.microphone import Microphone


def live_microphone(robot: Robot) -> None:
    """Let whatever stands for the microphone pass for a real one."""
    robot.resources.obtain("microphone", Microphone).is_hardware = True
