"""What a camera does to a picture: light that flickers, blur, a hand that trembles, noise."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image

SHEET_MARGIN = 64
"""Pixels that the sheet of noise is larger than a picture."""
FLICKER_STEP = 2.3
"""Radians of the lamp's flicker between two pictures: a lamp of 100 Hz is seen in beats."""


@dataclass(frozen=True, slots=True)
class Lens:
    """A camera's faults; the same seed and number give the same picture."""

    noise: float = 2.0
    """Standard deviation of the sensor's noise, of 255."""
    light: float = 1.0
    """Factor of the brightness."""
    flicker: float = 0.0
    """How far the light goes up and down, as a part of it."""
    blur: float = 0.0
    """Standard deviation of the blur, pixels."""
    jitter: float = 0.0
    """Standard deviation of the camera's trembling, pixels."""
    seed: int = 0

    def take(self, image: Image, index: int) -> Image:
        """The picture of that number in the film."""
        dice = np.random.default_rng((self.seed, index))
        down, right = dice.integers(0, SHEET_MARGIN, 2)
        taken: NDArray[Any] = image
        if self.jitter:
            (x, y) = dice.normal(0.0, self.jitter, 2)
            taken = _moved(taken, x, y)
        if self.blur:
            taken = cv2.GaussianBlur(taken, (0, 0), self.blur)
        light = self.light * (1 + self.flicker * np.sin(FLICKER_STEP * index))
        if light != 1.0:
            taken = cv2.convertScaleAbs(taken, alpha=float(light))
        if self.noise:
            height, width = image.shape[:2]
            sheet = _sheet(width, height, self.noise, self.seed)
            grain = sheet[down : down + height, right : right + width]
            taken = cv2.add(taken, grain, dtype=cv2.CV_8U)
        return np.asarray(taken, np.uint8)


def _moved(image: Image, x: float, y: float) -> Image:
    height, width = image.shape[:2]
    way = np.array([[1, 0, x], [0, 1, y]], np.float32)
    border = cv2.BORDER_REPLICATE
    return np.asarray(cv2.warpAffine(image, way, (width, height), borderMode=border), np.uint8)


@lru_cache(maxsize=4)
def _sheet(width: int, height: int, noise: float, seed: int) -> NDArray[np.int16]:
    shape = (height + SHEET_MARGIN, width + SHEET_MARGIN, 3)
    drawn = np.random.default_rng(seed).normal(0.0, noise, shape)
    return np.rint(drawn).astype(np.int16)
