"""Where a square of known size is and how it is turned, from its four corners.

A small flat square looks nearly the same when it is tilted to either side. Both poses are computed
(Collins and Bartoli, "Infinitesimal plane-based pose estimation", 2014); the one whose corners fit
better is taken, and how much better says how sure it is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from hri.core.geometry import Matrix

CORNERS = np.array([(-1, 1, 0), (1, 1, 0), (1, -1, 0), (-1, -1, 0)], np.float64) / 2
"""Of a square with a side of 1: right, up, toward whoever reads it; the upper left one first."""
BLIND = 0.03
"""Pixels: corners are not known better than that."""
SURE = 1.5
"""Times by which the corners of the other pose must be farther off."""


@dataclass(frozen=True, eq=False, slots=True)
class SquarePose:
    """Of a square whose side is 1, in the camera's axes: right, down, away."""

    rotation: Matrix
    """Its columns are the right, the up and the normal of the square."""
    place: Matrix
    """Of its middle, in sides."""
    is_sure: bool
    """Whether the corners rule out that it is tilted to the other side."""


def square_pose(corners: Matrix, focal: float, size: tuple[int, int]) -> SquarePose | None:
    """The pose of a square from its corners, [4, 2], in pixels from the picture's upper left.

    `focal` is in pixels, `size` is the picture's. None where no pose has these corners.
    """
    lens = np.diag([focal, focal, 1.0])
    middle = np.array(size) / 2
    try:
        _, turns, places, errors = cv2.solvePnPGeneric(
            CORNERS, corners - middle, lens, None, flags=cv2.SOLVEPNP_IPPE_SQUARE
        )
    except cv2.error:  # corners on a line
        return None
    found = [
        (float(error), cv2.Rodrigues(turn)[0], np.asarray(place, np.float64).ravel())
        for turn, place, error in zip(turns, places, np.ravel(errors), strict=True)
        if np.isfinite(place).all() and place[2, 0] > 0
    ]
    if not found:
        return None
    (error, rotation, place), *others = sorted(found, key=lambda pose: pose[0])
    is_sure = all(other[0] > SURE * (error + BLIND) for other in others)
    return SquarePose(np.asarray(rotation), place, is_sure)


def tilt_of(pose: SquarePose) -> float:
    """Radians between the square's normal and the line of sight; 0 faces the camera."""
    line = pose.place / np.linalg.norm(pose.place)
    return math.acos(min(1.0, max(-1.0, float(-pose.rotation[:, 2] @ line))))
