import math
import sys

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.behavior.device_behaviors import (
    BatteryLevel,
    BumperSwitch,
    ButtonSwitch,
    CameraFrames,
    CliffEdge,
    ImageDisplay,
    JoystickSticks,
    MicrophoneLevel,
    OdometryPose,
    RangeSensorReading,
)
from hri.behavior.drive_command import DriveCommand
from hri.core.signals import Frame, Twist
from hri.hal.drive import DriveSystem
from hri.hal.drivers.memory import MemoryJoystick, MemoryMicrophone, OffscreenScreen
from hri.hal.picture import fitted
from hri.hal.resource import Description
from hri.simulation.world import SimulatedWorld
from hri.testing import context, run_for
from tests.behavior.library.ticking import tick

WORLD = """\
[robot]
start = [0, 0]
[person]
at = [-3, 3]
[[wall]]
from = [1, -5]
to = [1, 5]
[[drop]]
center = [0, 2]
radius = 1
"""
DEVICES = {
    "camera": ("Hri.SimulatedCamera", {}),
    "drive": ("Hri.SimulatedDrive", {}),
    "odometry": ("Hri.SimulatedOdometry", {}),
    "bumper": ("Hri.SimulatedBumper", {}),
    "button": ("Hri.SimulatedButton", {}),
    "battery": ("Hri.SimulatedBattery", {}),
    "range": ("Hri.SimulatedRangeSensor", {"x": "20", "noise": "0", "max_range": "2"}),
    "behind": ("Hri.SimulatedRangeSensor", {"yaw": "pi"}),
    "cliff": ("Hri.SimulatedCliffSensor", {"y": "20"}),
    "cliff_far": ("Hri.SimulatedCliffSensor", {"y": "150"}),
    "audio_level": ("Hri.AudioLevel", {"microphone": "ear"}),
    "ear": ("Hri.MemoryMicrophone", {}),
    "joystick": ("Hri.MemoryJoystick", {"axes": "3", "buttons": "2"}),
    "screen": ("Hri.OffscreenScreen", {"width": "80", "height": "60"}),
}


@pytest.fixture
def lent(tmp_path):
    """A context with a device of each kind, in a room with a wall a meter ahead."""
    path = tmp_path / "world.toml"
    path.write_text(WORLD)
    bus = Description("world", "Hri.SimulatedWorld", {"file": str(path), "voice": "mute"})
    mute = Description("mute", "Hri.EspeakVoice")
    devices = [Description(id, *what, bus="world") for id, what in DEVICES.items()]
    made = context(bus, mute, *devices)
    made.resources.obtain("world", SimulatedWorld)
    yield made
    made.resources.close()


def started(behavior, lent):
    behavior.start(lent)
    return behavior


SENSORS = [
    CameraFrames,
    RangeSensorReading,
    BumperSwitch,
    ButtonSwitch,
    CliffEdge,
    BatteryLevel,
    MicrophoneLevel,
    JoystickSticks,
    OdometryPose,
]


@pytest.mark.proves("B19")
@pytest.mark.parametrize("cls", [*SENSORS, ImageDisplay, DriveCommand])
def test_a_device_is_open_while_its_behavior_runs(cls, lent):
    id = next(
        value for name, value in vars(cls()).items() if name.endswith("_id") and value in DEVICES
    )
    behavior = started(cls(), lent)
    device = lent.resources.obtain(id, object)
    lent.resources.release(device)
    assert device.is_active
    tick(behavior, now=0.1)
    behavior.stop()
    behavior.stop()
    assert not device.is_active


@pytest.mark.proves("B20")
def test_sensors_run_first_and_drivers_have_a_palette_of_their_own():
    assert all(cls.is_sensor and cls.category == "drivers" for cls in SENSORS)
    assert not DriveCommand.is_sensor
    assert (DriveCommand.category, ImageDisplay.category) == ("drivers", "GUI")


def test_a_camera_sends_each_picture_once(lent):
    camera = started(CameraFrames(), lent)
    first = tick(camera, now=0.1)["raw_image"]
    assert first.image.shape == (240, 320, 3)
    assert tick(camera, now=0.101) == {"is_watching": True}
    assert tick(camera, now=0.2)["raw_image"].sequence > first.sequence


@pytest.mark.proves("H30")
def test_a_range_sensor_tells_meters_and_centimeters(lent):
    sent = tick(started(RangeSensorReading(), lent), now=0.1)
    assert sent["reading"].distance == pytest.approx(0.8)
    assert sent["distance"] == pytest.approx(80)


def test_nothing_in_range_is_the_largest_number_in_centimeters(lent):
    sent = tick(started(RangeSensorReading(sensor_id="behind"), lent), now=0.1)
    assert sent["reading"].distance == math.inf
    assert sent["distance"] == sys.float_info.max


def test_a_bumper_tells_when_it_is_pressed_and_raises_one_event(lent):
    lent.resources.obtain("world", SimulatedWorld).bump(0.25)
    events = run_for(1.0, [BumperSwitch()], lent)
    assert [event.name for event in events] == ["bumper.pressed"]
    assert events[0].time == pytest.approx(0.3)


def test_a_button_tells_while_it_is_pressed_and_how_long_it_was(lent):
    world = lent.resources.obtain("world", SimulatedWorld)
    world.press("button", 0.25, seconds=1.0)
    world.press("other", 0.1)
    switch = ButtonSwitch()
    events = run_for(2.0, [switch], lent)
    assert [event.name for event in events] == ["button.pressed", "button.released"]
    assert [event.properties["button"] for event in events] == ["button", "button"]
    assert events[1].time - events[0].time == pytest.approx(1.0, abs=0.11)
    assert events[1].properties["seconds"] == pytest.approx(1.0, abs=0.11)


def test_a_cliff_sensor_tells_whether_the_floor_ends_below_it(lent):
    assert tick(started(CliffEdge(sensor_id="cliff"), lent)) == {"is_cliff": False}
    events = run_for(1.0, [CliffEdge(sensor_id="cliff_far")], lent)
    assert [event.name for event in events] == ["cliff.found"]


def test_a_battery_tells_its_level_and_warns_once(lent):
    world = lent.resources.obtain("world", SimulatedWorld)
    battery = started(BatteryLevel(low=0.5), lent)
    warnings = []
    lent.events.subscribe("battery.lowered", warnings.append)
    for now, level in ((0.1, 0.6), (0.2, 0.4), (0.3, 0.52), (0.4, 0.3)):
        world.set_battery(level, now)
        assert tick(battery, now=now)["level"] == pytest.approx(level, abs=1e-3)
    assert len(warnings) == 1


def test_a_battery_that_is_not_known_sends_nothing_and_stays_as_low_as_it_was(lent, monkeypatch):
    battery, warnings = started(BatteryLevel(low=0.5), lent), []
    lent.events.subscribe("battery.lowered", warnings.append)
    levels = iter((None, math.nan, 0.9, None, 0.4, None, 24.3, 0.4, None, 0.9, None, 0.3))
    monkeypatch.setattr(battery._battery, "level", lambda now: next(levels))
    sent = [tick(battery, now=0.1 * index).get("level") for index in range(12)]
    assert sent == [None, None, 0.9, None, 0.4, None, None, 0.4, None, 0.9, None, 0.3]
    assert len(warnings) == 2


@pytest.mark.proves("R03")
def test_the_microphone_level_is_that_of_what_is_heard(lent):
    level = started(MicrophoneLevel(), lent)
    tone = (16384 * math.sqrt(2) * np.sin(np.arange(8000) * 0.3)).astype(np.int16)
    lent.resources.obtain("ear", MemoryMicrophone).hear(tone)
    loud = tick(level, now=0.4)
    assert loud["level_dbfs"] == pytest.approx(-6, abs=0.2)
    assert loud["level"] == pytest.approx(0.9, abs=0.01)
    assert tick(level, now=1.0)["level"] == 0.0


@pytest.mark.parametrize(
    ("axes", "linear", "angular"),
    [
        ((0.0, 0.0), 0.0, 0.0),
        ((0.0, -1.0), 40.0, 0.0),
        ((0.0, 1.0), -40.0, 0.0),
        ((1.0, 0.0), 0.0, -1.2),
        ((-1.0, -1.0), 40.0, 1.2),
        ((0.09, -0.09), 0.0, 0.0),
        ((0.0, -0.55), 20.0, 0.0),
    ],
)
def test_a_joystick_asks_for_a_velocity_and_rests_around_the_middle(axes, linear, angular, lent):
    behavior = started(JoystickSticks(), lent)
    lent.resources.obtain("joystick", MemoryJoystick).hold(axes, (False, True))
    sent = tick(behavior)
    assert sent["linear_velocity"] == pytest.approx(linear)
    assert sent["angular_velocity"] == pytest.approx(angular)
    assert sent["velocity"] == Twist(pytest.approx(linear / 100), pytest.approx(angular))
    assert sent["axes"] == (*axes, 0.0)
    assert sent["buttons"] == (0.0, 1.0)


def test_an_image_is_shown_as_large_as_it_fits(lent):
    display = started(ImageDisplay(), lent)
    screen = lent.resources.obtain("screen", OffscreenScreen)
    picture = np.full((120, 120, 3), 200, np.uint8)
    tick(display, image=Frame(picture, 0.0, 0))
    tick(display)
    assert screen.count == 1
    assert screen.image.shape == (60, 80, 3)
    assert screen.image[:, 10:70].min() == 200
    assert screen.image[:, :10].max() == screen.image[:, 70:].max() == 0


SIZES = st.integers(1, 40)


@given(size=st.tuples(SIZES, SIZES), screen=st.tuples(SIZES, SIZES))
def test_any_picture_fits_any_screen(size, screen):
    shown = fitted(np.full((*size, 3), 9, np.uint8), *screen)
    assert shown.shape == (screen[1], screen[0], 3)
    assert shown.max() == 9


@pytest.fixture
def floor():
    """A context with nothing but a drive, in a room."""
    made = context(
        Description("world", "Hri.SimulatedWorld", {"voice": "mute"}),
        Description("mute", "Hri.SilentVoice"),
        Description("drive", "Hri.SimulatedDrive", bus="world"),
    )
    yield made
    made.resources.close()


def driven(lent, **inputs):
    """A drive behavior after two seconds with these inputs."""
    drive = started(DriveCommand(), lent)
    for step in range(20):
        tick(drive, now=step * 0.1, **inputs)
        lent.clock.advance(0.1)
    return drive


def velocity_at(lent, now):
    world = lent.resources.obtain("world", SimulatedWorld)
    lent.clock.advance(max(0.0, now - lent.clock.now()))
    world.advance(now)
    return world.base.velocity


@pytest.mark.proves("B19")
@pytest.mark.parametrize(
    ("inputs", "velocity"),
    [
        ({"linear_velocity": 3.0}, Twist(0.03, 0.0)),
        ({"angular_velocity": 0.5}, Twist(0.0, 0.5)),
        ({"linear_velocity": -3.0, "angular_velocity": 0.5}, Twist(-0.03, 0.5)),
        ({"velocity": Twist(0.1, 0.2), "linear_velocity": 3.0}, Twist(0.1, 0.2)),
        ({}, Twist()),
    ],
)
def test_the_drive_takes_a_twist_or_the_velocities_of_2003(inputs, velocity, floor):
    driven(floor, **inputs)
    moved = velocity_at(floor, 2.0)
    assert (moved.linear, moved.angular) == pytest.approx((velocity.linear, velocity.angular))


def stop(drive, now):
    drive.stop()


@pytest.mark.parametrize("end", [tick, stop])
def test_the_drive_stops_when_velocities_end_and_when_its_behavior_does(end, floor):
    end(driven(floor, linear_velocity=-10.0), now=2.0)
    assert velocity_at(floor, 2.01).linear == pytest.approx(-0.1, abs=0.02)
    # Sooner than by the watchdog of the base, which waits for half a second.
    assert velocity_at(floor, 2.2) == Twist()


def test_a_drive_behavior_that_nothing_reaches_leaves_the_drive_to_others(floor):
    drive = started(DriveCommand(), floor)
    for step in range(6):
        floor.resources.obtain("drive", DriveSystem).set_velocity(Twist(-0.1), step * 0.1)
        tick(drive, now=step * 0.1)
        floor.clock.advance(0.1)
    assert velocity_at(floor, 0.6).linear == pytest.approx(-0.1, abs=0.01)


def test_odometry_tells_where_the_base_is_and_raises_events_at_its_own_rate(lent):
    events = run_for(2.05, [OdometryPose(event_interval=0.5)], lent)
    assert [event.time for event in events] == pytest.approx([0, 0.5, 1, 1.5, 2])
    assert events[0].properties == {"x_cm": 0.0, "y_cm": 0.0, "heading_rad": 0.0}
