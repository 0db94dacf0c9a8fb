"""A picture as the detectors want it: gray and small."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image

Gray = NDArray[np.uint8]
"""Brightness, shape [height, width], 0 to 255."""

MAX_SIDE = 320
"""Pixels of the longer side; more costs time and finds no nearer face."""
MIN_SIDE = 32
"""Pixels; no face is recognizable in less."""


@dataclass(frozen=True, slots=True)
class Picture:
    """A gray picture and how many pixels of the original each of its pixels stands for."""

    gray: Gray
    scale: float


def gray_picture(image: Image) -> Picture | None:
    """None for what is not an RGB picture of 8 bits with at least MIN_SIDE pixels a side."""
    if getattr(image, "dtype", None) != np.uint8 or image.ndim != 3 or image.shape[2] != 3:
        return None
    if min(image.shape[:2]) < MIN_SIDE:
        return None
    scale = max(1.0, max(image.shape[:2]) / MAX_SIDE)
    size = max(1, round(image.shape[1] / scale)), max(1, round(image.shape[0] / scale))
    small = np.ascontiguousarray(image)
    if scale > 1.0:
        small = np.asarray(cv2.resize(small, size, interpolation=cv2.INTER_AREA), np.uint8)
    return Picture(np.asarray(cv2.cvtColor(small, cv2.COLOR_RGB2GRAY), np.uint8), scale)
