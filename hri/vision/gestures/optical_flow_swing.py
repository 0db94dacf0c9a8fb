"""How a head swings, from how its face moves in the picture.

The motion of a face as a part of its size gives the swings of the head. The angles tell
movements, not where the head has turned to stay: they fall back to 0 within seconds, so that
errors do not add up and a step aside is not taken for a turned head.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hri.vision.detectors.flow import Shift

RADIUS = 0.66
"""Distance from the joint of the head to the points of the face, in sizes of the face."""
FADE = 1.5
"""Seconds in which an angle falls to a third."""
MAX_ANGLE = math.radians(60)
"""Angles stay within; flow alone cannot follow a head any further."""
WALK_SMOOTHING = 0.4
"""Seconds over which the motion of the whole person is averaged."""
WALK_SPEED = 0.8
"""Sizes of the face a second; above, the person walks and the swings are not those of a head."""
WALK_GROWTH = 0.25
"""Relative growth of the face a second, likewise."""


@dataclass
class OpticalFlowSwing:
    """Pitch and yaw of a head from the motion of its face, without the walk of the person."""

    pitch: float = 0.0
    """Radians, positive down."""
    yaw: float = 0.0
    """Radians, positive to the person's left."""
    _speed_x: float = 0.0
    _speed_y: float = 0.0
    _growth: float = 0.0

    def fade(self, elapsed: float) -> None:
        """Let the angles decay for a time, seconds."""
        part = math.exp(-max(0.0, elapsed) / FADE)
        self.pitch *= part
        self.yaw *= part

    def move(self, shift: Shift, size: float, elapsed: float) -> None:
        """Take the motion of a face of a size in pixels, over seconds above 0."""
        x, y = shift.x / size, shift.y / size
        blend = min(1.0, elapsed / WALK_SMOOTHING)
        self._speed_x += (x / elapsed - self._speed_x) * blend
        self._speed_y += (y / elapsed - self._speed_y) * blend
        self._growth += (shift.growth / elapsed - self._growth) * blend
        speed = math.hypot(self._speed_x, self._speed_y)
        if speed < WALK_SPEED and abs(self._growth) < WALK_GROWTH:
            self.yaw = _clamped(self.yaw + x / RADIUS)
            self.pitch = _clamped(self.pitch + y / RADIUS)


def _clamped(angle: float) -> float:
    return min(MAX_ANGLE, max(-MAX_ANGLE, angle))
