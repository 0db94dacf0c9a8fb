"""Which sides of the robot a range sensor covers, and how far from the robot something is.

The four quadrants lie around the middle of the robot's box; the diagonals at 45 degrees divide
them. The direction in which a sensor looks decides. One that looks right along a diagonal counts
for each of the two quadrants on whose side of the middle it sits: at (20, 0) cm with a yaw of
pi/4 it sits ahead of the middle, but neither left nor right, so it counts for the front alone; at
(20, 10) it sits ahead and left, and counts for both. In the very middle it counts for both.

Meters and radians in the robot's frame: x ahead, y to the left.
"""

from __future__ import annotations

import math
from enum import IntEnum

from hri.core.geometry import Pose3D, seen_from
from hri.core.signals import Pose2D
from hri.hal.shape import Shape

TOLERANCE = 1e-6
"""Radians off a diagonal, or meters off an axis, that count as none."""
STEEPEST = math.pi / 4
"""Radians; a sensor that looks up or down by more sees the floor or the ceiling."""


class Quadrant(IntEnum):
    """The sides of the robot, in their output order."""

    FRONT = 0
    LEFT = 1
    BACK = 2
    RIGHT = 3

    @property
    def direction(self) -> float:
        """Radians."""
        return self * math.pi / 2


def quadrants(sensor: Pose3D, box: Shape) -> frozenset[Quadrant]:
    """The sides that a sensor covers: one or two, none when it looks too steeply up or down."""
    if abs(sensor.pitch) > STEEPEST:
        return frozenset()
    turned = sensor.yaw - box.yaw
    off = {side: abs(math.remainder(turned - side.direction, 2 * math.pi)) for side in Quadrant}
    nearest = min(off.values())
    looked_at = frozenset(side for side in Quadrant if off[side] - nearest <= 2 * TOLERANCE)
    if len(looked_at) == 1:
        return looked_at
    ahead, left = seen_from(_middle(box), sensor.x, sensor.y)
    sits_at = {
        Quadrant.FRONT: ahead > TOLERANCE,
        Quadrant.LEFT: left > TOLERANCE,
        Quadrant.BACK: ahead < -TOLERANCE,
        Quadrant.RIGHT: left < -TOLERANCE,
    }
    return frozenset(side for side in looked_at if sits_at[side]) or looked_at


def clearance(sensor: Pose3D, reading: float, box: Shape) -> float:
    """Meters from the nearest edge of the box to what a sensor sees, 0 inside of the box.

    Infinity when it sees nothing. Heights do not count: the box reaches from floor to ceiling.
    """
    if math.isinf(reading):
        return math.inf
    reach = reading * math.cos(sensor.pitch)
    x = sensor.x + reach * math.cos(sensor.yaw)
    y = sensor.y + reach * math.sin(sensor.yaw)
    ahead, left = seen_from(_middle(box), x, y)
    beyond_length = max(0.0, abs(ahead) - box.lx / 2)
    beyond_width = max(0.0, abs(left) - box.ly / 2)
    return math.hypot(beyond_length, beyond_width)


def _middle(box: Shape) -> Pose2D:
    return Pose2D(box.x, box.y, box.yaw)
