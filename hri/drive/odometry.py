"""How sure the wheels' own pose is: dead reckoning with its covariance.

The wheels slip a little for each meter. What that does to x, y and heading follows from the
kinematics of two wheels (Chong and Kleeman, "Accurate odometry and error modeling for a mobile
robot", ICRA 1997; Siegwart and Nourbakhsh, "Introduction to Autonomous Mobile Robots", 5.2.4): the
variance of each wheel grows with the way it has rolled. Meters and radians.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from hri.core.geometry import Matrix, along_arc
from hri.core.signals import Pose2D


@dataclass(frozen=True, slots=True)
class Wheels:
    """What the wheels of a base are like."""

    track: float = 0.3
    """Meters between them."""
    slip: float = 0.003
    """Standard deviation of a wheel's way after one meter, meters."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """A pose and how sure it is."""

    pose: Pose2D = field(default_factory=Pose2D)
    covariance: Matrix = field(default_factory=lambda: np.zeros((3, 3)))
    """Of x, y and heading, shape [3, 3]: m², m rad, rad²."""

    @property
    def position_deviation(self) -> float:
        """Standard deviation of the position along its worst direction, meters."""
        return math.sqrt(max(0.0, float(np.linalg.eigvalsh(self.covariance[:2, :2])[-1])))

    @property
    def heading_deviation(self) -> float:
        """Standard deviation of the heading, radians."""
        return math.sqrt(max(0.0, float(self.covariance[2, 2])))


def rolled_on(before: Estimate, linear: float, angular: float, wheels: Wheels) -> Estimate:
    """The estimate after an arc of `linear` meters that turns by `angular` radians.

    The arc should be short: some centimeters, as between two readings. Raises ValueError for one
    that is not finite.
    """
    if not (math.isfinite(linear) and math.isfinite(angular)):
        raise ValueError(f"cannot roll {linear} m and {angular} rad - give finite numbers")
    middle = before.pose.heading + angular / 2
    cos, sin = math.cos(middle), math.sin(middle)
    by_pose = np.array([[1.0, 0.0, -linear * sin], [0.0, 1.0, linear * cos], [0.0, 0.0, 1.0]])
    aside = linear / (2 * wheels.track)
    # Columns: what a meter more of the right and of the left wheel does.
    by_wheels = np.array(
        [
            [cos / 2 - aside * sin, cos / 2 + aside * sin],
            [sin / 2 + aside * cos, sin / 2 - aside * cos],
            [1 / wheels.track, -1 / wheels.track],
        ]
    )
    half = angular * wheels.track / 2
    ways = np.diag([abs(linear + half), abs(linear - half)]) * wheels.slip**2
    covariance = by_pose @ before.covariance @ by_pose.T + by_wheels @ ways @ by_wheels.T
    return Estimate(along_arc(before.pose, linear, angular), (covariance + covariance.T) / 2)


def arc_between(before: Pose2D, after: Pose2D) -> tuple[float, float]:
    """The short arc from one pose to the next: meters, negative backward, and radians."""
    angular = math.remainder(after.heading - before.heading, math.tau)
    middle = before.heading + angular / 2
    x, y = after.x - before.x, after.y - before.y
    return x * math.cos(middle) + y * math.sin(middle), angular
