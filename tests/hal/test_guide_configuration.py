"""The configuration printed in the guide of 2003 works as it stands."""

import pytest

from hri.core.clock import FakeClock, RealClock
from hri.core.errors import NotAvailable
from hri.hal.battery import Battery
from hri.hal.configuration import load_configuration
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.gripper import Gripper
from hri.hal.motor import Motor
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Resource
from hri.hal.resource_manager import ResourceManager
from tests.recorded import SHARED, needs_shared

GUIDE = SHARED / "guide" / "resource-config.xml"

pytestmark = needs_shared("guide/resource-config.xml")


@pytest.fixture(scope="module")
def configuration():
    return load_configuration(GUIDE)


@pytest.fixture
def manager(configuration):
    manager = ResourceManager(configuration.devices, FakeClock(), shapes=configuration.shapes)
    yield manager
    manager.close()


@pytest.mark.proves("H01", "H02", "H03")
def test_it_is_read_as_it_stands(configuration, manager):
    manager.check()
    body = manager.dimensions
    assert (body.lx, body.ly, body.lz) == (0.6, 0.5, 0.5)
    assert (body.x, body.y, body.z, body.yaw) == (-0.15, 0.0, 0.25, 0.0)
    buses = {device.id: device.bus for device in configuration.devices}
    assert len(buses) == 28
    assert (buses["Drive_left"], buses["IR_tn"], buses["drive"]) == ("rcm_bus0", "UsbHID", "")


@pytest.mark.proves("H04", "H05", "H09")
def test_poses_and_expressions_have_their_values(manager):
    from math import pi

    poses = {id: manager.pose_of(id) for id in ("IR_tne", "IR_tn", "IR_tnw")}
    assert {id: (p.x, p.y, p.z, p.yaw) for id, p in poses.items()} == {
        "IR_tne": (-0.1, -0.2, 0.22, -pi / 4),
        "IR_tn": (-0.15, 0.0, 0.4, 0.0),
        "IR_tnw": (-0.1, 0.2, 0.22, pi / 4),
    }
    left = manager.descriptions["Drive_left"]
    assert left.number("cycle_time", 0) == pytest.approx(150e-6)
    assert left.number("position_factor", 0) == -1711


@pytest.mark.proves("H10")
def test_ids_follow_the_compass_of_somebody_who_faces_the_robot(manager):
    north, east, west = (manager.pose_of(f"IR_t{end}") for end in ("n", "ne", "nw"))
    assert north.yaw == 0.0
    # The robot's right is at the left hand of whoever faces it, which 2003 calls the east.
    assert east.y < 0
    assert east.yaw < 0
    assert west.y > 0
    assert west.yaw > 0


@pytest.mark.proves("H06", "H07", "H08", "H32")
def test_its_base_sensors_and_gripper_work(manager):
    drive, odometry = manager.obtain("drive", DriveSystem), manager.obtain("odometry", Odometry)
    drive.move_delta(0.5, 0.2, 0.4).wait()
    now = manager.clock.now()
    assert odometry.pose(now).x == pytest.approx(0.5, abs=0.001)
    assert manager.obtain("Drive_left", Motor).position(now) == pytest.approx(0.5, abs=0.001)
    assert 10.5 < manager.obtain("Battery", Battery).voltage(now) <= 12.4
    assert manager.ids(RangeSensor) == ["IR_tne", "IR_tn", "IR_tnw"]
    assert manager.obtain("IR_tn", RangeSensor).read(now).raw == 0
    manager.obtain("gripper", Gripper).close().wait()


@pytest.mark.proves("H11", "H12", "H13", "H14", "H15")
def test_each_device_opens_or_says_what_to_do(configuration):
    manager = ResourceManager(configuration.devices, RealClock())
    refusals = {}
    for device in configuration.devices:
        try:
            manager.obtain(device.id, Resource)
        except NotAvailable as error:
            refusals[device.id] = str(error)
    manager.close()
    assert all(" - " in refusal for refusal in refusals.values())
    hardware = {"camera0", "joystick", "robohead", "winvoice_audio_level", "audio_out", "audio_in"}
    files = {"wav_file_audio_play", "wav_file_audio_record", "mp3_file_audio_play"}
    assert set(refusals) <= hardware | files
