"""Two motors on one axle: the odometry of a group of a configuration.

    <Group id="odometry" type="Hri.Diff2Odometry">
      <Member member_id="Drive_left"/> <Member member_id="Drive_right"/>
    </Group>

The track comes from the y of the motors. `hri.drive.supervisor.diff2` drives them.
"""

from __future__ import annotations

import logging
from typing import ClassVar

from hri.core.clock import Timer
from hri.core.geometry import along_arc
from hri.core.signals import Pose2D, Twist
from hri.hal.drive import Odometry
from hri.hal.motion import Way
from hri.hal.motor import Motor
from hri.hal.resource import Description, Resource
from hri.hal.wheels import WheelPair

log = logging.getLogger("hri.resources")

POLLING_MS = (50.0, 1.0, 10_000.0)
"""Default, least and most of the odometry's `polling_interval`, milliseconds."""
NARROWEST = 0.001
"""Meters; wheels that are closer to each other cannot turn the base."""


class TwoMotors(Resource):
    """A group of two motors on one axle."""

    motors: tuple[Motor, Motor]
    wheels: WheelPair

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        if len(description.members) != 2:
            what = f"{description.type} has {len(description.members)} members"
            raise description.error("type", what, "name two motors, one on each side")

    def _open(self) -> None:
        first, second = self.description.members
        self.wheels = WheelPair(self.manager.pose_of(first).y, self.manager.pose_of(second).y)
        if self.wheels.track < NARROWEST:
            what = f"{first} and {second} have the same y"
            raise self.description.error("type", what, "give each motor the y of its wheel, in cm")
        self.motors = self.use(first, Motor), self.use(second, Motor)
        super()._open()

    def rolled(self, now: float) -> Way:
        base = self.wheels.base(*(motor.position(now) for motor in self.motors))
        return Way(base.linear, base.angular)

    def wheel_velocity(self, now: float) -> Twist:
        return self.wheels.base(*(motor.velocity(now) for motor in self.motors))


class Diff2Odometry(TwoMotors, Odometry):
    """Adds up what two motors roll; `polling_interval` is in milliseconds.

    Between two polls the way counts as one arc. A poll that fails is made up for by the next.
    """

    parameters: ClassVar[tuple[str, ...]] = ("polling_interval",)

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        description.number_within("polling_interval", *POLLING_MS)

    def _open(self) -> None:
        super()._open()
        interval_ms = self.description.number_within("polling_interval", *POLLING_MS)
        self._interval = interval_ms / 1000
        now = self.manager.clock.now()
        self._pose, self._way = Pose2D(), self.rolled(now)
        self._has_failed = False
        self._timer = self._next_poll(now)

    def _close(self) -> None:
        self._timer.cancel()

    def pose(self, now: float) -> Pose2D:
        with self._lock:
            return self._pose_at(self.rolled(now))

    def velocity(self, now: float) -> Twist:
        return self.wheel_velocity(now)

    def _next_poll(self, now: float) -> Timer:
        return self.manager.clock.call_at(now + self._interval, self._poll)

    def _poll(self) -> None:
        with self._lock:
            if not self.is_active:
                return  # it was closed while this call waited
            now = self.manager.clock.now()
            try:
                way = self.rolled(now)
                self._pose, self._way = self._pose_at(way), way
                self._has_failed = False
            except Exception as error:
                self._report(error)
            # One that waited while it was closed and opened again must not poll beside the new one.
            self._timer.cancel()
            self._timer = self._next_poll(now)

    def _report(self, error: Exception) -> None:
        """Tell of a poll that failed, once until one succeeds."""
        if not self._has_failed:
            log.error("%s: a motor cannot be read: %s", self.id, error, exc_info=error)
        self._has_failed = True

    def _pose_at(self, way: Way) -> Pose2D:
        linear, angular = way.linear - self._way.linear, way.angular - self._way.angular
        return along_arc(self._pose, linear, angular)
