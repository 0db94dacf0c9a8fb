"""What someone wears: the colors of torso and legs, learned while the face above them is seen.

A histogram each, over lightness and chroma in CIELAB, and how it differs from what is around: a
pixel speaks for someone as far as its color is more frequent on them than elsewhere in the picture
(Collins, Liu and Leordeanu, "Online selection of discriminative tracking features", 2005). It
distinguishes the people who are here now, and is forgotten with the person.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.vision.tracking.place import Place

Field = NDArray[np.float32]
Histogram = NDArray[np.float32]
"""Shape [BINS]: the share of each color; all together 1."""

SIDE = 160
"""Pixels of the longer side of a picture in which colors are looked at."""
LIGHTNESS, CHROMA = 8, 16
"""Steps of lightness, and of each of the two axes of chroma."""
CHROMA_STEP = 8
"""Of 255, from one step of chroma to the next; clothes are seldom more colorful than 64."""
BINS = LIGHTNESS * CHROMA * CHROMA
_VALUES = np.arange(256)
_STEPS = np.clip((_VALUES - 128) // CHROMA_STEP + CHROMA // 2, 0, CHROMA - 1)
STEPS = np.stack([_VALUES * LIGHTNESS // 256 * CHROMA**2, _STEPS * CHROMA, _STEPS], axis=-1)
STEPS = STEPS.astype(np.int16).reshape(1, 256, 3)
"""What each value of lightness, and of the axes of chroma, adds to the number of a color."""
LEARNING = 0.15
"""Part of what is known that each new look makes up."""
FRESHENING = 0.02
"""The same while only the body is seen: light changes as they walk, and fabric has two sides."""
FORGETTING = 0.2
"""Part of what is known of the surroundings that each picture makes up."""
FLOOR = 0.003
"""Added to the share of each color: what is rarer speaks neither for nor against."""
STRONGEST = 2.0
"""Logarithm of a ratio of shares beyond which one color speaks no louder."""
PARTS_COUNT = 0.5
"""What legs, and the head from behind, count in a likeness, against 1 of the torso."""
EVEN = 4.0
"""Steps of lightness, of 255, that mere noise makes."""
ENOUGH = 0.35
"""Part of a box that must be in the picture to say anything."""

KERNEL = np.array([0.25, 0.5, 0.25], np.float32)
EDGE = cv2.BORDER_REPLICATE

Box = tuple[float, float, float, float]
"""Left, top, right, bottom in sizes of the face from its middle."""
Weave = tuple[float, float]
"""The texture of a fabric: mean steps of lightness from one pixel to the next, across and down."""
HEAD: Box = (-0.4, -0.5, 0.4, 0.3)
TORSO: Box = (-0.85, 1.25, 0.85, 3.3)
LEGS: Box = (-0.6, 4.7, 0.6, 6.8)
EVERYTHING: Box = (-1.6, -1.0, 1.6, 8.5)
"""What may hold any of the person."""


@dataclass(frozen=True, slots=True)
class Likeness:
    """How alike two people's clothes are, 0 to 1."""

    mean: float
    least: float
    """Of torso, legs and head, as far as they are seen, the one that is least alike."""


@dataclass(frozen=True, slots=True)
class Colors:
    """A small picture of the colors."""

    bins: NDArray[np.int32]
    """The number of each pixel's color, shape [height, width]."""
    lightness: NDArray[np.uint8]
    """Of each pixel, 0 to 255."""
    scale: float
    """Pixels of the image for each of these."""

    @classmethod
    def of(cls, image: Image) -> Colors:
        """The colors of a picture."""
        scale = max(1.0, max(image.shape[:2]) / SIDE)
        size = max(1, round(image.shape[1] / scale)), max(1, round(image.shape[0] / scale))
        # Each of these pixels is the average of two across and two down; of all takes much longer.
        small = cv2.resize(image, size, interpolation=cv2.INTER_LINEAR)
        lab = cv2.cvtColor(small, cv2.COLOR_RGB2LAB)
        steps = cv2.LUT(lab, STEPS)
        bins = (steps[..., 0] + steps[..., 1] + steps[..., 2]).astype(np.int32)
        return cls(bins, np.asarray(lab[..., 0], np.uint8), scale)

    def histogram(self, box: Box, place: Place) -> Histogram | None:
        """The shares of the colors in a box; None when too little of it is in the picture."""
        colors = self.within(box, place)
        return _smoothed(_counts(colors) / colors.size) if colors.size else None

    def weave(self, box: Box, place: Place) -> Weave | None:
        """The steps of lightness in a box; None when too little of it is in the picture."""
        lightness = self._cut(self.lightness, box, place).astype(np.int16)
        if min(lightness.shape) < 2:
            return None
        across, down = (float(np.abs(np.diff(lightness, axis=axis)).mean()) for axis in (1, 0))
        return across, down

    def within(self, box: Box, place: Place) -> NDArray[np.int32]:
        """The colors in a box of someone at a place; none unless ENOUGH of it is in the picture."""
        return self._cut(self.bins, box, place)

    def _cut(self, values: NDArray[Any], box: Box, place: Place) -> NDArray[Any]:
        if not place.is_somewhere:
            return values[:0, :0]
        (height, width), unit = self.bins.shape, place.breadth / self.scale
        x, y = place.x / self.scale, place.y / self.scale
        left, top, right, bottom = (
            math.floor(middle + edge * unit + 0.5)
            for middle, edge in zip((x, y, x, y), box, strict=True)
        )
        area = (right - left) * (bottom - top)
        inside = values[
            min(height, max(0, top)) : min(height, max(0, bottom)),
            min(width, max(0, left)) : min(width, max(0, right)),
        ]
        return inside if inside.size > max(1.0, ENOUGH * area) else inside[:0]


class Clothes:
    """What one person wears, as far as it was seen."""

    def __init__(self) -> None:
        self._torso: Histogram | None = None
        self._legs: Histogram | None = None
        self._head: Histogram | None = None
        """From behind."""
        self._weave: Weave | None = None
        self._around: Histogram | None = None

    @property
    def are_known(self) -> bool:
        """Whether enough was seen to find them again."""
        return self._torso is not None

    def learn(self, colors: Colors, place: Place) -> None:
        """Take what they wear now, below their face."""
        self._learn(colors, place, LEARNING)

    def learn_behind(self, colors: Colors, place: Place) -> None:
        """Take what they look like now, from behind."""
        self._learn(colors, place, FRESHENING)
        self._head = _blended(self._head, colors.histogram(HEAD, place), LEARNING)

    def look_around(self, colors: Colors, place: Place) -> None:
        """Take what is around them now."""
        own = colors.within(EVERYTHING, place)
        counts = _counts(colors.bins) - _counts(own)
        around = _smoothed(counts / max(1.0, float(counts.sum())))
        self._around = _blended(self._around, around, FORGETTING)

    def evidence(self, colors: Colors) -> tuple[Field, Field | None]:
        """How far each pixel speaks for the torso, and for the legs: -1 to 1; [height, width]."""
        assert self._torso is not None
        legs = None if self._legs is None else self._speaking(self._legs)[colors.bins]
        return self._speaking(self._torso)[colors.bins], legs

    def likeness(self, colors: Colors, place: Place, is_behind: bool = False) -> Likeness | None:
        """How alike what someone at a place wears is; None where it is not seen.

        `is_behind`: their back is seen, and so the back of the head counts.
        """
        torso = _shared(self._torso, colors.histogram(TORSO, place))
        if torso is None:
            return None
        torso *= self._alike_weave(colors.weave(TORSO, place))
        legs = _shared(self._legs, colors.histogram(LEGS, place))
        head = _shared(self._head, colors.histogram(HEAD, place)) if is_behind else None
        parts = [(torso, 1.0)]
        parts += [(part, PARTS_COUNT) for part in (legs, head) if part is not None]
        mean = sum(part * weight for part, weight in parts) / sum(weight for _, weight in parts)
        return Likeness(mean, min(part for part, _ in parts))

    def _learn(self, colors: Colors, place: Place, part: float) -> None:
        self._torso = _blended(self._torso, colors.histogram(TORSO, place), part)
        self._legs = _blended(self._legs, colors.histogram(LEGS, place), part)
        weave = colors.weave(TORSO, place)
        if weave is not None:
            known = self._weave or weave
            across, down = (k + part * (w - k) for k, w in zip(known, weave, strict=True))
            self._weave = across, down

    def _alike_weave(self, weave: Weave | None) -> float:
        """How alike a texture is, 0.5 to 1."""
        if weave is None or self._weave is None:
            return 1.0
        pairs = zip(self._weave, weave, strict=True)
        unlike = max(abs(one - other) / (one + other + EVEN) for one, other in pairs)
        return 1 - 0.5 * unlike

    def _speaking(self, own: Histogram) -> Histogram:
        around = np.zeros(BINS, np.float32) if self._around is None else self._around
        ratio = np.log((own + FLOOR) / (around + FLOOR)) / STRONGEST
        speaking: Histogram = np.clip(ratio, -1.0, 1.0).astype(np.float32)
        return speaking


def _shared(one: Histogram | None, other: Histogram | None) -> float | None:
    """What two have in common, 0 to 1 (Swain and Ballard, "Color indexing", 1991)."""
    if one is None or other is None:
        return None
    return float(np.minimum(one, other).sum())


def _counts(colors: NDArray[np.int32]) -> NDArray[np.float64]:
    return np.bincount(colors.ravel(), minlength=BINS).astype(np.float64)


def _smoothed(shares: NDArray[np.float64]) -> Histogram:
    """A color counts for those beside it, too: light and noise move it a little."""
    cube = shares.astype(np.float32).reshape(LIGHTNESS, CHROMA, CHROMA)
    # As a picture of two axes for two of the three, and with lightness as its rows for the third.
    chroma = cv2.sepFilter2D(cube.transpose(1, 2, 0), -1, KERNEL, KERNEL, borderType=EDGE)
    rows = np.ascontiguousarray(chroma.transpose(2, 0, 1)).reshape(LIGHTNESS, -1)
    both = cv2.sepFilter2D(rows, -1, np.ones(1, np.float32), KERNEL, borderType=EDGE)
    smooth: Histogram = np.asarray(both, np.float32).ravel()
    return smooth


def _blended(known: Histogram | None, new: Histogram | None, part: float) -> Histogram | None:
    if known is None or new is None:
        return new if known is None else known
    mixed: Histogram = known + part * (new - known)
    return mixed
