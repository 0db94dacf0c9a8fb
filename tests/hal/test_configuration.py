"""Every shipped configuration loads, and all its devices are known."""

from dataclasses import replace

import pytest

from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.configuration import load_configuration
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource_manager import ResourceManager

CONFIGURATIONS = [name for name in paths.names("config") if name.endswith(".xml")]


@pytest.mark.parametrize("name", CONFIGURATIONS)
def test_it_loads_and_names_all_that_the_companion_needs(name):
    configuration = load_configuration(paths.find("config", name))
    ResourceManager(configuration.devices, FakeClock()).check()
    ids = {device.id for device in configuration.devices}
    assert {"microphone", "speaker", "camera", "screen", "recognizer", "voice"} <= ids
    assert {"drive", "odometry", "bumper", "battery", "range_front"} <= ids


def test_a_type_longer_than_any_file_name_is_an_unknown_type(tmp_path):
    file = tmp_path / "long.xml"
    file.write_text(
        f'<Resources><Devices><Device id="ears" type="Hri.{"e" * 300}"/></Devices></Resources>'
    )
    (device,) = load_configuration(file).devices
    with pytest.raises(HriError, match=f"{file}:1:"):
        ResourceManager((device,), FakeClock()).check()


@pytest.mark.parametrize("port", ["simulated", "/dev/not-there"])
def test_a_create_2_drives_in_the_simulated_world_or_is_replaced(port):
    configuration = load_configuration(paths.find("config", "create2.xml"))
    devices = [
        replace(device, parameters=device.parameters | {"port": port})
        if device.id == "base"
        else device
        for device in configuration.devices
    ]
    clock = FakeClock()
    with ResourceManager(devices, clock, shapes=configuration.shapes) as manager:
        drive, odometry = manager.obtain("drive", DriveSystem), manager.obtain("odometry", Odometry)
        if port == "simulated":
            manager.obtain("base", BaseBus).unlatch()
        clock.advance(0.5)
        drive.move_delta(0.2, 0.2, 0.4).wait(10)
        assert odometry.pose(clock.now()).x == pytest.approx(0.2, abs=0.005)
        assert not manager.obtain("bumper", Bumper).is_pressed(clock.now())
        assert manager.obtain("battery", Battery).level(clock.now()) > 0.9
        assert manager.obtain("range_front", RangeSensor).read(clock.now()).distance > 0.1
