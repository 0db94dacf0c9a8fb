"""Drawing with soft edges, shared by what makes up the picture of a person."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float32]
"""A value, or a few, for each point of a plane: shape [height, width] or [height, width, n]."""
Point = tuple[float, float]
Color = tuple[float, float, float]
"""Red, green, blue, 0 to 255."""

FINE_BITS = 4
"""Outlines are drawn to a sixteenth of a pixel."""


def paint(picture: Field, color: Field, cover: Field) -> None:
    """Lay a color over the picture where `cover` is 1, in part where it is less."""
    picture += (color - picture) * cover[..., None]


def filled(shape: tuple[int, ...], outlines: Sequence[NDArray[Any]], soft: float) -> Field:
    """1 inside of the outlines, 0 outside, with an edge some pixels soft."""
    mask = np.zeros(shape[:2], np.uint8)
    for outline in outlines:
        cv2.fillPoly(mask, [fine(outline)], 255, cv2.LINE_AA, FINE_BITS)
    return np.asarray(cv2.GaussianBlur(mask, (0, 0), soft), np.float32) / np.float32(255)


def fine(points: NDArray[Any]) -> NDArray[np.int32]:
    """Pixels as OpenCV's drawing takes them: whole numbers of sixteenths."""
    fine: NDArray[np.int32] = np.rint(points * 2**FINE_BITS).astype(np.int32)
    return fine
