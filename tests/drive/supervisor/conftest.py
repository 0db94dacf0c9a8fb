"""Bases by the names that configurations use, and the resources of one in the simulated world."""

from collections.abc import Iterator
from importlib.metadata import EntryPoint

import pytest

from hri.core import registry
from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager

DEVICES, KINDS = "hri.drive.supervisor.base_devices", "hri.drive.supervisor.base_registry"
NAMES = {
    "Hri.Create2": f"{KINDS}:Create2Bus",
    "Hri.ArduinoBridge": f"{KINDS}:ArduinoBus",
    "Hri.BaseDrive": f"{DEVICES}:BaseDrive",
    "Hri.BaseOdometry": f"{DEVICES}:BaseOdometry",
    "Hri.BaseBumper": f"{DEVICES}:BaseBumper",
    "Hri.BaseCliffSensor": f"{DEVICES}:BaseCliffSensor",
    "Hri.BaseRangeSensor": f"{DEVICES}:BaseRangeSensor",
    "Hri.BaseBattery": f"{DEVICES}:BaseBattery",
    "Hri.EmulatedArduino": "hri.simulation.bases.emulated_base:ArduinoLine",
    "Hri.EmulatedCreate2": "hri.simulation.bases.emulated_base:Create2Line",
}


@pytest.fixture(autouse=True)
def names(monkeypatch: pytest.MonkeyPatch) -> None:
    entries = registry._entries("hri.resources")
    for name, value in NAMES.items():
        monkeypatch.setitem(entries, name, EntryPoint(name, value, "hri.resources"))


@pytest.fixture
def clock() -> FakeClock:
    return FakeClock()


@pytest.fixture
def manager(clock: FakeClock) -> Iterator[ResourceManager]:
    """A Create 2 in the simulated world "home"."""
    devices = (
        Description("world", "Hri.SimulatedWorld"),
        Description("base", "Hri.Create2", {"port": "simulated"}),
        Description("drive", "Hri.BaseDrive", bus="base"),
        Description("odometry", "Hri.BaseOdometry", bus="base"),
        Description("bumper", "Hri.BaseBumper", bus="base"),
        Description("cliff_left", "Hri.BaseCliffSensor", {"sensor": "left"}, bus="base"),
        Description(
            "range_front", "Hri.BaseRangeSensor", {"sensor": "center_left", "x": "17"}, bus="base"
        ),
        Description("battery", "Hri.BaseBattery", bus="base"),
    )
    manager = ResourceManager(devices, clock)
    manager.check()
    yield manager
    manager.close()
