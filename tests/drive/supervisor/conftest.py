"""Bases by the names that configurations use, and the resources of one in the simulated world."""

from collections.abc import Iterator

import pytest

from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager


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
