"""A base with two wheels: follows velocities within its limits, slips, and stops when it hits.

All motion happens in steps of 10 ms that lie on an absolute grid, so where the base is at a time
does not depend on how often anyone asked.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass

from hri.core.geometry import along_arc
from hri.core.signals import Pose2D, Twist
from hri.hal.motion_profile import toward

STEP = 0.01
"""Seconds."""
WATCHDOG = 0.5
"""Seconds without a command after which the base brakes (the default of ros2_controllers)."""
BUMPER_TRAVEL = 0.01
"""Meters that the ring of the bumper stands out from the body."""

Clearance = Callable[[float, float, float], float]
"""Meters from the point (x, y) to the nearest surface, at a time."""


@dataclass(frozen=True, slots=True)
class HardwareLimits:
    """What the base can do: meters, radians, seconds."""

    linear: float = 0.5
    angular: float = 1.5
    acceleration: float = 0.5
    angular_acceleration: float = 2.0
    braking: float = 1.5
    """How fast it slows down at most; turning ends four times as fast in radians."""
    wheel: float = 0.6
    """Fastest a wheel's rim goes; a curve that needs more is driven more slowly."""
    track: float = 0.3
    """Between the wheels."""
    radius: float = 0.2
    """Of the round body."""


ORIGIN = Pose2D()
ORDINARY = HardwareLimits()


class Base:
    """The base's motion; `pose` is the truth in the room, `odometry` what its wheels believe."""

    def __init__(
        self,
        clearance: Clearance,
        start: Pose2D = ORIGIN,
        limits: HardwareLimits = ORDINARY,
        slip: float = 0.0,
        seed: int = 0,
    ) -> None:
        """`slip`: standard deviation of a wheel's slip after one meter, as a part of the way.

        Its variance grows with the way driven, the usual model of what odometry cannot know
        (Chong and Kleeman, "Accurate odometry and error modeling for a mobile robot", 1997).
        """
        self.limits = limits
        self.pose = start
        self.odometry = Pose2D()
        self.velocity = Twist()
        self.travelled = 0.0
        """Meters the wheels have rolled ahead, less those rolled back."""
        self.way = 0.0
        """Meters the wheels have turned, for the battery."""
        self._clearance = clearance
        self._slip = slip
        self._random = random.Random(seed)
        self._step = 0
        self.goal = Twist()
        """The velocity that it approaches."""
        self._is_braking = False
        self._brake_at = 0

    @property
    def is_touching(self) -> bool:
        """Whether something presses the bumper."""
        return self._room_left(self.pose) < BUMPER_TRAVEL

    def command(self, twist: Twist, now: float) -> None:
        """Go for this velocity; brakes unless another command comes in time.

        What is not finite is taken as a command to stand still.
        """
        self.advance(now)
        self.goal = reachable(twist, self.limits)
        self._is_braking = False
        self._brake_at = self._step + round(WATCHDOG / STEP)

    def brake(self, now: float) -> None:
        """Stand still as fast as the base can."""
        self.advance(now)
        self.goal, self._is_braking = Twist(), True

    def push(self, way: float, now: float) -> None:
        """Roll a base that stands and that nothing holds, meters ahead."""
        self.advance(now)
        moved = along_arc(self.pose, way, 0.0)
        if self.velocity == Twist() and self._is_free(moved):
            self.pose, self.odometry = moved, along_arc(self.odometry, way, 0.0)
            self.travelled += way

    def advance(self, now: float) -> None:
        """Let time pass until `now`; a time that has passed does nothing."""
        last = math.floor(now / STEP + 1e-6)
        while self._step < last:
            if self.velocity == Twist() == self.goal:
                self._step = last
                return
            self._move()

    def _move(self) -> None:
        """One step: watchdog, velocity, wheels, then the room has its say."""
        self._step += 1
        if self._step > self._brake_at:
            self.goal, self._is_braking = Twist(), True
        before, after = self.velocity, self._next_velocity()
        linear = (before.linear + after.linear) / 2 * STEP
        angular = (before.angular + after.angular) / 2 * STEP
        moved = along_arc(self.pose, *self._slipped(linear, angular))
        if self._is_free(moved):
            self.pose = moved
        else:
            linear, after = 0.0, Twist(0.0, after.angular)
            self.pose = Pose2D(self.pose.x, self.pose.y, moved.heading)
        self.odometry = along_arc(self.odometry, linear, angular)
        self.travelled += linear
        self.way += abs(linear) + abs(angular) * self.limits.track / 2
        self.velocity = after

    def _next_velocity(self) -> Twist:
        limits, now, goal = self.limits, self.velocity, self.goal
        is_slowing = self._is_braking or abs(goal.linear) < abs(now.linear)
        change = limits.braking if is_slowing else limits.acceleration
        is_slowing = self._is_braking or abs(goal.angular) < abs(now.angular)
        turn = 4 * limits.braking if is_slowing else limits.angular_acceleration
        return Twist(
            toward(now.linear, goal.linear, change * STEP),
            toward(now.angular, goal.angular, turn * STEP),
        )

    def _slipped(self, linear: float, angular: float) -> tuple[float, float]:
        """What the ground makes of a step of the wheels."""
        half = angular * self.limits.track / 2
        left, right = (
            way + self._random.gauss(0.0, 1.0) * self._slip * math.sqrt(abs(way))
            for way in (linear - half, linear + half)
        )
        return (left + right) / 2, (right - left) / self.limits.track

    def _is_free(self, pose: Pose2D) -> bool:
        """Whether the body fits there, or at least gets away from what it touches."""
        left = self._room_left(pose)
        return left > 0 or left >= self._room_left(self.pose)

    def _room_left(self, pose: Pose2D) -> float:
        return self._clearance(pose.x, pose.y, self._step * STEP) - self.limits.radius


def reachable(twist: Twist, limits: HardwareLimits) -> Twist:
    """The velocity within all limits that keeps the curve; none for what is not finite."""
    if not (math.isfinite(twist.linear) and math.isfinite(twist.angular)):
        return Twist()
    linear = max(-limits.linear, min(limits.linear, twist.linear))
    angular = max(-limits.angular, min(limits.angular, twist.angular))
    fastest = abs(linear) + abs(angular) * limits.track / 2
    factor = min(1.0, limits.wheel / fastest) if fastest else 1.0
    return Twist(linear * factor, angular * factor)
