"""How sure it is that a blob is the thing that has a color, and not something of a like color.

Jeans and wood have the chroma of a blue and of an orange ball, nearly. A thing is as bright as when
its color was learned, compact, and set off from what is around it; what is scattered over the whole
picture, or runs into its surroundings, is hardly one.
"""

from __future__ import annotations

import math
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

BRIGHTNESS = 0.25, 0.6
"""Times the brightness that was learned: up to the first nothing is sure."""
COMPACT = 0.1, 0.6
"""Part of the smallest circle around it that a blob fills (Reock 1961)."""
SMOOTH = 0.05, 0.5
"""4 pi of its area to the square of the length of its outline: 1 for a disk (Polsby and Popper
1991)."""
CONTRAST = 5.0, 40.0
"""Levels of chroma between a blob and what is around it."""
SHARE = -0.5, 0.5
"""Part of all pixels of a color that a blob has."""
BEYOND, FARTHER = 1.15, 3.0
"""Times as far from its center as its outline, and pixels more: there its surroundings begin."""
POINTS = 24
"""Of an outline, about, that are looked at."""
FEWEST = 0.25
"""Part of the outline whose surroundings must be in the picture."""

Contour = Any


def set_apart(
    contour: Contour, pixels: float, chroma: NDArray[np.uint8], own: tuple[float, float]
) -> float:
    """How much a blob looks like one thing, 0 to 1.

    `pixels` is how many it has, `chroma` that of the picture, and `own` its mean chroma.
    """
    _, radius = cv2.minEnclosingCircle(contour)
    around = cv2.arcLength(contour, True) + math.pi
    return (
        ramp(pixels / (math.pi * (radius + 0.5) ** 2), COMPACT)
        * ramp(4 * math.pi * pixels / around**2, SMOOTH)
        * ramp(contrast(contour, chroma, own), CONTRAST)
    )


def contrast(contour: Contour, chroma: NDArray[np.uint8], own: tuple[float, float]) -> float:
    """Levels of chroma from a blob to what is around it, the median; infinite when that is out of
    the picture.
    """
    points = contour[:: 1 + len(contour) // POINTS].reshape(-1, 2).astype(np.float32)
    arms = points - points.mean(axis=0)
    far = np.sqrt((arms**2).sum(axis=1, keepdims=True)) + 1e-9
    around = np.rint(points + arms * ((BEYOND - 1) + FARTHER / far)).astype(np.intp)
    height, width = chroma.shape[:2]
    around = around[((around >= 0) & (around < (width, height))).all(axis=1)]
    if len(around) < FEWEST * len(points):
        return math.inf
    apart = chroma[around[:, 1], around[:, 0]] - np.array(own, np.float32)
    return math.sqrt(np.sort((apart**2).sum(axis=1))[len(apart) // 2])


def ramp(value: float, bounds: tuple[float, float]) -> float:
    """0 up to the first bound, 1 from the second."""
    return min(1.0, max(0.0, (value - bounds[0]) / (bounds[1] - bounds[0])))
