"""What the robot has: its devices, as choices for the parameters of behaviors."""

from __future__ import annotations

from collections.abc import Mapping

from hri.hal.audio_level import AudioLevel
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.button import Button
from hri.hal.camera import Camera
from hri.hal.cliff_sensor import CliffSensor
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.joystick import Joystick
from hri.hal.microphone import Microphone
from hri.hal.range_sensor import RangeSensor
from hri.hal.recognizer import Recognizer
from hri.hal.resource import Resource
from hri.hal.resource_manager import ResourceManager
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker
from hri.hal.synthesizer import Synthesizer

KINDS: Mapping[str, type[Resource]] = {
    "audio_level": AudioLevel,
    "battery": Battery,
    "bumper": Bumper,
    "button": Button,
    "camera": Camera,
    "cliff": CliffSensor,
    "drive": DriveSystem,
    "joystick": Joystick,
    "microphone": Microphone,
    "odometry": Odometry,
    "range": RangeSensor,
    "recognizer": Recognizer,
    "screen": Screen,
    "speaker": Speaker,
    "voice": Synthesizer,
}
"""Interfaces by the id that a behavior asks for unless told otherwise."""


def devices_of(resources: ResourceManager) -> list[dict[str, str]]:
    """Each device under each of its kinds: `id`, `interface`, a key of `KINDS`, and `about`."""
    return [
        {"id": id, "interface": kind, "about": resources.descriptions[id].type}
        for kind, interface in KINDS.items()
        for id in resources.ids(interface)
    ]
