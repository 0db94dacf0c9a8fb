from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.core.signals import Prosody, Speech
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import PLAIN, Synthesizer
from hri.simulation.world import SimulatedWorld

LETTER = 0.08
"""Seconds that a letter sounds in the voice of these tests."""


class ToneVoice(Synthesizer):
    """Hums a tone as long as the text."""

    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        times = np.arange(round(len(text) * LETTER * 22050)) / 22050
        tone = (6000 * np.sin(2 * np.pi * 440 * times)).astype(np.int16)
        return Speech(text, tone, 22050)


DEVICES = {
    "camera": "Hri.SimulatedCamera",
    "microphone": "Hri.SimulatedMicrophone",
    "drive": "Hri.SimulatedDrive",
    "odometry": "Hri.SimulatedOdometry",
    "range": "Hri.SimulatedRangeSensor",
    "bumper": "Hri.SimulatedBumper",
    "battery": "Hri.SimulatedBattery",
}

Build = Callable[..., ResourceManager]


@pytest.fixture
def clock() -> FakeClock:
    return FakeClock()


@pytest.fixture
def build(clock: FakeClock) -> Iterator[Build]:
    """Makes a configuration: the world's parameters, then those of devices by their id."""
    made: list[ResourceManager] = []

    def make(world: dict[str, str] | None = None, **devices: dict[str, str]) -> ResourceManager:
        parameters = {"voice": "person_voice", **(world or {})}
        descriptions = [Description("world", "Hri.SimulatedWorld", parameters)]
        for id, type in DEVICES.items():
            descriptions.append(Description(id, type, devices.get(id, {}), bus="world"))
        manager = ResourceManager(descriptions, clock)
        voice = ToneVoice(Description("person_voice", "Hri.EspeakVoice"), manager)
        manager.substitute("person_voice", voice)
        made.append(manager)
        return manager

    yield make
    for manager in made:
        manager.close()


@pytest.fixture
def world(build: Build) -> SimulatedWorld:
    return build().obtain("world", SimulatedWorld)


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str], Path]:
    """Writes a TOML file."""

    def to_file(text: str) -> Path:
        path = tmp_path / "file.toml"
        path.write_text(text)
        return path

    return to_file
