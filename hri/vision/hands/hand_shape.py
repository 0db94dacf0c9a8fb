"""What shape a hand has: which fingers are straight, and what that is."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Landmarks

Vectors = NDArray[np.float64]

OPEN, POINTING, THUMB, FIST = "open", "pointing", "thumb", "fist"
SHAPES = {
    # thumb, index, middle, ring, little finger; None is either
    OPEN: (None, True, True, True, True),
    POINTING: (None, True, False, False, False),
    THUMB: (True, False, False, False, False),
    FIST: (False, False, False, False, False),
}
WRIST = 0
ROOTS = (1, 5, 9, 13, 17)
"""Root of each finger: of the thumb at the wrist, of the others their knuckle."""
STRAIGHT = math.radians(60)
"""Most by which the end of a straight finger is turned from the bone of the hand that it grows
from, and half of that within the finger."""
THUMB_STRAIGHT = math.radians(50)
"""Most that a straight thumb is bent."""
THUMB_AWAY = 0.55
"""Least distance of the tip of a straight thumb from the knuckle and the first joint of the index
finger, in lengths of the palm."""


@dataclass(frozen=True, slots=True)
class HandShape:
    """Which fingers are straight, the thumb first, and the name of it."""

    straight: tuple[bool, ...]
    name: str
    """One of `SHAPES`; empty for any other."""


def hand_shape(points: Landmarks) -> HandShape:
    """The shape of a hand from its 21 points in space, shape [21, 3], of any unit.

    Points all in one place, or not finite, have no straight finger and no name.
    """
    places = points.astype(np.float64)
    palm = float(np.linalg.norm(places[9] - places[WRIST]))
    if not (math.isfinite(palm) and palm > 0 and np.isfinite(places).all()):
        return HandShape((False,) * 5, "")
    straight = (_is_thumb_straight(places, palm), *(_is_straight(places, n) for n in ROOTS[1:]))
    names = (name for name, wanted in SHAPES.items() if _fits(straight, wanted))
    return HandShape(straight, next(names, ""))


def shows_palm(landmarks: Landmarks, is_left: bool) -> bool:
    """Whether a hand in a picture, shape [21, 3] in pixels, shows its palm and not its back."""
    (x, y), (other_x, other_y) = (landmarks[root, :2] - landmarks[WRIST, :2] for root in (5, 17))
    # With the fingers up, the index finger of a left palm is at the left of the little finger.
    return bool((x * other_y - y * other_x > 0) == is_left)


def _fits(straight: tuple[bool, ...], wanted: tuple[bool | None, ...]) -> bool:
    return all(
        asked is None or asked == found for found, asked in zip(straight, wanted, strict=True)
    )


def _is_straight(places: Vectors, root: int) -> bool:
    bone, first, second = (
        places[root] - places[WRIST],
        places[root + 1] - places[root],
        places[root + 3] - places[root + 1],
    )
    return _angle(bone, second) < STRAIGHT and _angle(first, second) < STRAIGHT / 2 + 0.2


def _is_thumb_straight(places: Vectors, palm: float) -> bool:
    first, last = places[2] - places[1], places[4] - places[3]
    away = min(float(np.linalg.norm(places[4] - places[near])) for near in (5, 6))
    return _angle(first, last) < THUMB_STRAIGHT and away > THUMB_AWAY * palm


def _angle(first: Vectors, second: Vectors) -> float:
    """Between two directions, radians; half a turn where one of them has no length."""
    size = float(np.linalg.norm(first) * np.linalg.norm(second))
    return math.acos(min(1.0, max(-1.0, float(first @ second) / size))) if size > 0 else math.pi
