import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError
from hri.core.signals import Frame, Pose2D, Twist
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.camera import Camera
from hri.hal.cliff_sensor import CliffSensor
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.microphone import Microphone
from hri.hal.pending import Interrupted
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.simulated_devices import (
    SimulatedBattery,
    SimulatedBumper,
    SimulatedCamera,
    SimulatedRangeSensor,
)
from hri.simulation.simulated_gripper import SimulatedGripper
from hri.simulation.world import SimulatedWorld

from .conftest import Build


def test_go_forward_ten_meters(build: Build) -> None:
    manager = build()
    drive, odometry = manager.obtain("drive", DriveSystem), manager.obtain("odometry", Odometry)
    while (now := manager.clock.now()) < 60.0:
        ahead = 10.0 - odometry.pose(now).x
        drive.set_velocity(Twist(min(0.5, math.sqrt(max(0.0, ahead) * 0.8))), now)
        manager.clock.advance(0.02)
    world = manager.obtain("world", SimulatedWorld)
    assert odometry.pose(60.0).x == pytest.approx(10.0, rel=0.002)
    assert world.base.pose.x == pytest.approx(10.0, rel=0.02)
    assert not manager.obtain("bumper", Bumper).is_pressed(60.0)


def test_the_drive_stops_and_tells_what_it_can(build: Build) -> None:
    manager = build()
    drive, odometry = manager.obtain("drive", DriveSystem), manager.obtain("odometry", Odometry)
    for _ in range(50):
        drive.set_velocity(Twist(drive.max_linear), manager.clock.now())
        manager.clock.advance(0.02)
    assert odometry.velocity(1.0).linear == pytest.approx(drive.max_linear, abs=0.02)
    drive.stop(1.0)
    manager.clock.advance(0.4)
    assert odometry.velocity(1.4) == Twist()


def test_the_microphone_gives_every_sample_once(build: Build, clock: FakeClock) -> None:
    def listen(step: float) -> list[int]:
        manager = build()
        microphone = manager.obtain("microphone", Microphone)
        manager.obtain("world", SimulatedWorld).say("hello", 0.2)
        parts = [microphone.read(step * (i + 1)) for i in range(round(0.96 / step))]
        return [int(sample) for sample in np.concatenate(parts)]

    heard = listen(0.03)
    assert len(heard) == 0.96 * 16000
    assert heard == listen(0.16)


def test_a_microphone_opened_late_does_not_hear_the_past(build: Build, clock: FakeClock) -> None:
    clock.advance(5.0)
    assert len(build().obtain("microphone", Microphone).read(5.1)) == 1600


def test_range_sensors_see_from_where_they_sit(build: Build) -> None:
    exact = {"noise": "0", "max_range": "30"}
    manager = build(None, range={**exact, "x": "-10", "y": "20", "yaw": "-pi/2"})
    reading = manager.obtain("range", RangeSensor).read(0.0)
    assert reading.distance == pytest.approx(2.5 + 0.2)
    ahead = build(None, range={**exact, "x": "-15"}).obtain("range", RangeSensor).read(0.0)
    assert ahead.distance == pytest.approx(12.5 + 0.15)


def test_a_range_sensor_sees_nothing_beyond_its_reach(build: Build) -> None:
    assert build().obtain("range", RangeSensor).read(0.0).distance == math.inf


def test_a_range_sensor_sees_the_person_while_there(build: Build) -> None:
    manager = build(None, range={"noise": "0", "max_range": "3", "yaw": "0.4769"})
    sensor, world = manager.obtain("range", RangeSensor), manager.obtain("world", SimulatedWorld)
    assert sensor.read(0.0).distance == pytest.approx(math.hypot(1.2, 0.62) - 0.22, abs=0.001)
    world.person.leave(1.0)
    assert sensor.read(5.0).distance > 2


def test_range_noise_is_small_and_repeats(build: Build) -> None:
    def readings() -> list[float]:
        sensor = build(None, range={"max_range": "30"}).obtain("range", RangeSensor)
        return [sensor.read(i / 50).distance for i in range(100)]

    assert readings() == readings()
    assert np.std(readings()) == pytest.approx(0.125, rel=0.3)


def frames(camera: Camera, times: list[float]) -> list[Frame]:
    return [frame for time in times if (frame := camera.read(time)) is not None]


def test_the_camera_takes_its_pictures_at_its_rate(build: Build) -> None:
    camera = build(None, camera={"rate": "15"}).obtain("camera", Camera)
    taken = frames(camera, [i / 100 for i in range(100)])
    assert [frame.sequence for frame in taken] == list(range(15))
    assert all(frame.time == frame.sequence / 15 for frame in taken)
    assert taken[0].image.shape == (240, 320, 3)
    assert taken[0].image.dtype == np.uint8


def test_pictures_do_not_depend_on_how_often_the_camera_is_asked(build: Build) -> None:
    def pictures(times: list[float]) -> dict[int, bytes]:
        manager = build(None, camera={"width": "160", "height": "120"})
        manager.obtain("world", SimulatedWorld).person.nod(0.1)
        taken = frames(manager.obtain("camera", Camera), times)
        return {frame.sequence: frame.image.tobytes() for frame in taken}

    often, rarely = pictures([i / 90 for i in range(90)]), pictures([i / 6 for i in range(6)])
    assert len(rarely) == 6
    assert all(often[sequence] == image for sequence, image in rarely.items())
    assert len(set(often.values())) == len(often)


def test_the_camera_sees_whether_the_person_is_there(build: Build) -> None:
    manager = build()
    camera = manager.obtain("camera", Camera)
    with_person = frames(camera, [0.0])[0].image.astype(int)
    manager.obtain("world", SimulatedWorld).person.leave(0.1)
    without = frames(camera, [3.0])[0].image.astype(int)
    middle = np.s_[80:160, 130:190]
    assert np.abs(with_person[middle] - without[middle]).mean() > 20


def test_the_battery_and_the_bumper_ask_the_world(build: Build) -> None:
    manager = build({"battery": "0.3"})
    manager.obtain("world", SimulatedWorld).bump(1.0)
    assert manager.obtain("battery", Battery).level(0.0) == 0.3
    assert [manager.obtain("bumper", Bumper).is_pressed(t) for t in (0.5, 1.1)] == [False, True]


@pytest.mark.parametrize(
    ("driver", "parameters", "said"),
    [
        (SimulatedCamera, {"width": "99999"}, "from 64 to 1920"),
        (SimulatedCamera, {"rte": "15"}, 'did you mean "rate"'),
        (SimulatedRangeSensor, {"max_range": "0"}, "from 0.1 to 30"),
        (SimulatedRangeSensor, {"yaw": "left"}, "such as 0.5 or -pi/4"),
        (SimulatedCamera, {"noise": "-1"}, "noise"),
        (SimulatedCamera, {"light": "0"}, "light"),
    ],
)
def test_wrong_parameters_are_refused(
    driver: type[SimulatedCamera], parameters: dict[str, str], said: str
) -> None:
    with pytest.raises(AuthoringError, match=said):
        driver.check(Description("device", "Hri.Device", parameters))


@pytest.mark.parametrize("taken", [False, True])
def test_devices_without_a_world_share_one_of_their_own(clock: FakeClock, taken: bool) -> None:
    devices = [
        Description("bumper", "Hri.SimulatedBumper"),
        Description("battery", "Hri.SimulatedBattery"),
        Description("world" if taken else "speaker", "Hri.SilentSpeaker"),
    ]
    manager = ResourceManager(devices, clock)
    bumper = manager.obtain("bumper", SimulatedBumper)
    battery = manager.obtain("battery", SimulatedBattery)
    assert bumper.world is battery.world
    assert manager.ids(SimulatedWorld) == ["simulated_world" if taken else "world"]
    manager.close()


@pytest.mark.proves("H08")
def test_an_infrared_sensor_counts_more_when_something_is_nearer(build: Build) -> None:
    manager = build(None, range={"noise": "0", "max_range": "30", "x": "-15"})
    sensor, world = manager.obtain("range", RangeSensor), manager.obtain("world", SimulatedWorld)
    far = sensor.read(0.0)
    assert far.raw == round(7000 / (far.distance * 100))
    world.base.pose = Pose2D(12.0, 0.0)
    near = sensor.read(0.0)
    assert near.raw is not None
    assert far.raw < near.raw <= 1023
    nothing = build().obtain("range", RangeSensor).read(0.0)
    assert (nothing.distance, nothing.raw) == (math.inf, 0)


@pytest.mark.proves("H07")
def test_the_battery_of_2003_tells_its_voltage(build: Build) -> None:
    volts = {"max_voltage": "12.4", "voltage_floor": "10.5", "voltage_multiplier": "3.12766"}
    full = build(None, battery=volts).obtain("battery", Battery)
    half = build({"battery": "0.5"}, battery=volts).obtain("battery", Battery)
    assert full.voltage(0.0) == pytest.approx(12.4)
    assert half.voltage(0.0) == pytest.approx((12.4 + 10.5) / 2)


def test_a_battery_with_its_voltages_swapped_is_refused() -> None:
    swapped = {"max_voltage": "10", "voltage_floor": "12"}
    with pytest.raises(AuthoringError, match="a full battery has the higher voltage"):
        SimulatedBattery.check(Description("battery", "Hri.SimulatedBattery", swapped))


STAIRS = """
[robot]
start = [0, 0]
[person]
at = [5, 5]
[[wall]]
from = [9, -9]
to = [9, 9]
[[drop]]
name = "stairs"
center = [2, 0]
radius = 0.5
"""


def test_a_cliff_sensor_sees_where_the_floor_ends(
    clock: FakeClock, write: Callable[[str], Path]
) -> None:
    devices = [
        Description("world", "Hri.SimulatedWorld", {"file": str(write(STAIRS))}),
        Description("cliff", "Hri.SimulatedCliffSensor", {"x": "20"}),
    ]
    manager = ResourceManager(devices, clock)
    manager.check()
    cliff, world = manager.obtain("cliff", CliffSensor), manager.obtain("world", SimulatedWorld)
    seen = []
    for x in (0.0, 1.25, 1.35, 2.5):
        world.base.pose = Pose2D(x, 0.0)
        seen.append(cliff.is_cliff(0.0))
    manager.close()
    assert seen == [False, False, True, False]


@pytest.fixture
def gripper(clock: FakeClock) -> SimulatedGripper:
    manager = ResourceManager([Description("gripper", "Evolution.USBGripper")], clock)
    return manager.obtain("gripper", SimulatedGripper)


@pytest.mark.proves("H32")
def test_a_gripper_closes_and_opens_in_its_time(
    clock: FakeClock, gripper: SimulatedGripper
) -> None:
    assert gripper.opening(clock.now()) == 1.0
    closing = gripper.close()
    clock.advance(0.25)
    assert gripper.opening(clock.now()) == pytest.approx(0.75)
    closing.wait()
    assert (clock.now(), gripper.opening(clock.now())) == (1.0, 0.0)
    gripper.open().wait()
    assert (clock.now(), gripper.opening(clock.now())) == (2.0, 1.0)


@pytest.mark.proves("H32")
def test_a_gripper_stops_at_what_it_holds(clock: FakeClock, gripper: SimulatedGripper) -> None:
    gripper.is_object_there = True
    gripper.close().wait()
    assert gripper.has_object(clock.now())
    assert gripper.opening(clock.now()) == pytest.approx(0.4)


def test_a_gripper_that_is_told_otherwise_turns_at_once(
    clock: FakeClock, gripper: SimulatedGripper
) -> None:
    closing = gripper.close()
    clock.advance(0.5)
    gripper.open().wait()
    assert clock.now() == pytest.approx(1.0)
    with pytest.raises(Interrupted, match="another command took its place"):
        closing.result()


@pytest.mark.proves("H17")
@pytest.mark.parametrize(
    ("parameters", "size"),
    [
        ({}, (320, 240)),
        ({"hres": "640", "vres": "480"}, (640, 480)),
        ({"hres": "640", "width": "160"}, (160, 240)),
    ],
)
def test_the_camera_understands_the_sizes_of_2003(
    build: Build, parameters: dict[str, str], size: tuple[int, int]
) -> None:
    frame = build(camera=parameters).obtain("camera", Camera).take()
    assert (frame.width, frame.height) == size
