"""Behaviors that say where to go, and those that go there: straight on, or around obstacles.

    tracker.people -> Hri.FollowTarget -> goal -> Hri.ObstacleAvoidance -> Hri.CommandGate

A goal is a pose in the odometry frame. It comes from `Hri.FollowTarget`, `Hri.Wander`, or from a
task by the board.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import replace

from hri.behavior.behavior import Context
from hri.behavior.device import DeviceBehavior
from hri.behavior.ports import ANGULAR_VELOCITY, LINEAR_VELOCITY, Input, Output, Param
from hri.core.errors import HriError
from hri.core.geometry import seen_from
from hri.core.signals import People, Pose2D, Twist
from hri.drive.avoidance import ROUTE, Avoidance, Manner, straight_to, turn_to
from hri.drive.following import Following, FollowingManner, Pursuit, tell
from hri.drive.mechanics import mechanics_of, sensors
from hri.drive.odometry import Estimate, Wheels, arc_between, rolled_on
from hri.drive.wandering import Wandering
from hri.hal.drive import Odometry
from hri.hal.motion import REST
from hri.hal.range_sensor import RangeSensor

PEOPLE = "people"
"""The board slot with everyone whom the camera sees."""
_MANNER = Manner()


class _FromPose(DeviceBehavior):
    """Base of what reads the pose of the base."""

    category = "drive"
    odometry_id = Param("odometry", "id of the odometry")

    def start(self, context: Context) -> None:
        super().start(context)
        self._odometry = self.obtain(self.odometry_id, Odometry)


class _Going(_FromPose, ABC):
    """Base of what leads to a goal in the odometry frame."""

    max_linear = Param(_MANNER.speed, "meters a second", minimum=0.02, maximum=2)
    max_angular = Param(_MANNER.turn_rate, "radians a second", minimum=0.05, maximum=6)
    near = Param(_MANNER.near, "meters from the goal that count as there", minimum=0.005, maximum=1)
    faces = Param(False, "turn to the heading of the goal when it is there")

    goal = Input[Pose2D]("pose", "where to go, in the frame of the odometry; nothing: stay")
    speed = Input[float]("double", "factor on the greatest speed, 0 to 1")
    velocity = Output[Twist]("twist", "for the command gate; nothing without a goal")
    linear_velocity = Output[float]("double", "cm/s, the same in parts", LINEAR_VELOCITY)
    angular_velocity = Output[float]("double", "rad/s to the left", ANGULAR_VELOCITY)
    is_there = Output[bool]("boolean", "whether the goal is reached; nothing without a goal")

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
        if is_at and self.faces and not self._is_touched(now):
            twist = turn_to(pose, goal.heading, self.max_angular)
        self._send(twist)
        self.is_there.send(is_at and twist == REST)

    def _look(self, now: float, pose: Pose2D) -> None:
        """Take in what the sensors say, with or without a goal."""

    @abstractmethod
    def _steer(self, now: float, pose: Pose2D, goal: Pose2D) -> Twist:
        """The velocity toward the goal."""

    def _is_touched(self, now: float) -> bool:
        """Whether it rests because something touches it, or did a moment ago."""
        return False

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

    watch = Param(
        0.0,
        "radians off the heading of the goal, where someone is in sight of the camera, beyond which"
        " it waits before it turns away; 0: it does not look at the heading",
        minimum=0,
        maximum=3,
    )
    sensor_ids = Param("", "ids of range sensors with spaces between; empty takes all there are")

    people = Input[People]("people", "who is seen; it keeps half a meter away while it moves")
    bump = Input[bool]("boolean", "switches that something presses; any number")
    side = Output[float]("double", "side on which it goes around something: 1 left, -1 right, 0")

    def start(self, context: Context) -> None:
        super().start(context)
        ids = self.sensor_ids.split() or sensors(context.resources, RangeSensor)
        self._sensors = {id: self.obtain(id, RangeSensor) for id in ids}
        self._avoidance = Avoidance(mechanics_of(context.resources, ids), self._manner())
        self._route = context.board.slot(ROUTE)

    def _manner(self) -> Manner:
        return replace(super()._manner(), watch=self.watch or math.inf)

    def _is_touched(self, now: float) -> bool:
        return self._avoidance.is_touched(now)

    def _look(self, now: float, pose: Pose2D) -> None:
        readings = {id: sensor.read(now) for id, sensor in self._sensors.items()}
        self._avoidance.see(now, pose, readings, self.people.value)
        self._avoidance.touch(now, pose, any(self.bump.values))

    def _steer(self, now: float, pose: Pose2D, goal: Pose2D) -> Twist:
        twist = self._avoidance.steer(now, pose, goal)
        self._route.set(self._avoidance.route, now)
        self.side.send(float(self._avoidance.side))
        return twist


class FollowTarget(_FromPose):
    """Follows a person, or a place that is given, at a distance, and faces it.

    Without a sight of it for a second it goes to where it saw the target last and looks around.
    Raises `target.found` and `target.lost` (`given_up`: whether the search is over).
    """

    distance = Param(1.2, "meters between the middles of both", minimum=0.3, maximum=5)
    patience_s = Param(20.0, "seconds out of sight until it gives up", minimum=1, maximum=600)
    person = Param("", "id of the person; empty takes who is attended to, or the nearest")

    people = Input[People]("people", "everyone who is seen")
    target = Input[Pose2D]("pose", "a place in the frame of the odometry; goes before people")
    bearing = Input[float]("double", "radians to the left of a color or an object that is seen")
    range = Input[float]("double", "meters to it; both together go before people")
    goal = Output[Pose2D]("pose", "where to go and what to face; nothing: stay")
    is_following = Output[bool]("boolean", "whether it has the target in sight")

    def start(self, context: Context) -> None:
        super().start(context)
        self._events = context.events
        manner = FollowingManner(distance=self.distance, patience_s=self.patience_s)
        self._following = Following(manner)

    def compute(self, now: float, dt: float) -> None:
        pose, following = self._odometry.pose(now), self._following
        before = following.pursuit
        if (sight := self._given(pose)) is not None:
            following.see(now, pose, *sight)
        else:
            following.look(now, pose, self.people.value, self.person)
        goal = following.goal(now, pose)
        if goal is not None:
            self.goal.send(goal)
        self.is_following.send(following.pursuit is Pursuit.FOLLOWING)
        if following.pursuit is not before:
            tell(self._events, following.pursuit)

    def _given(self, pose: Pose2D) -> tuple[float, float] | None:
        """Bearing and distance of a target that is not a person."""
        if (target := self.target.value) is not None:
            x, y = seen_from(pose, target.x, target.y)
            return math.atan2(y, x), math.hypot(x, y)
        bearing, distance = self.bearing.value, self.range.value
        if bearing is not None and distance is not None:
            return bearing, distance
        return None


class Wander(_FromPose):
    """Goes about, from one place near by to the next."""

    goal = Output[Pose2D]("pose", "where to go next")

    def start(self, context: Context) -> None:
        super().start(context)
        self._wandering = Wandering(context.seed_for(self.id))

    def compute(self, now: float, dt: float) -> None:
        self.goal.send(self._wandering.goal(now, self._odometry.pose(now)))


class DeadReckoning(_FromPose):
    """Sends the pose that the wheels tell, and how sure it is."""

    is_sensor = True
    track = Param(Wheels().track, "meters between the wheels", minimum=0.01, maximum=3)
    slip = Param(
        Wheels().slip,
        "standard deviation of a wheel's way after a meter, meters",
        minimum=0,
        maximum=1,
    )

    pose = Output[Pose2D]("pose", "where the base is")
    covariance = Output[tuple[float, ...]](
        "doublearray", "of x, y, heading: 9 numbers, row by row; m², m rad, rad²"
    )
    deviation = Output[float]("double", "standard deviation of the position, meters")

    def start(self, context: Context) -> None:
        super().start(context)
        self._estimate: Estimate | None = None

    def compute(self, now: float, dt: float) -> None:
        pose = self._odometry.pose(now)
        before = self._estimate or Estimate(pose)
        way = arc_between(before.pose, pose)
        after = rolled_on(before, *way, Wheels(self.track, self.slip))
        self._estimate = Estimate(pose, after.covariance)
        self.pose.send(pose)
        self.covariance.send(tuple(float(value) for value in after.covariance.flat))
        self.deviation.send(self._estimate.position_deviation)
