"""The look of a thing of which only the name is known: a label with that name printed on it.

A model set that is a list of names holds the labels of these names, and in the simulated room
things without a picture bear them. So they are recognized by what the camera sees.
"""

from __future__ import annotations

import zlib
from functools import lru_cache

import cv2
import numpy as np

from hri.core.signals import Image

SIZE = 240
"""Pixels, width and height of a label."""
WIDTH = 0.3
"""Meters, of the thing it stands for."""
SHAPES = 40
MARGIN = 12


@lru_cache(maxsize=64)
def printed_label(name: str) -> Image:
    """Uint8, [`SIZE`, `SIZE`, 3], RGB: colored shapes and the name; the same for the same name."""
    dice = np.random.default_rng(zlib.crc32(name.encode()))
    label = np.full((SIZE, SIZE, 3), 235, np.uint8)
    for _ in range(SHAPES):
        color = [int(part) for part in dice.integers(20, 236, 3)]
        center = dice.integers(0, SIZE, 2)
        corners = center + dice.integers(-34, 35, (int(dice.integers(3, 6)), 2))
        cv2.fillPoly(label, [cv2.convexHull(corners.astype(np.int32))], color, cv2.LINE_AA)
    _print(label, name)
    cv2.rectangle(label, (0, 0), (SIZE - 1, SIZE - 1), (40, 40, 40), 4)
    label.flags.writeable = False
    return label


def _print(label: Image, name: str) -> None:
    font, thickness = cv2.FONT_HERSHEY_SIMPLEX, 3
    (width, height), _ = cv2.getTextSize(name, font, 1.0, thickness)
    scale = min(1.6, (SIZE - 2 * MARGIN) / max(1, width))
    at = (round((SIZE - width * scale) / 2), round((SIZE + height * scale) / 2))
    cv2.putText(label, name, at, font, scale, (255, 255, 255), 3 * thickness, cv2.LINE_AA)
    cv2.putText(label, name, at, font, scale, (20, 20, 20), thickness, cv2.LINE_AA)
