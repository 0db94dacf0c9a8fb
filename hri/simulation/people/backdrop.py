"""What is around the head of a simulated person: hair behind it, neck, clothes, and the room."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.simulation.people.appearance import Looks, Outfit
from hri.simulation.people.soft_edges import Color, Field, Point, filled

Outline = tuple[Point, ...]
Drawn = Outline | tuple[Outline, Outline]
"""The left half of what is even, or the outlines of two parts."""

NECK: Outline = ((-0.38, 0.3), (-0.40, 1.15), (-0.62, 1.36), (0.0, 1.62))
SHIRT: Outline = (
    (0.0, 1.60),
    (-0.36, 1.42),
    (-0.60, 1.27),
    (-1.30, 1.50),
    (-1.66, 1.80),
    (-1.86, 2.60),
    (-1.95, 4.6),
    (-1.55, 6.3),
    (-1.30, 6.3),
)
TROUSERS: Outline = (
    (0.0, 6.0),
    (-1.30, 6.0),
    (-1.25, 8.0),
    (-1.0, 13.4),
    (-0.25, 13.4),
    (0.0, 7.4),
)
"""The left half of the outlines, in half heads from the middle of the head."""
HIPS = 7.0
"""How far down the legs begin to swing."""
LIFT, SWING = 0.5, 2.2
"""Half heads by which a foot goes up, and to the side as seen from there, in a stride."""
STRIDES = 2
"""Steps between standing and the widest stride."""
STRIPE = 0.5
"""Half heads from one stripe of a shirt to the next."""

SPRITE_DENSITY = 48
"""Points of the drawn body to a half head."""
SPRITE_LEFT, SPRITE_TOP, SPRITE_BOTTOM = -2.2, -1.3, 13.6
"""Where the drawn body begins and ends; it is as wide to the right."""

Box = tuple[float, float, float, float, Color]
WALL: tuple[Color, Color] = ((206, 198, 184), (168, 156, 142))
"""At the top and at the bottom."""
FURNITURE: tuple[Box, ...] = (
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


@lru_cache(maxsize=8)
def room(size: tuple[int, int], scene: int = 0) -> Image:
    """A room behind the people, a little out of focus; room 0 is at home, others are drawn by lot.

    Shared: copy it before you paint on it.
    """
    width, height = size
    (top, bottom), furniture = (WALL, FURNITURE) if scene == 0 else _furnished(scene)
    blend = np.linspace(0, 1, height)[:, None, None]
    wall = np.array(top) * (1 - blend) + np.array(bottom) * blend
    glow = 1.08 - 0.16 * np.linspace(0, 1, width)[None, :, None]
    image: Image = np.clip(wall * glow, 0, 255).astype(np.uint8)
    for left, upper, right, lower, color in furniture:
        corners = (
            (round(left * width), round(upper * height)),
            (round(right * width), round(lower * height)),
        )
        cv2.rectangle(image, *corners, color, cv2.FILLED)
    return cv2.GaussianBlur(image, (0, 0), max(0.5, width / 160)).astype(np.uint8)


@lru_cache(maxsize=8)
def room_toward(size: tuple[int, int], field_of_view: float, heading: float) -> Image:
    """The room at home from a camera that is turned by `heading` to the left, radians.

    The room is a cylinder around the camera; beyond one picture of it its mirror image follows.
    Shared, as that of `room`.
    """
    width, height = size
    focal = width / 2 / math.tan(field_of_view / 2)
    angle = np.arctan((np.arange(width) - (width - 1) / 2) / focal)
    bearing = (angle - heading + math.pi) % math.tau - math.pi
    turned = (bearing + field_of_view / 2) % (2 * field_of_view)
    there = np.minimum(turned, 2 * field_of_view - turned) - field_of_view / 2
    down = np.arange(height) - (height - 1) / 2
    x = np.broadcast_to(focal * np.tan(there) + (width - 1) / 2, (height, width))
    y = down[:, None] * (np.cos(angle) / np.cos(there)) + (height - 1) / 2
    maps = x.astype(np.float32), y.astype(np.float32)
    seen = cv2.remap(room(size), *maps, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(seen, np.uint8)


def _furnished(scene: int) -> tuple[tuple[Color, Color], tuple[Box, ...]]:
    """A wall and what stands before it."""
    dice = random.Random(f"room {scene}")
    top = _muted(dice, 120, 225)
    boxes: list[Box] = []
    for _ in range(dice.randint(3, 6)):  # Pictures, doors, cupboards.
        left, upper = dice.uniform(-0.1, 0.9), dice.uniform(-0.1, 0.6)
        right, lower = left + dice.uniform(0.08, 0.3), upper + dice.uniform(0.1, 0.5)
        boxes.append((left, upper, right, lower, _muted(dice, 40, 235)))
        for _ in range(dice.randint(0, 5)):
            x, width = dice.uniform(left, right), dice.uniform(0.01, 0.05)
            inner = (x, upper + 0.03, min(x + width, right), lower - 0.03)
            boxes.append((*inner, _muted(dice, 30, 240)))
    red, green, blue = top
    return (top, (0.8 * red, 0.8 * green, 0.8 * blue)), tuple(boxes)


def _muted(dice: random.Random, darkest: float, brightest: float) -> Color:
    """A color of a home: nearer to gray than one drawn by lot."""
    red, green, blue = (dice.uniform(darkest, brightest) for _ in range(3))
    gray = (red + green + blue) / 3
    return (0.6 * gray + 0.4 * red, 0.6 * gray + 0.4 * green, 0.6 * gray + 0.4 * blue)


@dataclass(frozen=True, eq=False)
class Sprite:
    """Something flat: its color where it covers, and how much it lets through; 0 to 255 both."""

    color: Image
    through: Image

    def on(
        self,
        image: Image,
        center: tuple[float, float],
        scale: float,
        roll: float,
        wide: float = 1.0,
    ) -> None:
        """Lay it on the picture, turned about the middle of the head; pixels, half heads.

        `wide` is a factor of its breadth.
        """
        grow = scale / SPRITE_DENSITY
        cos, sin = grow * math.cos(roll), grow * math.sin(roll)
        x, y = -SPRITE_LEFT * SPRITE_DENSITY, -SPRITE_TOP * SPRITE_DENSITY
        way = np.array(
            [
                [wide * cos, -sin, center[0] - wide * cos * x + sin * y],
                [wide * sin, cos, center[1] - wide * sin * x - cos * y],
            ],
        )
        height, width = image.shape[:2]
        reach = -SPRITE_LEFT * scale + abs(sin) * scale
        left, right = (min(width, max(0, round(center[0] + s * reach))) for s in (-1, 1))
        top = min(height, max(0, round(center[1] + (SPRITE_TOP - abs(sin)) * scale)))
        bottom = min(height, max(0, round(center[1] + SPRITE_BOTTOM * scale)))
        if right - left < 1 or bottom - top < 1:
            return
        way[:, 2] -= (left, top)
        size = (right - left, bottom - top)
        part = image[top:bottom, left:right]
        through = cv2.warpAffine(self.through, way, size, borderValue=(255, 255, 255))
        color = cv2.warpAffine(self.color, way, size)
        part[:] = cv2.add(cv2.multiply(part, through, scale=1 / 255), color)


@lru_cache(maxsize=64)
def body(
    looks: Looks, outfit: Outfit | None = None, stride: int = 0, is_aside: bool = False
) -> Sprite:
    """Neck, shirt and trousers, those of the looks without an outfit.

    `stride` is how far the left leg is ahead, -STRIDES to STRIDES; `is_aside`: seen from the side.
    """
    clothes = outfit or Outfit(looks.shirt)
    x, y = _plane()
    turned_away = np.clip(1.05 - 0.10 * x - 0.05 * x * x, 0.3, 1.1)
    below_chin = 0.5 + 0.5 * np.clip((y - 0.75) / 0.5, 0, 1)
    return _sprite(
        (
            (NECK, np.array(looks.skin, np.float32) * below_chin * turned_away),
            (_legs(stride / STRIDES, is_aside), np.array(clothes.trousers) * turned_away),
            (SHIRT, np.array(clothes.shirt) * turned_away * _stripes(y, clothes.stripes)),
        )
    )


def _legs(stride: float, is_aside: bool) -> Drawn:
    """Both legs, the left one of the picture first, then the right one."""
    if not stride:
        return TROUSERS
    legs = []
    for side in (-1, 1):
        ahead = side * stride
        swing, lift = (SWING * ahead, 0.0) if is_aside else (0.0, LIFT * max(0.0, ahead))
        legs.append(
            tuple(
                (-side * x + swing * part, y - lift * part)
                for x, y in TROUSERS
                for part in [max(0.0, y - HIPS) / (TROUSERS[-2][1] - HIPS)]
            )
        )
    return legs[0], legs[1]


def _stripes(y: Field, depth: float) -> Field:
    stripes: Field = 1 - depth * (np.sin(2 * math.pi / STRIPE * y) > 0)
    return stripes


@lru_cache(maxsize=16)
def back_hair(looks: Looks) -> Sprite:
    """Long hair behind the neck."""
    x, y = _plane()
    low = 0.35 + looks.hair_length
    outline: Outline = ((0.0, -0.95), (-0.3, -0.92), (-0.55, -0.75), (-0.72, -0.48), (-0.8, -0.1))
    outline += ((-0.84, 0.5 * low), (-0.84, 0.85 * low), (-0.74, low), (-0.5, low + 0.1))
    outline += ((0.0, low + 0.12),)
    strands = (0.72 + 0.10 * np.sin(31 * x + 2 * y)) * np.ones_like(y)
    return _sprite(((outline, np.array(looks.hair, np.float32) * strands),))


def _plane() -> tuple[Field, Field]:
    """The coordinates of a sprite's points, for colors of three channels."""
    x = np.arange(SPRITE_LEFT, -SPRITE_LEFT, 1 / SPRITE_DENSITY, dtype=np.float32)
    y = np.arange(SPRITE_TOP, SPRITE_BOTTOM, 1 / SPRITE_DENSITY, dtype=np.float32)
    return x[None, :, None], y[:, None, None]


def _sprite(parts: tuple[tuple[Drawn, Field], ...]) -> Sprite:
    x, y = _plane()
    shape = (y.shape[0], x.shape[1], 3)
    color, through = np.zeros(shape, np.float32), np.ones(shape, np.float32)
    for drawn, paint in parts:
        points = [(whole - (SPRITE_LEFT, SPRITE_TOP)) * SPRITE_DENSITY for whole in _wholes(drawn)]
        cover = filled(shape, points, 0.8)[..., None]
        color += (paint - color) * cover
        through *= 1 - cover
    return Sprite(
        np.clip(color, 0, 255).astype(np.uint8), np.clip(255 * through, 0, 255).astype(np.uint8)
    )


def _wholes(drawn: Drawn) -> list[NDArray[np.float64]]:
    """The whole outlines."""
    if isinstance(drawn[0][0], tuple):
        return [np.array(outline, np.float64) for outline in drawn]
    return [np.array([*drawn, *((-x, y) for x, y in reversed(drawn))], np.float64)]
