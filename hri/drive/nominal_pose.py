"""Where the robot was meant to get: relative motions start there, so their errors do not add up.

Each motion ends some millimeters off. The next one starts at the place that the last one led to,
as long as nothing moved the robot since; otherwise where it stands.
"""

from __future__ import annotations

import math

from hri.core.geometry import wrapped
from hri.core.latest import Board
from hri.core.signals import Pose2D

ARRIVED = "drive.arrived"
"""The board slot with the place that the last motion led to, and the pose in which it ended."""
EXACT, EXACT_ANGLE = 0.02, 0.05
"""Meters and radians from its goal at which a motion has led there."""
STILL = 0.005
"""Meters and radians that a robot which nobody moved is off its last pose at most."""


def nominal_pose(board: Board, pose: Pose2D) -> Pose2D:
    """Where a motion starts, for a robot that stands at `pose`."""
    arrived: tuple[Pose2D, Pose2D] | None = board.slot(ARRIVED).value
    if arrived is None:
        return pose
    goal, stood = arrived
    has_moved = math.dist((pose.x, pose.y), (stood.x, stood.y)) > STILL
    has_turned = abs(wrapped(pose.heading - stood.heading)) > STILL
    return pose if has_moved or has_turned else goal


def note_arrival(board: Board, goal: Pose2D, pose: Pose2D, now: float) -> None:
    """A motion to a goal has ended at `pose`; one that ended far from it ended where it is."""
    is_exact = math.dist((pose.x, pose.y), (goal.x, goal.y)) <= EXACT
    is_facing = abs(wrapped(pose.heading - goal.heading)) <= EXACT_ANGLE
    board.slot(ARRIVED).set((goal if is_exact and is_facing else pose, pose), now)
