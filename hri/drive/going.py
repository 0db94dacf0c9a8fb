"""Behaviors that go to a place: straight on, or around what is in the way.

    goal (pose, odometry frame) -> Hri.ObstacleAvoidance -> Hri.CommandGate -> Hri.DriveSystem

Goals come from `Hri.FollowTarget`, `Hri.Wander`, or from a task by the board.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

from hri.behavior.behavior import Context
from hri.behavior.device import DeviceBehavior
from hri.behavior.ports import ANGULAR_VELOCITY, LINEAR_VELOCITY, Input, Output, Param
from hri.core.errors import HriError
from hri.core.signals import People, Pose2D, Twist
from hri.drive.avoidance import Avoidance, Manner, straight_to, turn_to
from hri.drive.mechanics import mechanics_of, range_sensors
from hri.hal.drive import Odometry
from hri.hal.motion import REST
from hri.hal.range_sensor import RangeSensor

PEOPLE = "people"
"""The board slot with everybody whom the camera sees."""
_MANNER = Manner()


class _Going(DeviceBehavior, ABC):
    """Base of what leads to a goal in the odometry frame."""

    category = "drive"
    odometry_id = Param("odometry", "id of the odometry")
    max_linear = Param(_MANNER.speed, "meters a second", minimum=0.02, maximum=2)
    max_angular = Param(_MANNER.turn_rate, "radians a second", minimum=0.05, maximum=6)
    near = Param(_MANNER.near, "meters from the goal that count as there", minimum=0.02, maximum=1)
    faces = Param(False, "turn to the heading of the goal when it is there")

    goal = Input[Pose2D]("pose", "where to go, in the frame of the odometry; nothing: stay")
    speed = Input[float]("double", "factor on the greatest speed, 0 to 1")
    velocity = Output[Twist]("twist", "for the command gate; nothing without a goal")
    linear_velocity = Output[float]("double", "cm/s, the same in parts", LINEAR_VELOCITY)
    angular_velocity = Output[float]("double", "rad/s to the left", ANGULAR_VELOCITY)
    is_there = Output[bool]("boolean", "whether the goal is reached; nothing without a goal")

    def start(self, context: Context) -> None:
        super().start(context)
        self._odometry = self.obtain(self.odometry_id, Odometry)
        self._goal: Pose2D | None = None

    def compute(self, now: float, dt: float) -> None:
        pose = self._odometry.pose(now)
        self._look(now, pose)
        goal = self.goal.value
        if goal is None:
            return
        if not all(map(math.isfinite, (goal.x, goal.y, goal.heading))):
            raise HriError(f"cannot go to {goal} - give finite numbers")
        twist = self._steer(now, pose, goal)
        is_at = math.dist((pose.x, pose.y), (goal.x, goal.y)) <= self.near
        if is_at and self.faces:
            twist = turn_to(pose, goal.heading, self.max_angular)
        self._send(twist)
        self.is_there.send(is_at and twist == REST)

    def _look(self, now: float, pose: Pose2D) -> None:
        """Take in what the sensors say, with or without a goal."""

    @abstractmethod
    def _steer(self, now: float, pose: Pose2D, goal: Pose2D) -> Twist:
        """The velocity toward the goal."""

    def _send(self, twist: Twist) -> None:
        factor = self.speed.value
        share = 1.0 if factor is None else min(max(factor, 0.0), 1.0)
        twist = Twist(twist.linear * share, twist.angular)
        self.velocity.send(twist)
        self.linear_velocity.send(twist.linear * 100)
        self.angular_velocity.send(twist.angular)

    def _manner(self) -> Manner:
        return Manner(speed=self.max_linear, turn_rate=self.max_angular, near=self.near)


class Beeline(_Going):
    """Goes straight to a goal and looks at nothing: put something behind it that stops."""

    def _steer(self, now: float, pose: Pose2D, goal: Pose2D) -> Twist:
        return straight_to(pose, goal, self._manner())


class ObstacleAvoidance(_Going):
    """Goes to a goal around obstacles, as the configuration describes body and range sensors."""

    sensor_ids = Param("", "ids of range sensors with spaces between; empty takes all there are")

    people = Input[People]("people", "who is seen; it keeps half a meter away while it moves")
    bump = Input[bool]("boolean", "switches that something presses; any number")
    side = Output[float]("double", "side on which it goes around something: 1 left, -1 right, 0")

    def start(self, context: Context) -> None:
        super().start(context)
        ids = self.sensor_ids.split() or range_sensors(context.resources)
        self._sensors = {id: self.obtain(id, RangeSensor) for id in ids}
        self._avoidance = Avoidance(mechanics_of(context.resources, ids), self._manner())

    def _look(self, now: float, pose: Pose2D) -> None:
        readings = {id: sensor.read(now) for id, sensor in self._sensors.items()}
        self._avoidance.see(now, pose, readings, self.people.value)
        self._avoidance.touch(now, pose, any(self.bump.values))

    def _steer(self, now: float, pose: Pose2D, goal: Pose2D) -> Twist:
        twist = self._avoidance.steer(now, pose, goal)
        self.side.send(float(self._avoidance.side))
        return twist
