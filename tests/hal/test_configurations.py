"""Every shipped configuration loads, and all its devices are known."""

import pytest

from hri.core import paths
from hri.core.clock import FakeClock
from hri.hal.configuration import load_configuration
from hri.hal.manager import ResourceManager

CONFIGURATIONS = [name for name in paths.names("config") if name.endswith(".xml")]


@pytest.mark.parametrize("name", CONFIGURATIONS)
def test_it_loads_and_names_all_that_the_companion_needs(name):
    configuration = load_configuration(paths.find("config", name))
    ResourceManager(configuration.devices, FakeClock()).check()
    ids = {device.id for device in configuration.devices}
    assert {"microphone", "speaker", "camera", "screen", "recognizer", "voice"} <= ids
    assert {"drive", "odometry", "bumper", "battery", "range_front"} <= ids
