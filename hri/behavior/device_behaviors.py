"""Devices as behaviors: sensors send their readings, the drive takes commands."""

from __future__ import annotations

import logging

from hri.behavior.behavior import Context
from hri.behavior.device import DeviceBehavior
from hri.behavior.drive_command import DriveCommand as DriveCommand  # programs know it from here
from hri.behavior.effects import NOTHING
from hri.behavior.library.shaping import deadband
from hri.behavior.ports import (
    ANGULAR_VELOCITY,
    DBL_MAX,
    LINEAR_VELOCITY,
    Input,
    Output,
    Param,
)
from hri.core.errors import HriError
from hri.core.origin import caused_by
from hri.core.signals import Frame, Pose2D, RangeReading, SoundWindow, Twist
from hri.hal.audio_level import AudioLevel
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.button import Button
from hri.hal.camera import Camera
from hri.hal.cliff_sensor import CliffSensor
from hri.hal.drive import Odometry
from hri.hal.drivers.fed_microphone import FedMicrophone
from hri.hal.joystick import Joystick
from hri.hal.picture import fitted
from hri.hal.range_sensor import RangeSensor
from hri.hal.screen import Screen

log = logging.getLogger("hri.behavior")


class CameraFrames(DeviceBehavior):
    """Sends each new picture of a camera.

    Raises `camera.switched` (`camera`, `on`) when someone turns it off or on, `camera.lost` when
    no picture comes any more, and `camera.found` once they come again.
    """

    is_sensor = True
    camera_id = Param("camera", "id of the camera")
    raw_image = Output[Frame]("image", "the picture, when a new one was taken")
    is_watching = Output[bool]("boolean", "true while it is switched on and gives pictures")

    def start(self, context: Context) -> None:
        super().start(context)
        self._events = context.events
        self._camera = self.obtain(self.camera_id, Camera)
        self._is_on, self._is_lost = True, False

    def compute(self, now: float, dt: float) -> None:
        if (frame := self._camera.read(now)) is not None:
            self.raw_image.send(frame)
        self.is_watching.send(self._camera.is_watching)
        self._tell(self._camera.is_on, self._camera.is_lost)

    def _tell(self, is_on: bool, is_lost: bool) -> None:
        camera = self._camera.id
        if is_on != self._is_on:
            with caused_by(self._camera.switched_by):
                self._events.raise_event("camera.switched", camera=camera, on=is_on)
        self._is_on = is_on
        if is_on and is_lost != self._is_lost:
            name = "camera.lost" if is_lost else "camera.found"
            self._events.raise_event(name, camera=camera)
            self._is_lost = is_lost


class RangeSensorReading(DeviceBehavior):
    """Sends what a range sensor measures."""

    is_sensor = True
    sensor_id = Param("range", "id of the range sensor")
    reading = Output[RangeReading]("range", "the reading")
    distance = Output[float](
        "double", "centimeters; the largest number there is when nothing is in range"
    )

    def start(self, context: Context) -> None:
        super().start(context)
        self._sensor = self.obtain(self.sensor_id, RangeSensor)

    def compute(self, now: float, dt: float) -> None:
        reading = self._sensor.read(now)
        self.reading.send(reading)
        self.distance.send(min(reading.distance * 100, DBL_MAX))


class BumperSwitch(DeviceBehavior):
    """Sends whether a bumper is pressed; raises `bumper.pressed` when it begins."""

    is_sensor = True
    bumper_id = Param("bumper", "id of the bumper")
    is_pressed = Output[bool]("boolean", "true while it touches something")

    def start(self, context: Context) -> None:
        super().start(context)
        self._bumper = self.obtain(self.bumper_id, Bumper)
        self._events = context.events
        self._was_pressed = False

    def compute(self, now: float, dt: float) -> None:
        pressed = self._bumper.is_pressed(now)
        if pressed and not self._was_pressed:
            self._events.raise_event("bumper.pressed", bumper=self.bumper_id)
        self._was_pressed = pressed
        self.is_pressed.send(pressed)


class ButtonSwitch(DeviceBehavior):
    """Sends whether a button is pressed; raises `button.pressed` and `button.released`.

    The latter has the `seconds` for which it was held, for what a long press does.
    """

    is_sensor = True
    button_id = Param("button", "id of the button")
    is_pressed = Output[bool]("boolean", "true while it is held down")

    def start(self, context: Context) -> None:
        super().start(context)
        self._button = self.obtain(self.button_id, Button)
        self._events = context.events
        self._pressed_at: float | None = None

    def compute(self, now: float, dt: float) -> None:
        pressed = self._button.is_pressed(now)
        if pressed and self._pressed_at is None:
            self._pressed_at = now
            self._events.raise_event("button.pressed", button=self.button_id)
        elif not pressed and self._pressed_at is not None:
            held, self._pressed_at = round(now - self._pressed_at, 3), None
            self._events.raise_event("button.released", button=self.button_id, seconds=held)
        self.is_pressed.send(pressed)


class CliffEdge(DeviceBehavior):
    """Sends whether a cliff sensor misses the floor; raises `cliff.found` when it begins."""

    is_sensor = True
    sensor_id = Param("cliff", "id of the cliff sensor")
    is_cliff = Output[bool]("boolean", "true while there is no floor below the sensor")

    def start(self, context: Context) -> None:
        super().start(context)
        self._sensor = self.obtain(self.sensor_id, CliffSensor)
        self._events = context.events
        self._was_cliff = False

    def compute(self, now: float, dt: float) -> None:
        cliff = self._sensor.is_cliff(now)
        if cliff and not self._was_cliff:
            self._events.raise_event("cliff.found", sensor=self.sensor_id)
        self._was_cliff = cliff
        self.is_cliff.send(cliff)


class BatteryLevel(DeviceBehavior):
    """Sends how full the battery is; raises `battery.lowered` when it falls below the limit, and
    `battery.raised` when it has been charged since.

    While that is not known, it sends nothing, and what was low stays low.
    """

    is_sensor = True
    battery_id = Param("battery", "id of the battery")
    low = Param(0.2, "the limit, 0 to 1", minimum=0, maximum=1)
    level = Output[float]("double", "0 (empty) to 1 (full)")

    def start(self, context: Context) -> None:
        super().start(context)
        self._battery = self.obtain(self.battery_id, Battery)
        self._events = context.events
        self._is_low = False

    def compute(self, now: float, dt: float) -> None:
        level = self._battery.level(now)
        if level is None or not 0.0 <= level <= 1.0:
            return
        is_low = level < self.low + (0.05 if self._is_low else 0.0)
        if is_low and not self._is_low:
            self._events.raise_event("battery.lowered", level=round(level, 3))
        elif self._is_low and not is_low:
            self._events.raise_event("battery.raised", level=round(level, 3))
        self._is_low = is_low
        self.level.send(level)


class MicrophoneLevel(DeviceBehavior):
    """Sends how loud it is around the robot."""

    is_sensor = True
    level_id = Param("audio_level", "id of the audio level")
    level = Output[float]("double", "0 (silence) to 1 (full scale), as a meter shows it")
    level_dbfs = Output[float]("double", "decibels against full scale, 0 is the loudest")

    def start(self, context: Context) -> None:
        super().start(context)
        self._audio = self.obtain(self.level_id, AudioLevel)

    def compute(self, now: float, dt: float) -> None:
        self.level.send(self._audio.level(now))
        self.level_dbfs.send(self._audio.level_dbfs(now))


class MicrophoneFeed(DeviceBehavior):
    """Lets a microphone hear the sound that comes in, such as that of a listener elsewhere."""

    may_do = NOTHING
    microphone_id = Param("microphone", "id of the microphone, an Hri.FedMicrophone")
    sound = Input[SoundWindow]("sound", "what it is to hear")

    def start(self, context: Context) -> None:
        super().start(context)
        self._microphone = self.obtain(self.microphone_id, FedMicrophone)
        self._is_refused = False

    def compute(self, now: float, dt: float) -> None:
        if (window := self.sound.value) is None:
            return
        try:
            self._microphone.feed(window)
        except HriError as error:
            if not self._is_refused:
                log.warning("%s", error)
            self._is_refused = True


class JoystickSticks(DeviceBehavior):
    """Sends where a joystick's sticks are, and the velocity that the first two ask for."""

    is_sensor = is_relay = True
    joystick_id = Param("joystick", "id of the joystick")
    deadband = Param(
        0.1, "share of the way around the middle that counts as rest", minimum=0, maximum=0.9
    )
    max_linear = Param(0.4, "meters a second at the end of the way", minimum=0)
    max_angular = Param(1.2, "radians a second at the end of the way", minimum=0)
    axes = Output[tuple[float, ...]]("doublearray", "where the axes are, -1 to 1")
    buttons = Output[tuple[float, ...]]("doublearray", "1 for each button that is pressed, else 0")
    velocity = Output[Twist]("twist", "forward and to the left are positive")
    linear_velocity = Output[float]("double", "cm/s, forward is positive", LINEAR_VELOCITY)
    angular_velocity = Output[float]("double", "rad/s, left is positive", ANGULAR_VELOCITY)

    def start(self, context: Context) -> None:
        super().start(context)
        self._joystick = self.obtain(self.joystick_id, Joystick)

    def compute(self, now: float, dt: float) -> None:
        axes, heard = self._joystick.axes(now), self._joystick.heard(now)
        self.axes.send(axes, heard)
        self.buttons.send(tuple(map(float, self._joystick.buttons(now))), heard)
        right, back = (self._asked(axis) for axis in (*axes, 0.0, 0.0)[:2])
        velocity = Twist(-back * self.max_linear, -right * self.max_angular)
        self.velocity.send(velocity, heard)
        self.linear_velocity.send(velocity.linear * 100, heard)
        self.angular_velocity.send(velocity.angular, heard)

    def _asked(self, axis: float) -> float:
        """-1 to 1, with rest around the middle."""
        return deadband(axis, self.deadband) / (1 - self.deadband)


class ImageDisplay(DeviceBehavior):
    """Shows the pictures that come in on a screen, as large as they fit."""

    category = "GUI"
    may_do = NOTHING
    screen_id = Param("screen", "id of the screen")
    image = Input[Frame]("image", "the picture; without one the last stays")

    def start(self, context: Context) -> None:
        super().start(context)
        self._screen = self.obtain(self.screen_id, Screen)

    def compute(self, now: float, dt: float) -> None:
        if (frame := self.image.value) is not None:
            self._screen.show(fitted(frame.image, self._screen.width, self._screen.height), now)


class OdometryPose(DeviceBehavior):
    """Sends the pose of the base and raises `odometry` at its own rate."""

    is_sensor = True
    odometry_id = Param("odometry", "id of the odometry")
    event_interval = Param(0.5, "seconds between two events", minimum=0.01)
    pose = Output[Pose2D]("pose", "where the base is")

    def start(self, context: Context) -> None:
        super().start(context)
        self._odometry = self.obtain(self.odometry_id, Odometry)
        self._events = context.events
        self._next = 0.0

    def compute(self, now: float, dt: float) -> None:
        pose = self._odometry.pose(now)
        self.pose.send(pose)
        # Half a tick of tolerance keeps the events on their grid.
        if now + dt / 2 >= self._next:
            self._next = max(self._next + self.event_interval, now)
            self._events.raise_event(
                "odometry",
                x_cm=round(pose.x * 100, 2),
                y_cm=round(pose.y * 100, 2),
                heading_rad=round(pose.heading, 4),
            )
