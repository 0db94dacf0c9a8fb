"""Behaviors that say where to go: after somebody, or just about; and how sure the pose is.

tracker.people -> Hri.FollowTarget -> goal -> Hri.ObstacleAvoidance
"""

from __future__ import annotations

import math

from hri.behavior.behavior import Context
from hri.behavior.device import DeviceBehavior
from hri.behavior.ports import Input, Output, Param
from hri.core.geometry import seen_from
from hri.core.signals import People, Pose2D
from hri.drive.following import Following, Manner, Pursuit, tell
from hri.drive.odometry import Estimate, Wheels, arc_between, rolled_on
from hri.drive.wandering import Wandering
from hri.hal.drive import Odometry


class _FromPose(DeviceBehavior):
    """Base of what reads the pose of the base."""

    category = "drive"
    odometry_id = Param("odometry", "id of the odometry")

    def start(self, context: Context) -> None:
        super().start(context)
        self._odometry = self.obtain(self.odometry_id, Odometry)


class FollowTarget(_FromPose):
    """Follows a person, or a place that is given, at a distance, and faces it.

    Without a sight of it for a second it goes to where it saw the target last and looks around.
    Raises `target.found` and `target.lost` (`given_up`: whether the search is over).
    """

    distance = Param(1.2, "meters between the middles of both", minimum=0.3, maximum=5)
    patience_s = Param(20.0, "seconds out of sight until it gives up", minimum=1, maximum=600)
    person = Param("", "id of the person; empty takes who is attended to, or the nearest")

    people = Input[People]("people", "everybody who is seen")
    target = Input[Pose2D]("pose", "a place in the frame of the odometry; goes before people")
    bearing = Input[float]("double", "radians to the left of a color or an object that is seen")
    range = Input[float]("double", "meters to it; both together go before people")
    goal = Output[Pose2D]("pose", "where to go and what to face; nothing: stay")
    is_following = Output[bool]("boolean", "whether it has the target in sight")

    def start(self, context: Context) -> None:
        super().start(context)
        self._events = context.events
        manner = Manner(distance=self.distance, patience_s=self.patience_s)
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
        """Bearing and distance of a target that is no person."""
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
