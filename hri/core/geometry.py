"""Frames and poses: where things are, seen from the robot or from its camera.

The robot's frame is right-handed: x points ahead, y to the left, z up; positive yaw turns to the
left. The camera's frame has z ahead, x to the right, y down. Meters and radians.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Pose2D

Matrix = NDArray[np.float64]

ROBOT_FROM_CAMERA: Matrix = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
"""Turns a direction of the camera's frame into one of the robot's, for a camera that looks ahead;
its transpose turns it back."""


@dataclass(frozen=True, slots=True)
class Pose3D:
    """Where something is fixed and how it is turned: roll about x first, then pitch, then yaw."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0

    def rotation(self) -> Matrix:
        """Turns a direction seen from here into one seen from the frame this is fixed to."""
        (cr, sr), (cp, sp), (cy, sy) = (
            (math.cos(angle), math.sin(angle)) for angle in (self.roll, self.pitch, self.yaw)
        )
        return np.array(
            [
                [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                [-sp, cp * sr, cp * cr],
            ]
        )

    def then(self, inner: Pose3D) -> Pose3D:
        """Where something is that is fixed to this pose at `inner`."""
        rotation = self.rotation()
        x, y, z = rotation @ (inner.x, inner.y, inner.z) + (self.x, self.y, self.z)
        return Pose3D(float(x), float(y), float(z), *_angles(rotation @ inner.rotation()))


def _angles(rotation: Matrix) -> tuple[float, float, float]:
    """Roll, pitch and yaw of a rotation; straight up or down, roll counts as none."""
    level = math.hypot(rotation[0, 0], rotation[1, 0])
    pitch = math.atan2(-rotation[2, 0], level)
    if level < 1e-9:
        return 0.0, pitch, math.atan2(-rotation[0, 1], rotation[1, 1])
    roll = math.atan2(rotation[2, 1], rotation[2, 2])
    return roll, pitch, math.atan2(rotation[1, 0], rotation[0, 0])


def seen_from(frame: Pose2D, x: float, y: float) -> tuple[float, float]:
    """Where a point of the world lies when it is seen from a pose in it."""
    cos, sin = math.cos(frame.heading), math.sin(frame.heading)
    east, north = x - frame.x, y - frame.y
    return cos * east + sin * north, cos * north - sin * east


def placed(frame: Pose2D, x: float, y: float) -> tuple[float, float]:
    """Where in the world a point lies that is seen from a pose in it; undoes `seen_from`."""
    cos, sin = math.cos(frame.heading), math.sin(frame.heading)
    return frame.x + cos * x - sin * y, frame.y + sin * x + cos * y


def after_move(pose: Pose2D, x: float, y: float) -> Pose2D:
    """The pose after a relative move to the point (x, y) of the robot's own frame.

    Whatever way it took, the robot then faces along the straight line to there, and its axes are
    drawn again where it stands.
    """
    turned = math.atan2(y, x) if (x, y) != (0.0, 0.0) else 0.0
    return Pose2D(*placed(pose, x, y), pose.heading + turned)


def wrapped(angle: float) -> float:
    """The same direction within -pi to pi, radians."""
    return math.remainder(angle, math.tau)


def along_arc(pose: Pose2D, linear: float, angular: float) -> Pose2D:
    """Where a short arc of `linear` meters that turns by `angular` radians leads."""
    middle = pose.heading + angular / 2
    return Pose2D(
        pose.x + linear * math.cos(middle),
        pose.y + linear * math.sin(middle),
        pose.heading + angular,
    )
