"""A hand in a picture, drawn so that a network sees its joints where they are."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image

Color = tuple[float, float, float]
Picture = NDArray[np.float32]
"""Red, green, blue, and how much of them covers what is below; shape [height, width, 4]."""
Place = tuple[float, float]
"""From the middle of a left palm with its fingers up, in widths of the palm; x right, y down."""

FINGERS: tuple[tuple[Place, Place], ...] = (
    ((-0.40, 0.25), (-0.92, -0.28)),
    ((-0.36, -0.42), (-0.46, -1.20)),
    ((-0.12, -0.48), (-0.14, -1.36)),
    ((0.12, -0.46), (0.17, -1.28)),
    ((0.33, -0.36), (0.47, -1.00)),
)
"""Root and tip of each straight finger, the thumb first."""
TUCKED: tuple[Place, Place] = ((-0.42, 0.20), (0.05, 0.0))
"""The thumb of a fist."""
CURLED = 0.25
"""How far a finger that is bent comes down over the palm."""
THICK, FOREARM = 0.2, 0.56
PALM: tuple[Place, ...] = (
    (-0.46, -0.42), (-0.15, -0.55), (0.15, -0.53), (0.43, -0.38),
    (0.40, 0.25), (0.26, 0.62), (-0.26, 0.62), (-0.48, 0.15),
)  # fmt: skip
ARM: tuple[Place, Place] = ((0.0, 0.9), (0.02, 2.2))
CREASES: tuple[tuple[Place, Place], ...] = (
    ((-0.3, -0.12), (0.3, -0.2)),
    ((-0.32, -0.2), (-0.05, 0.4)),
)
RIM, CREASE, BENT, SHADED = 0.72, 0.8, 0.9, 0.92
"""How bright these are, as parts of the skin."""
REACH = 2.5
"""Widths of the palm from its middle to the edge of what is drawn."""
FINE, LARGEST = 160.0, 400.0
"""Pixels of a palm: a smaller one is drawn as large as this and averaged; a larger one than that
would fill the picture."""


@dataclass(frozen=True, slots=True)
class DrawnHand:
    """A hand that shows its palm, with its forearm."""

    center: tuple[float, float]
    """Pixels, the middle of the palm."""
    palm: float
    """Pixels, the width of the palm."""
    height: float
    """Pixels, of a head at its distance."""
    straight: tuple[bool, ...] = (True,) * 5
    """Which fingers are straight, the thumb first."""
    turn: float = 0.0
    """Radians clockwise in the picture, from fingers up."""
    is_left: bool = True
    skin: Color = (224.0, 172.0, 140.0)

    def paint(self, image: Image) -> None:
        """Draw it into a picture, uint8 [height, width, 3]."""
        palm = min(LARGEST, self.palm)
        fine = max(1, round(FINE / max(1.0, palm)))
        drawn = self._drawn(round(palm * fine))
        middle = drawn.shape[0] / 2
        there = cv2.getRotationMatrix2D((middle, middle), -math.degrees(self.turn), 1 / fine)
        there[:, 2] += np.array(self.center) - middle
        smooth = cv2.GaussianBlur(drawn, (0, 0), 0.7 * fine)
        size = image.shape[1], image.shape[0]
        placed = cv2.warpAffine(smooth, there, size, flags=cv2.INTER_AREA)
        below = (1 - placed[..., 3:]) * image
        image[:] = np.clip(placed[..., :3] + below, 0, 255).astype(np.uint8)

    def _drawn(self, palm: int) -> Picture:
        """Upright, in the middle of a square picture; `palm` is its width there, pixels."""
        side = round(2 * REACH * palm)
        canvas = np.zeros((side, side, 4), np.float32)
        self._limb(canvas, ARM, FOREARM, SHADED)
        for line, is_straight in zip(FINGERS[1:], self.straight[1:], strict=True):
            if is_straight:
                self._limb(canvas, line, THICK, 1.0)
        corners = np.array([self._pixels(canvas, place) for place in PALM])
        middle = corners.mean(axis=0)
        inner = np.rint(middle + 0.95 * (corners - middle)).astype(np.int32)
        cv2.fillPoly(canvas, [corners], self._color(RIM), cv2.LINE_AA)
        cv2.fillPoly(canvas, [inner], self._color(1.0), cv2.LINE_AA)
        for (root, _), is_straight in zip(FINGERS[1:], self.straight[1:], strict=True):
            if not is_straight:
                self._limb(canvas, (root, (root[0], root[1] + CURLED)), THICK, BENT)
        self._limb(canvas, FINGERS[0] if self.straight[0] else TUCKED, THICK, 1.0)
        for crease in CREASES:
            self._line(canvas, crease, 0.03, CREASE)
        return canvas

    def _limb(self, canvas: Picture, line: tuple[Place, Place], thick: float, shade: float) -> None:
        self._line(canvas, line, thick, RIM * shade)
        self._line(canvas, line, 0.86 * thick, shade)

    def _line(self, canvas: Picture, line: tuple[Place, Place], thick: float, shade: float) -> None:
        start, end = (self._pixels(canvas, place) for place in line)
        width = max(1, round(thick * canvas.shape[0] / (2 * REACH)))
        cv2.line(canvas, start, end, self._color(shade), width, cv2.LINE_AA)

    def _pixels(self, canvas: Picture, place: Place) -> tuple[int, int]:
        across = place[0] if self.is_left else -place[0]
        middle, scale = canvas.shape[0] / 2, canvas.shape[0] / (2 * REACH)
        return round(middle + across * scale), round(middle + place[1] * scale)

    def _color(self, shade: float) -> tuple[float, ...]:
        return (*(shade * channel for channel in self.skin), 1.0)
