"""Drivers, opened on a fake clock and closed twice at the end."""

import pytest

from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager


@pytest.fixture
def clock():
    return FakeClock()


@pytest.fixture
def manager(clock):
    """Microphone, speaker and joystick in memory."""
    devices = (
        Description("microphone", "Hri.MemoryMicrophone", {"rate": "16000"}),
        Description("high", "Hri.MemoryMicrophone", {"rate": "48000"}),
        Description("speaker", "Hri.SilentSpeaker"),
        Description("joystick", "Hri.MemoryJoystick", {"axes": "3"}),
    )
    manager = ResourceManager(devices, clock)
    yield manager
    manager.close()


@pytest.fixture
def open_driver(manager):
    opened = []

    def open_driver(cls, **parameters):
        texts = {name: str(value) for name, value in parameters.items()}
        driver = cls(Description(cls.__name__, "Test", texts), manager)
        driver.activate()
        opened.append(driver)
        return driver

    yield open_driver
    for driver in opened:
        driver.deactivate()
        driver.deactivate()
