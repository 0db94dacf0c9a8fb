"""Light that goes with its shape: how the anchors of a gradient move when the outline does.

A row of a baked face moves outlines any way it likes, but a gradient only by an affine map, that
which fits the outline best: p -> p + L p + b. The half-axes of a radial gradient go where it takes
them. The lines of equal color of a linear one, from A to A + d, must be those to which it takes the
old ones, and they stand at right angles to d; so d changes, to first order, by

    2 d (d . L d) / (d . d) - transposed(L) d
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.face.drawing.outline import Points
from hri.face.drawing.paint import Gradient

_FLAT = 0.02
"""What is thinner, of its length, says nothing about how its thickness moves."""
_FADED = 0.02
"""Opacity, or share of a radius, that nobody sees."""


def with_light(outline: Points, paint: Gradient, move: Points) -> Points:
    """How the points of a shape move when its outline [n, 2] wants to move by `move`.

    The outline first, then the anchors of its gradient. An outline that lies where its light has
    faded out goes along with the light, so that it is not seen when the head turns either.
    """
    linear, shift = _fitted(outline, move)
    light = paint.anchors @ linear.T + shift
    if not paint.is_radial:
        way = paint.anchors[1] - paint.anchors[0]
        along = way @ linear @ way / max(way @ way, 1e-9)
        light[1] = light[0] + 2 * way * along - linear.T @ way
    elif _fades_out(outline, paint):
        move = outline @ linear.T + shift
    return np.concatenate([move, light])


def _fitted(points: Points, move: Points) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The matrix [2, 2] and the shift [2] of the affine map that moves points most like that."""
    middle = points.mean(axis=0)
    size = max(float(np.abs(points - middle).max()), 1e-9)
    solved, *_ = np.linalg.lstsq((points - middle) / size, move - move.mean(axis=0), rcond=_FLAT)
    linear = solved.T / size
    return linear, move.mean(axis=0) - linear @ middle


def _fades_out(outline: Points, paint: Gradient) -> bool:
    """Whether a radial gradient is transparent all along the outline."""
    axes = paint.anchors[1:] - paint.anchors[0]
    if paint.stops[-1].opacity > _FADED or abs(np.linalg.det(axes)) < 1e-9:
        return False
    away = np.hypot(*((outline - paint.anchors[0]) @ np.linalg.inv(axes)).T)
    return bool(away.min() > 1 - _FADED)
