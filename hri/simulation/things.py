"""How the things of the simulated room look in a picture: flat, and turned to the camera."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import cv2
import numpy as np

from hri.core.signals import Image
from hri.hal.drivers.still_image import read_still
from hri.simulation.object_visibility import Sighting
from hri.simulation.people.actors import HEAD_HEIGHT, NEAREST, Optics
from hri.simulation.world_file import COLORS, Item
from hri.vision.objects.printed_label import printed_label

LIGHT = (-0.35, -0.4)
"""Where a ball shines, in its radii from its middle."""
BEYOND = 0.6
"""Radians to each side of the view in which a thing may be whose edge is in the picture."""
SHIFT = 4
"""Bits after the point of the coordinates that OpenCV draws with."""


@dataclass(frozen=True, slots=True)
class ThingAppearance:
    """A thing in a picture."""

    item: Item
    center: tuple[float, float]
    """Pixels."""
    width: float
    """Pixels."""
    height: float
    """Of a head at its distance, pixels: what is smaller is farther away."""

    def paint(self, image: Image) -> None:
        """Draw it into a picture."""
        if self.item.color:
            _paint_ball(image, self.center, self.width / 2, COLORS[self.item.color])
        else:
            _paint_flat(image, self.center, self.width, _look(self.item.name, self.item.picture))


def appearance(sighting: Sighting, optics: Optics) -> ThingAppearance | None:
    """How a thing looks to a camera; None for one that is beside or behind it."""
    ahead = sighting.distance * math.cos(sighting.bearing)
    if ahead <= 0:
        return None
    focal = optics.width / 2 / math.tan(optics.field_of_view / 2)
    meter = focal / max(NEAREST / 2, ahead)
    right = -sighting.distance * math.sin(sighting.bearing)
    center = optics.width / 2 + right * meter, optics.height / 2
    return ThingAppearance(sighting.item, center, sighting.item.width * meter, HEAD_HEIGHT * meter)


@lru_cache(maxsize=64)
def _look(name: str, picture: Path | None) -> Image:
    return printed_label(name) if picture is None else read_still(picture).image


def _paint_flat(image: Image, center: tuple[float, float], width: float, look: Image) -> None:
    scale = width / look.shape[1]
    if scale < 1:  # a camera averages over what a pixel sees
        size = max(1, round(width)), max(1, round(look.shape[0] * scale))
        look = np.asarray(cv2.resize(look, size, interpolation=cv2.INTER_AREA), np.uint8)
        scale = width / look.shape[1]
    height, across = look.shape[:2]
    left, top = center[0] - scale * across / 2, center[1] - scale * height / 2
    place = np.array([[scale, 0, left], [0, scale, top]], np.float64)
    size = image.shape[1], image.shape[0]
    cv2.warpAffine(look, place, size, image, cv2.INTER_LINEAR, cv2.BORDER_TRANSPARENT)


def _paint_ball(
    image: Image, center: tuple[float, float], radius: float, color: tuple[int, int, int]
) -> None:
    steps = 6
    for step in range(steps):
        part = step / steps
        shade = 0.72 + 0.5 * part
        at = [round((center[i] + LIGHT[i] * radius * part) * 2**SHIFT) for i in range(2)]
        tint = [min(255.0, channel * shade) for channel in color]
        size = round(radius * (1 - part) * 2**SHIFT)
        cv2.circle(image, (at[0], at[1]), size, tint, -1, cv2.LINE_AA, SHIFT)
