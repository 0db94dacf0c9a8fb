"""How the things of the simulated room look in a picture: flat, and turned to the camera."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import cv2
import numpy as np

from hri.core.geometry import Matrix
from hri.core.signals import Image
from hri.hal.drivers.still_image import read_still
from hri.simulation.object_visibility import Sighting
from hri.simulation.people.actors import HEAD_HEIGHT, NEAREST, Optics
from hri.simulation.world_file import COLORS, Item
from hri.vision.markers.families import DEFAULT, FAMILIES
from hri.vision.objects.printed_label import printed_label

LIGHT = (-0.35, -0.4)
"""Where a ball shines, in its radii from its middle."""
BEYOND = 0.6
"""Radians to each side of the view in which a thing may be whose edge is in the picture."""
CELL, SAMPLES = 8, 4
"""Pixels of a marker's cell as it is drawn, and samples of a pixel to each side."""
PAPER, INK = 225.0, 25.0
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
    turn: float = 0.0
    """Radians by which a card is turned to its left from facing the camera."""
    distance: float = 1.0
    """Meters ahead of the camera."""

    def paint(self, image: Image) -> None:
        """Draw it into a picture."""
        if self.item.marker is not None:
            self._paint_card(image, self.item.marker)
        elif self.item.color:
            _paint_ball(image, self.center, self.width / 2, COLORS[self.item.color])
        else:
            _paint_flat(image, self.center, self.width, _look(self.item.name, self.item.picture))

    def _paint_card(self, image: Image, id: int) -> None:
        """A marker with a white cell around, in perspective."""
        family = FAMILIES[DEFAULT]
        look = np.kron(family.cells(id), np.full((CELL, CELL), PAPER - INK)) + INK
        half = self.item.width / 2 * (family.width + 2) / family.width
        focal = self.width / self.item.width * self.distance
        ends = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
        away = self.distance + ends[:, 0] * math.sin(self.turn)
        if away.min() <= NEAREST / 4:
            return
        middle = (np.array(self.center) - (image.shape[1] / 2, image.shape[0] / 2)) / focal
        across = middle[0] * self.distance + ends[:, 0] * math.cos(self.turn)
        corners = np.stack([across, middle[1] * self.distance + ends[:, 1]], axis=1)
        pixels = focal * corners / away[:, None] + (image.shape[1] / 2, image.shape[0] / 2)
        _paint_turned(image, np.dstack([look] * 3), pixels)


def appearance(sighting: Sighting, optics: Optics, looking: float = 0.0) -> ThingAppearance | None:
    """How a thing looks to a camera; None for one that is beside or behind it, and for a card that
    turns its back. `looking` is where the camera looks in the room, radians.
    """
    ahead = sighting.distance * math.cos(sighting.bearing)
    if ahead <= 0:
        return None
    focal = optics.width / 2 / math.tan(optics.field_of_view / 2)
    meter = focal / max(NEAREST / 2, ahead)
    right = -sighting.distance * math.sin(sighting.bearing)
    center = optics.width / 2 + right * meter, optics.height / 2
    item, away = sighting.item, max(NEAREST / 2, ahead)
    turn = (
        0.0 if item.heading is None else math.remainder(item.heading - looking - math.pi, math.tau)
    )
    if item.marker is not None and right * math.sin(turn) >= ahead * math.cos(turn):
        return None
    return ThingAppearance(item, center, item.width * meter, HEAD_HEIGHT * meter, turn, away)


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


def _paint_turned(image: Image, look: Matrix, pixels: Matrix) -> None:
    """A drawing whose corners are there, each pixel the mean of what it sees."""
    low = np.maximum(np.floor(pixels.min(axis=0)).astype(int) - 1, 0)
    high = np.minimum(np.ceil(pixels.max(axis=0)).astype(int) + 1, image.shape[1::-1])
    if (high <= low).any():
        return
    size, large = len(look), [int(side) * SAMPLES for side in high - low]
    ends = np.array([(0, 0), (size, 0), (size, size), (0, size)], np.float32) - 0.5
    warp = cv2.getPerspectiveTransform(ends, ((pixels - low) * SAMPLES - 0.5).astype(np.float32))
    small = [int(side) for side in high - low]
    drawn = np.dstack([look, np.ones(look.shape[:2])]).astype(np.float32)
    seen = cv2.resize(cv2.warpPerspective(drawn, warp, large), small, interpolation=cv2.INTER_AREA)
    part = slice(low[1], high[1]), slice(low[0], high[0])
    image[part] = np.rint(image[part] * (1 - seen[..., 3:]) + seen[..., :3]).astype(np.uint8)


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
