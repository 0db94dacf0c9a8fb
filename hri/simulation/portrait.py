"""The face of the simulated person: its relief, and the skin drawn on it.

Lengths are in half heads: chin to crown is 2, x to the right of the picture, y down, the origin in
the middle of the face.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import cv2
import numpy as np

from hri.simulation.drawing import Color, Field, Point, filled, paint

SKIN, HAIR, LIPS = np.array([(226, 172, 142), (74, 50, 38), (178, 92, 88)], np.float32)
"""Red, green, blue."""

FACE = np.array([0.69, 1.04, 0.74], np.float32)
"""Half axes of the ellipsoid under the relief of the face."""

DENSITY = 96
"""Points of the face's skin to a half head."""
REACH = 1.15
"""Half heads from the middle of the skin to its edge."""
STATES = 6
"""Steps between a shut and an open mouth, and between shut and open eyes."""


def column(length: Field) -> Field:
    """Where a coordinate of the head lies on the skin, in its points."""
    return (length + REACH) * DENSITY


@lru_cache(maxsize=1)
def _plane() -> tuple[Field, Field]:
    line = np.arange(-REACH, REACH, 1 / DENSITY, dtype=np.float32)
    x, y = np.meshgrid(line, line)
    return x, y


def _bump(x: float, y: float, width: float, height: float) -> Field:
    """A soft hill of height 1 at (x, y) and at its mirror image."""
    px, py = _plane()
    hill: Field = np.exp(-(((np.abs(px) - x) / width) ** 2) - ((py - y) / height) ** 2)
    return hill


def within_face() -> Field:
    """1 in the middle of the face, 0 at its edge, wide at the cheeks and narrow at the chin."""
    x, y = _plane()
    jaw = np.clip((y - 0.15) / 0.85, 0, 1)
    half_width = FACE[0] - 0.24 * jaw**1.8
    within: Field = 1 - np.abs(x / half_width) ** 2.4 - np.abs(y / FACE[1]) ** 2.6
    return within


HILLS = (
    (0.0, 0.20, 0.075, 0.17, 0.09),  # bridge of the nose
    (0.0, 0.35, 0.10, 0.10, 0.13),  # its tip
    (0.10, 0.39, 0.05, 0.05, 0.05),  # its wings
    (0.25, -0.14, 0.22, 0.08, 0.035),  # brows
    (0.28, 0.06, 0.16, 0.10, -0.055),  # eye sockets
    (0.40, 0.30, 0.20, 0.16, 0.035),  # cheeks
    (0.0, 0.62, 0.20, 0.08, 0.04),  # lips
    (0.0, 0.76, 0.16, 0.05, -0.025),  # below the lips
    (0.0, 0.90, 0.16, 0.10, 0.05),  # chin
)
"""Hills and hollows of the relief: x, y, width, height, how high."""


@lru_cache(maxsize=1)
def relief() -> tuple[Field, Field]:
    """How far the face stands out at each point, and its normals."""
    depth = FACE[2] * np.sqrt(np.clip(within_face(), 0, 1))
    for px, py, width, height, high in HILLS:
        depth = depth + high * _bump(px, py, width, height)
    depth = cv2.GaussianBlur(depth, (0, 0), 2.5)
    dy, dx = np.gradient(depth, 1 / DENSITY)
    normals = np.dstack([-dx, -dy, np.ones_like(dx)])
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    return depth.astype(np.float32), normals.astype(np.float32)


@lru_cache(maxsize=(STATES + 1) ** 2)
def skin(mouth: int, lids: int) -> Field:
    """The colors of the face and, fourth, its cover, for a mouth and eyes so far open."""
    x, y = _plane()
    skin = np.ones((*x.shape, 4), np.float32)
    skin[..., :3] = SKIN
    _tint(skin, 0.35 * _bump(0.42, 0.36, 0.18, 0.16), (226, 120, 104))
    _tint(skin, 0.30 * _bump(0.28, 0.03, 0.19, 0.10), (150, 90, 74))
    _tint(skin, 0.45 * _bump(0.07, 0.45, 0.05, 0.025), (96, 48, 40))
    _tint(skin, 0.25 * _bump(0.0, 0.47, 0.14, 0.04), (150, 90, 74))
    _paint_eyes(skin, lids / STATES)
    _paint_mouth(skin, mouth / STATES)
    hairline = -0.62 + 0.9 * np.abs(x / 0.69) ** 6 + 0.05 * np.sin(x * 5 - 0.6)
    strands = 1 + 0.10 * np.sin(60 * np.abs(x + 0.25) + 14 * y)
    hair = np.clip((hairline - y) * 12, 0, 1) * np.clip((0.12 - y) * 8, 0, 1)
    _tint(skin, hair, np.multiply.outer(strands, HAIR))
    above_skull = np.clip((-0.8 - y) * 8, 0, 1)
    skin[..., 3] = np.clip(within_face() * 9, 0, 1) * (1 - above_skull)
    return skin


def _tint(skin: Field, how_much: Field, color: Color | Field) -> None:
    paint(skin[..., :3], np.asarray(color, np.float32), how_much)


def _shape(outlines: Sequence[Sequence[Point]], soft: float = 1.0) -> Field:
    """Where the skin lies inside of outlines given in half heads; softened by so many points."""
    inside = [column(np.array(outline, np.float32)) for outline in outlines]
    return filled(_plane()[0].shape, inside, soft)


def _arc(x: float, y: float, half: float, up: float, down: float, count: int = 24) -> list[Point]:
    """The outline of an almond: half as wide, so far up and down in its middle."""
    steps = np.linspace(0, math.pi, count)
    above = [(x - half * math.cos(t), y - up * math.sin(t)) for t in steps]
    below = [(x + half * math.cos(t), y + down * math.sin(t)) for t in steps]
    return above + below


def _paint_eyes(skin: Field, open_: float) -> None:
    brows, lashes, whites, irises, pupils, glints = [], [], [], [], [], []
    for side in (-1, 1):
        x, y = side * 0.28, 0.05
        up, down = 0.005 + 0.075 * open_, 0.012 + 0.033 * open_
        inner, outer = x - side * 0.16, x + side * 0.19
        brows.append([(inner, y - 0.19), (x + side * 0.03, y - 0.225), (outer, y - 0.13)])
        brows[-1] += [(x + side * 0.03, y - 0.175), (inner, y - 0.145)]
        lashes.append(_arc(x, y, 0.155, up + 0.025, down + 0.008))
        whites.append(_arc(x, y + 0.004, 0.135, up, down))
        irises.append(_arc(x, y - 0.015, 0.068, 0.068, 0.068))
        pupils.append(_arc(x, y - 0.015, 0.034, 0.034, 0.034))
        glints.append(_arc(x - 0.025, y - 0.04, 0.014, 0.014, 0.014))
    eye = _shape(whites, 0.8)
    _tint(skin, 0.92 * _shape(brows, 1.4), (62, 40, 32))
    _tint(skin, 0.9 * _shape(lashes, 1.0), (58, 36, 32))
    _tint(skin, eye, (238, 234, 230))
    _tint(skin, eye * _shape(irises), (84, 98, 78))
    _tint(skin, eye * _shape(pupils), (18, 14, 14))
    _tint(skin, eye * _shape(glints, 0.6), (255, 255, 255))


def _paint_mouth(skin: Field, open_: float) -> None:
    gap = 0.13 * open_
    _tint(skin, 0.85 * _shape([_smiling(0.225, 0.048, 0.075 + gap)], 1.4), LIPS)
    _tint(skin, _shape([_smiling(0.205, 0.002, 0.012 + gap)], 0.8), (96, 36, 36))
    if open_ > 0.3:
        _tint(skin, 0.9 * _shape([_smiling(0.14, -0.008, 0.038)], 0.8), (236, 230, 222))


def _smiling(half: float, up: float, down: float) -> list[Point]:
    """An arc at the mouth, its corners raised."""
    return [(x, y - 1.1 * x * x) for x, y in _arc(0.0, 0.645, half, up, down)]
