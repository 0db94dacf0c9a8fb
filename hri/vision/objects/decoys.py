"""Features of pictures that show no object, which a set compares its objects with.

They are taken from dead leaves: shapes of all sizes that cover each other have the statistics of
photographs (Lee, Mumford, and Huang, "Occlusion models for natural images", 2001). Without them a
set of one object would match anything.
"""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.vision.objects.local_features import METHODS, Descriptors, FeatureExtractor

SEED = 7
SIZE = 640, 480
"""Of a picture, pixels."""
LEAVES = 900
"""Shapes in a picture."""
SMALLEST, LARGEST = 4.0, 120.0
"""Of a shape's radius, pixels; the numbers of shapes fall with the cube of their radius."""
BLURS = 0.6, 1.5
"""Pixels."""


@lru_cache(maxsize=2)
def decoys(method: str) -> Descriptors:
    """Descriptors of a method, as many as it wants; always the same."""
    count = METHODS[method].decoys
    dice, extractor = np.random.default_rng(SEED), FeatureExtractor(method)
    parts: list[Descriptors] = []
    while sum(map(len, parts)) < count:
        parts.append(extractor.extract(_leaves(dice)).descriptors)
    return np.concatenate(parts)[:count]


def _leaves(dice: np.random.Generator) -> Image:
    """A picture in gray, shape [height, width]."""
    picture = np.full(SIZE[::-1], 128, np.uint8)
    for _ in range(LEAVES):
        radius = min(LARGEST, SMALLEST / dice.uniform(0.02, 1.0))
        place = dice.integers((0, 0), SIZE)
        _draw(picture, int(dice.integers(4)), place, radius, int(dice.integers(256)), dice)
    return np.asarray(cv2.GaussianBlur(picture, (0, 0), float(dice.uniform(*BLURS))), np.uint8)


def _draw(
    picture: Image,
    kind: int,
    place: NDArray[np.int64],
    radius: float,
    gray: int,
    dice: np.random.Generator,
) -> None:
    """Draw a disk, an ellipse, a polygon, or some letters."""
    at = int(place[0]), int(place[1])
    if kind == 0:
        cv2.circle(picture, at, int(radius), gray, -1, cv2.LINE_AA)
    elif kind == 1:
        axes = int(radius), max(2, int(radius * dice.uniform(0.2, 1.0)))
        cv2.ellipse(picture, at, axes, dice.uniform(0, 180), 0, 360, gray, -1, cv2.LINE_AA)
    elif kind == 2:
        corners = place + dice.normal(0, radius, (int(dice.integers(3, 6)), 2))
        cv2.fillPoly(picture, [corners.astype(np.int32)], gray, cv2.LINE_AA)
    else:
        letters = "".join(chr(code) for code in dice.integers(48, 123, 4))
        font, thickness = int(dice.integers(0, 6)), int(dice.integers(1, 4))
        cv2.putText(picture, letters, at, font, radius / 20, gray, thickness, cv2.LINE_AA)
