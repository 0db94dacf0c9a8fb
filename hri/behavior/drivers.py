"""Devices as behaviors: sensors send what they read, the drive takes what it should do."""

from __future__ import annotations

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.signals import Frame, Pose2D, RangeReading, Twist
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.camera import Camera
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.range_sensor import RangeSensor


class CameraFrames(Behavior):
    """Sends each new picture of a camera."""

    category = "drivers"
    camera_id = Param("camera", "id of the camera")
    raw_image = Output[Frame]("image", "the picture, when a new one was taken")

    def start(self, context: Context) -> None:
        self._camera = context.resources.obtain(self.camera_id, Camera)

    def compute(self, now: float, dt: float) -> None:
        if (frame := self._camera.read(now)) is not None:
            self.raw_image.send(frame)


class RangeSensorReading(Behavior):
    """Sends what a range sensor measures."""

    category = "drivers"
    sensor_id = Param("range", "id of the range sensor")
    reading = Output[RangeReading]("range", "the reading")
    distance = Output[float]("double", "the distance in centimetres", "Evolution.Generic")

    def start(self, context: Context) -> None:
        self._sensor = context.resources.obtain(self.sensor_id, RangeSensor)

    def compute(self, now: float, dt: float) -> None:
        reading = self._sensor.read(now)
        self.reading.send(reading)
        self.distance.send(reading.distance * 100)


class BumperSwitch(Behavior):
    """Sends whether a bumper is pressed; raises `bumper.pressed` when it begins."""

    category = "drivers"
    bumper_id = Param("bumper", "id of the bumper")
    is_pressed = Output[bool]("boolean", "true while it touches something")

    def start(self, context: Context) -> None:
        self._bumper = context.resources.obtain(self.bumper_id, Bumper)
        self._events = context.events
        self._was_pressed = False

    def compute(self, now: float, dt: float) -> None:
        pressed = self._bumper.is_pressed(now)
        if pressed and not self._was_pressed:
            self._events.raise_event("bumper.pressed", bumper=self.bumper_id)
        self._was_pressed = pressed
        self.is_pressed.send(pressed)


class BatteryLevel(Behavior):
    """Sends how full the battery is; raises `battery.lowered` when it falls below the limit."""

    category = "drivers"
    battery_id = Param("battery", "id of the battery")
    low = Param(0.2, "the limit, 0 to 1", minimum=0, maximum=1)
    level = Output[float]("double", "0 (empty) to 1 (full)")

    def start(self, context: Context) -> None:
        self._battery = context.resources.obtain(self.battery_id, Battery)
        self._events = context.events
        self._is_low = False

    def compute(self, now: float, dt: float) -> None:
        level = self._battery.level(now)
        is_low = level < self.low + (0.05 if self._is_low else 0.0)
        if is_low and not self._is_low:
            self._events.raise_event("battery.lowered", level=round(level, 3))
        self._is_low = is_low
        self.level.send(level)


class DriveCommand(Behavior):
    """Passes velocities on to the drive; without one at a tick it stops the drive."""

    category = "drivers"
    drive_id = Param("drive", "id of the drive system")
    velocity = Input[Twist]("twist", "the velocity to drive with")

    def start(self, context: Context) -> None:
        self._drive = context.resources.obtain(self.drive_id, DriveSystem)
        self._clock = context.clock

    def compute(self, now: float, dt: float) -> None:
        velocity = self.velocity.value
        if velocity is None:
            self._drive.stop(now)
        else:
            self._drive.set_velocity(velocity, now)

    def stop(self) -> None:
        self._drive.stop(self._clock.now())


class OdometryPose(Behavior):
    """Sends the pose of the base and raises `odometry` at a rate of its own."""

    category = "drivers"
    odometry_id = Param("odometry", "id of the odometry")
    event_interval = Param(0.5, "seconds between two events", minimum=0.01)
    pose = Output[Pose2D]("pose", "where the base is")

    def start(self, context: Context) -> None:
        self._odometry = context.resources.obtain(self.odometry_id, Odometry)
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
