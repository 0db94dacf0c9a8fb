"""What is around the head of the simulated person: neck, shoulders, and the room."""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np

from hri.core.signals import Image
from hri.simulation.drawing import Color, Point, filled, paint
from hri.simulation.portrait import SKIN

SHIRT = np.array((62, 92, 120), np.float32)
"""Red, green, blue."""

Outline = tuple[Point, ...]

NECK: Outline = ((-0.40, 0.3), (-0.42, 1.15), (-0.62, 1.36), (0.0, 1.62))
SHIRT_EDGE: Outline = (
    (0.0, 1.60),
    (-0.36, 1.42),
    (-0.60, 1.27),
    (-1.30, 1.50),
    (-1.66, 1.80),
    (-1.86, 2.60),
    (-1.95, 6.0),
)
"""The left half of the outlines, in half heads from the middle of the head."""

WALL: tuple[Color, Color] = ((206, 198, 184), (168, 156, 142))
"""At the top and at the bottom."""
FURNITURE: tuple[tuple[float, float, float, float, Color], ...] = (
    (0.03, 0.08, 0.25, 0.62, (236, 238, 236)),  # window frame
    (0.05, 0.11, 0.135, 0.59, (178, 206, 226)),
    (0.145, 0.11, 0.23, 0.59, (188, 214, 232)),
    (0.05, 0.42, 0.23, 0.59, (150, 176, 150)),  # trees in it
    (0.76, 0.16, 0.98, 0.60, (128, 96, 68)),  # shelf
    (0.775, 0.19, 0.965, 0.37, (92, 68, 50)),
    (0.775, 0.40, 0.965, 0.57, (92, 68, 50)),
    (0.785, 0.22, 0.805, 0.37, (150, 62, 54)),  # books
    (0.81, 0.24, 0.835, 0.37, (64, 96, 112)),
    (0.84, 0.21, 0.86, 0.37, (190, 164, 98)),
    (0.865, 0.25, 0.895, 0.37, (84, 112, 84)),
    (0.90, 0.23, 0.92, 0.37, (120, 84, 110)),
    (0.80, 0.43, 0.82, 0.57, (70, 84, 120)),
    (0.825, 0.45, 0.855, 0.57, (176, 120, 70)),
    (0.86, 0.42, 0.885, 0.57, (110, 60, 60)),
    (0.93, 0.44, 0.955, 0.57, (196, 188, 170)),
    (0.0, 0.90, 1.0, 0.915, (214, 208, 198)),  # skirting
)
"""Left, top, right, bottom as parts of the picture, color."""


@lru_cache(maxsize=4)
def _room(size: tuple[int, int]) -> Image:
    """A room behind the person, a little out of focus."""
    width, height = size
    blend = np.linspace(0, 1, height)[:, None, None]
    wall = np.array(WALL[0]) * (1 - blend) + np.array(WALL[1]) * blend
    glow = 1.08 - 0.16 * np.linspace(0, 1, width)[None, :, None]
    image: Image = np.clip(wall * glow, 0, 255).astype(np.uint8)
    for left, top, right, bottom, color in FURNITURE:
        corners = (
            (round(left * width), round(top * height)),
            (
                round(right * width),
                round(bottom * height),
            ),
        )
        cv2.rectangle(image, *corners, color, cv2.FILLED)
    return cv2.GaussianBlur(image, (0, 0), max(0.5, width / 160)).astype(np.uint8)


@lru_cache(maxsize=8)
def scene(size: tuple[int, int], center: tuple[float, float], height: float) -> Image:
    """The room with neck and shoulders of somebody whose head is there."""
    scale = height / 2
    image = _room(size).copy()
    left, right = (min(size[0], max(0, round(center[0] + s * 2 * scale))) for s in (-1, 1))
    top = min(size[1], max(0, round(center[1] + 0.3 * scale)))
    if left == right or top == size[1]:
        return image
    x = (np.arange(left, right, dtype=np.float32)[None, :, None] - center[0]) / scale
    y = (np.arange(top, size[1], dtype=np.float32)[:, None, None] - center[1]) / scale
    turned_away = np.clip(1.05 - 0.10 * x - 0.05 * x * x, 0.3, 1.1)
    below_chin = 0.5 + 0.5 * np.clip((y - 0.75) / 0.5, 0, 1)
    body = image[top:, left:right].astype(np.float32)
    corner = np.array(center) - (left, top)
    for outline, color in ((NECK, SKIN * below_chin), (SHIRT_EDGE, SHIRT)):
        whole = np.array([*outline, *((-x, y) for x, y in reversed(outline))])
        cover = filled(body.shape, [whole * scale + corner], 0.6)
        paint(body, color * turned_away, cover)
    image[top:, left:right] = np.clip(body, 0, 255).astype(np.uint8)
    return image
