"""A lamp in the corner of the face that is lit while the camera watches."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image

COLOR = (92, 214, 140)
"""Red, green, blue."""
RADIUS = 0.011
"""Of the height of the picture; never less than a pixel and a half."""
MARGIN = 0.045
"""Of the height of the picture, from the upper and the right edge to its middle."""
HALO = 2.2
"""Radii to which its light reaches."""
GLOW = 0.35
"""How much its light covers beside the lamp itself."""


def add_lamp(image: Image) -> Image:
    """A copy of the picture with the lamp lit."""
    height, width = image.shape[:2]
    cover = _cover(height)
    side = len(cover)
    top = min(max(0, round(MARGIN * height - side / 2)), max(0, height - side))
    right = min(width, round(width - MARGIN * height + side / 2))
    part = (slice(top, top + side), slice(max(0, right - side), right))
    lit = image.copy()
    share = cover[: lit[part].shape[0], : lit[part].shape[1], None]
    lit[part] = np.rint(lit[part] * (1 - share) + np.array(COLOR) * share).astype(np.uint8)
    return lit


@lru_cache(maxsize=8)
def _cover(height: int) -> NDArray[np.float32]:
    """How much of each pixel the lamp covers, for a picture so high; shape [side, side]."""
    radius = max(1.5, RADIUS * height)
    reach = int(np.ceil(HALO * radius))
    line = np.arange(-reach, reach + 1)
    away = np.hypot(line, line[:, None])
    lamp = np.clip(radius + 0.5 - away, 0, 1)
    halo = GLOW * np.clip(1 - away / (HALO * radius), 0, 1)
    return np.maximum(lamp, halo).astype(np.float32)
