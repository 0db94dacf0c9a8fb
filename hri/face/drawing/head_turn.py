"""How a drawn head turns: its points ride on a dome, as linear and quadratic rows.

A point of the face lies at depth z on a dome over the ellipse of the head, z = depth (1 - r r r)
with r from 0 at the center to 1 at the rim. (Half an ellipsoid would stand upright at its rim: what
is drawn across the rim would tear.) Turned by a yaw a and a pitch b, first pitch, then yaw, as a
neck with a pan and a tilt joint turns, with x, y from the center, x to the right and y down, it is
seen at

    x' = x cos a + (z cos b + y sin b) sin a        y' = y cos b - z sin b

For weights u, v from -1 to 1 of the limits A, B that is, to second order,

    x' - x = u z sin A + u u x (cos A - 1) + u v y sin A sin B
    y' - y = -v z sin B + v v y (cos B - 1)

which is off by less than 2 % of z at 25 degrees. Points on the rim or beyond stay in place, like
the outline of a turning ball, unless they have their own depth.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from fnmatch import fnmatchcase

import numpy as np
from numpy.typing import NDArray

from hri.face.drawing.outline import Points
from hri.face.settings import HeadSettings
from hri.face.vocabulary import TURNS

YAW, PITCH = TURNS
PRODUCTS = ((YAW, YAW), (PITCH, PITCH), (YAW, PITCH))
"""The rows that are weighted by the product of two turns."""
Row = str | tuple[str, str]
"""A turn, or one of `PRODUCTS`."""


def depth_of(id: str, head: HeadSettings) -> float | None:
    """How far a part lies in front of the head's surface; None when it does not turn at all.

    Of several patterns in [head.depths] that fit the last one counts.
    """
    if any(fnmatchcase(id, pattern) for pattern in head.still):
        return None
    fitting = [depth for pattern, depth in head.depths.items() if fnmatchcase(id, pattern)]
    return fitting[-1] if fitting else 0.0


def turned(points: Points, head: HeadSettings, depth: float) -> Mapping[Row, Points]:
    """How points [n, 2] move at the limit of each turn and for each of `PRODUCTS`."""
    away = points - np.array(head.center)
    square = np.minimum(((away / np.array(head.radius)) ** 2).sum(axis=1), 1.0)
    z = head.depth * (1 - square**1.5) + depth
    x, y = (away * (1 - square**2)[:, None]).T
    yaw, pitch = math.radians(head.yaw), math.radians(head.pitch)
    still = np.zeros(len(points))
    moves: dict[Row, tuple[NDArray[np.float64], NDArray[np.float64]]] = {
        YAW: (z * math.sin(yaw), still),
        PITCH: (still, -z * math.sin(pitch)),
        (YAW, YAW): (x * (math.cos(yaw) - 1), still),
        (PITCH, PITCH): (still, y * (math.cos(pitch) - 1)),
        (YAW, PITCH): (y * math.sin(yaw) * math.sin(pitch), still),
    }
    return {name: np.column_stack(move) for name, move in moves.items()}
