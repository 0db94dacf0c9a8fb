"""Pictures as the detectors want them: gray and small, or evenly bright."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeGuard

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.hal.picture import LARGEST_SIDE

Gray = NDArray[np.uint8]
"""Brightness, shape [height, width], 0 to 255."""

MAX_SIDE = 320
"""Pixels of the longer side of a gray picture; more costs time and finds no nearer face."""
MIN_SIDE = 32
"""Pixels; no face is recognizable in less."""
AVERAGED = 4
"""Each pixel of a gray picture is the average of this many across and down, or a few more."""

BRIGHT = 235
"""How bright the brightest fiftieth of an evened picture is."""
MAX_GAIN = 8.0
"""Largest gain for a dark picture: beyond it there is only noise."""
SPARSE = 4
"""The brightness is measured at every fourth pixel of every fourth row."""


@dataclass(frozen=True, slots=True)
class Picture:
    """A gray picture and how many pixels of the original each of its pixels stands for."""

    gray: Gray
    scale: float


def is_picture(image: Any) -> TypeGuard[Image]:
    """Whether it is an RGB picture of 8 bits with sides from MIN_SIDE to LARGEST_SIDE."""
    if not isinstance(image, np.ndarray) or image.dtype != np.uint8:
        return False
    if image.ndim != 3 or image.shape[2] != 3:
        return False
    return bool(min(image.shape[:2]) >= MIN_SIDE and max(image.shape[:2]) <= LARGEST_SIDE)


def gray_picture(image: Image) -> Picture | None:
    """None for an invalid picture."""
    if not is_picture(image):
        return None
    scale = max(1.0, max(image.shape[:2]) / MAX_SIDE)
    size = max(1, round(image.shape[1] / scale)), max(1, round(image.shape[0] / scale))
    # Of a very large picture not all pixels are needed for the average.
    step = max(1, int(scale / AVERAGED))
    small = np.ascontiguousarray(image[::step, ::step])
    if scale > 1.0:
        small = np.asarray(cv2.resize(small, size, interpolation=cv2.INTER_AREA), np.uint8)
    return Picture(np.asarray(cv2.cvtColor(small, cv2.COLOR_RGB2GRAY), np.uint8), scale)


def darkness(image: Image) -> float:
    """How many times brighter a picture must be made, 1 for one in good light, to `MAX_GAIN`."""
    brightest = np.percentile(image[::SPARSE, ::SPARSE].max(axis=2), 98)
    return min(MAX_GAIN, max(1.0, BRIGHT / max(1.0, float(brightest))))


def evened(image: Image) -> NDArray[np.float32]:
    """The picture from 0 to 1, a dark one brightened: the networks know faces in good light."""
    gain = darkness(image)
    bright: NDArray[np.float32] = np.minimum(image.astype(np.float32) * (gain / 255), 1.0)
    return bright
