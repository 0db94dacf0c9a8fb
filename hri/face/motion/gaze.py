"""Looking: a direction or a point in space becomes angles of the eyes and of the head.

The eyes are there first; the head sets out 0.1 s later, takes its share, and the eyes turn back by
as much as the head turns, so that the look stays where it is. Both eyes turn inward to what is
near. Angles here are degrees as the viewer sees them: x to the viewer's right, y up.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from hri.core.errors import HriError
from hri.core.geometry import ROBOT_FROM_CAMERA, Pose3D
from hri.core.signals import Gaze
from hri.face.motion.spring import Follower, Values
from hri.face.settings import Settings

Point = tuple[float, float, float]

EYE_DISTANCE = 0.065
"""Meters between the eyes of a person."""
NEAREST = 0.1
"""Meters; what is nearer is looked at as if it were there."""
HEAD_DELAY = 0.1
"""Seconds from the eyes to the head; people's is 50 to 150 ms."""
_EYES, _HEAD = 60.0, 8.0
"""Stiffness, radians a second: 65 ms to 90 % of a jump of the eyes, 0.5 s of a turn of the head."""


@dataclass(frozen=True, slots=True)
class GazeAngles:
    """Where eyes and head are turned now."""

    eyes: Gaze
    """In the head, -1 to 1 of their range."""
    yaw: float
    pitch: float
    """Of the head, -1 to 1 of its limits."""
    inward: float
    """What each eye turns to the nose, of its range to the side."""


class GazeController:
    """Eyes that lead and a head that follows, for one face."""

    def __init__(self, settings: Settings) -> None:
        head = settings.head
        self._eye_range = np.array(settings.gaze.degrees)
        self._head_range = np.zeros(2) if head is None else np.array([head.yaw, head.pitch])
        self._share = settings.gaze.head_share
        self._goal, self._inward = np.zeros(2), 0.0
        self._past: deque[tuple[float, Values]] = deque([(-math.inf, self._goal)])
        self._eyes = Follower(np.zeros(3))
        self._head = Follower(np.zeros(2))

    def look(self, gaze: Gaze) -> float:
        """Look there from now on; how many degrees the eyes will jump.

        Raises HriError for what is not finite.
        """
        before = self._goal
        self._goal, self._inward = self._angles(gaze)
        return float(np.hypot(*(self._goal - before)))

    def follow(self, now: float, dt: float) -> GazeAngles:
        """Where eyes and head are `dt` seconds after the last call."""
        wanted = self._eyes.follow(np.append(self._goal, self._inward), dt, _EYES)
        head = self._head.follow(self._head_goal(now), dt, _HEAD)
        x, y = np.clip((wanted[:2] - head) / self._eye_range, -1, 1)
        yaw, pitch = head / np.maximum(self._head_range, 1e-9)
        return GazeAngles(Gaze(float(x), float(y)), float(yaw), float(pitch), float(wanted[2]))

    def _angles(self, gaze: Gaze) -> tuple[Values, float]:
        values = (gaze.x, gaze.y) if gaze.point is None else gaze.point
        if not all(map(math.isfinite, values)):
            raise HriError(f"the gaze {values} is not finite - give finite numbers")
        if gaze.point is None:
            return np.clip(values, -1, 1) * self._eye_range, 0.0
        far = self._eye_range + self._head_range
        inward = math.degrees(math.atan(EYE_DISTANCE / 2 / max(math.hypot(*values), NEAREST)))
        return np.clip(direction(gaze.point), -far, far), inward / float(self._eye_range[0])

    def _head_goal(self, now: float) -> Values:
        """What the head heads for: its share of where the eyes looked a moment ago."""
        if self._past[-1][1] is not self._goal:
            self._past.append((now, self._goal))
        while len(self._past) > 1 and self._past[1][0] <= now - HEAD_DELAY:
            self._past.popleft()
        goal = self._past[0][1]
        far = np.abs(goal)
        turn = np.sign(goal) * np.maximum(self._share * far, far - self._eye_range)
        bounded: Values = np.clip(turn, -self._head_range, self._head_range)
        return bounded


def direction(point: Point) -> tuple[float, float]:
    """Degrees to the viewer's right and up, from the face to a point of the robot's frame.

    The robot's left is the right of whoever stands before it. Straight ahead for the face itself.
    """
    x, y, z = point
    return math.degrees(math.atan2(y, x)), math.degrees(math.atan2(z, math.hypot(x, y)))


def from_camera(point: Point, mount: Pose3D | None = None) -> Point:
    """A point of a camera's frame (z ahead, x right, y down) in the frame of the face; meters.

    `mount` is where the camera is, seen from between the eyes, in the robot's axes.
    """
    mount = mount or Pose3D()
    x, y, z = mount.rotation() @ (ROBOT_FROM_CAMERA @ point) + (mount.x, mount.y, mount.z)
    return float(x), float(y), float(z)
