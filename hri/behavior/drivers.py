"""Devices as behaviors: sensors send what they read, the drive takes what it should do."""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from typing import Any

import numpy as np

from hri.behavior.behavior import Context
from hri.behavior.device import DeviceBehavior
from hri.behavior.effects import NOTHING, Effect
from hri.behavior.library.shaping import deadband
from hri.behavior.ports import (
    ANGULAR_VELOCITY,
    DBL_MAX,
    LINEAR_VELOCITY,
    Input,
    InputPort,
    Output,
    Param,
)
from hri.core.errors import HriError
from hri.core.quoting import quoted
from hri.core.signals import Event, Frame, Image, Pose2D, RangeReading, Twist
from hri.hal.audio_level import AudioLevel
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.camera import Camera
from hri.hal.cliff_sensor import CliffSensor
from hri.hal.drive import PATIENCE, DriveSystem, Odometry
from hri.hal.helm import Outranked, Rank, Writer
from hri.hal.joystick import Joystick
from hri.hal.range_sensor import RangeSensor
from hri.hal.screen import Screen

log = logging.getLogger("hri.behavior")

STEERING_RANKS = tuple(rank.value for rank in Rank if rank is not Rank.NOBODY)


class CameraFrames(DeviceBehavior):
    """Sends each new picture of a camera.

    Raises `camera.switched` (`camera`, `on`) when somebody turns it off or on, `camera.lost` when
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
    """Sends how full the battery is; raises `battery.lowered` when it falls below the limit."""

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
        is_low = level < self.low + (0.05 if self._is_low else 0.0)
        if is_low and not self._is_low:
            self._events.raise_event("battery.lowered", level=round(level, 3))
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


def fitted(image: Image, width: int, height: int) -> Image:
    """A picture scaled to fit into another size, with black bars where the shapes differ."""
    if image.shape[:2] == (height, width):
        return image
    scale = min(height / image.shape[0], width / image.shape[1])
    rows, columns = (max(1, round(size * scale)) for size in image.shape[:2])
    nearest = np.ix_(
        np.arange(rows) * image.shape[0] // rows, np.arange(columns) * image.shape[1] // columns
    )
    canvas: Image = np.zeros((height, width, 3), np.uint8)
    top, left = (height - rows) // 2, (width - columns) // 2
    canvas[top : top + rows, left : left + columns] = image[nearest]
    return canvas


class DriveCommand(DeviceBehavior):
    """Passes velocities on to the drive, and stops it when they end.

    A velocity that rests on the word of somebody outside, such as a peer over the network, counts
    for `PATIENCE` seconds after that word. While nothing comes in it leaves the drive alone, so
    that somebody else may use it. Several that write one drive need different ranks; while one of
    a higher rank steers, the others wait, and raise `drive.refused` (`words`) once. With the rank
    "teleop", a velocity of 0 counts as nothing: it is that of a stick at rest.
    """

    may_do = frozenset({Effect.MOVES})
    drive_id = Param("drive", "id of the drive system")
    rank = Param(
        "behaviors", "what its commands are worth, where no task gave them", among=STEERING_RANKS
    )
    velocity = Input[Twist]("twist", "what to drive with; goes before the other two")
    linear_velocity = Input[float]("double", "cm/s, 0 when only the other comes", LINEAR_VELOCITY)
    angular_velocity = Input[float](
        "double", "rad/s to the left, 0 when only the other comes", ANGULAR_VELOCITY
    )

    def start(self, context: Context) -> None:
        super().start(context)
        self._drive = self.obtain(self.drive_id, DriveSystem)
        self._writer = Writer(self, f'the behavior "{self.id}"', Rank(self.rank))
        try:
            self._drive.claim(self._writer)
        except HriError:
            self._give_back()
            raise
        self._clock, self._events = context.clock, context.events
        self._is_driving = self._is_waiting = self._must_let_go = False
        self._subscription = context.events.subscribe("drive.halt", self._halt)

    @property
    def steers(self) -> tuple[str, str]:
        return self.drive_id, self.rank

    def compute(self, now: float, dt: float) -> None:
        velocity, until = self._asked()
        if self._must_let_go:
            self._must_let_go = velocity not in (None, Twist()) and now <= until
            velocity = None
        if velocity is not None and now <= until:
            self._steer(velocity, now, until)
        elif self._is_driving:
            if velocity is not None:
                log.warning("%s stops: whoever steers it from outside fell silent", self.drive_id)
            self._drive.let_go(self._writer, now)
            self._is_driving = False

    def stop(self) -> None:
        self._subscription.cancel()
        self._drive.leave(self._writer, self._clock.now())
        super().stop()

    def _halt(self, event: Event) -> None:
        self._drive.stop(self._clock.now())
        self._must_let_go = True
        if self._is_driving:
            reason = quoted(str(event.properties.get("because", "I was told to")))
            what = "%s stops: %s - who steers is heard again after a velocity of 0"
            log.warning(what, self.drive_id, reason)

    def _steer(self, velocity: Twist, now: float, until: float) -> None:
        rank = Rank(self.velocity.rank or self.rank)
        try:
            self._drive.set_velocity(velocity, now, until, replace(self._writer, rank=rank))
        except Outranked as error:
            if not self._is_waiting and rank is not Rank.NOBODY:
                log.warning("%s", error)
                self._events.raise_event("drive.refused", words=str(error))
                self._is_waiting = True
            self._is_driving = False
        else:
            self._is_driving, self._is_waiting = True, False

    def _asked(self) -> tuple[Twist | None, float]:
        """The velocity and until when it counts."""
        velocity, until = self._wish()
        if velocity == Twist() and self.rank == Rank.TELEOP:
            velocity = None
        return velocity, until

    def _wish(self) -> tuple[Twist | None, float]:
        if (velocity := self.velocity.value) is not None:
            return velocity, counts_until(self.velocity)
        linear, angular = self.linear_velocity.value, self.angular_velocity.value
        if linear is None and angular is None:
            return None, math.inf
        until = min(counts_until(self.linear_velocity), counts_until(self.angular_velocity))
        return Twist((linear or 0.0) / 100, angular or 0.0), until


def counts_until(port: InputPort[Any]) -> float:
    """Until when what a port carries may move the base; infinity for what no outsider said."""
    return math.inf if port.spoken is None else port.spoken + PATIENCE


class OdometryPose(DeviceBehavior):
    """Sends the pose of the base and raises `odometry` at a rate of its own."""

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
