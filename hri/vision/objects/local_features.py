"""Points of a picture that are found again from elsewhere, each with a description of its patch.

SIFT: Lowe, "Distinctive image features from scale-invariant keypoints" (2004); its patent has
expired. ORB: Rublee et al., "ORB: an efficient alternative to SIFT or SURF" (2011).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image

FAINTEST = 0.012
"""Contrast of a feature of SIFT: a third of the usual, since far objects are blurred."""
LEAST_SIZE = 16
"""Pixels; a picture that is narrower or lower has no features."""
SIFT, ORB = "sift", "orb"

Points = NDArray[np.float32]
"""Places in a picture, shape [n, 2]: x and y in pixels."""
Descriptors = NDArray[np.uint8]
"""Shape [n, 128] for SIFT, [n, 32] for ORB."""


@dataclass(frozen=True, slots=True)
class Features:
    """What one picture has to be known again by."""

    points: Points
    descriptors: Descriptors

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True, slots=True)
class _Method:
    """How features are found, and how alike two of them are."""

    make: Callable[[int], Any]
    width: int
    """Bytes of a descriptor."""
    likeness: Callable[[Descriptors, Descriptors], NDArray[np.float32]]
    least_likeness: float
    """Of two descriptors of one place."""
    widest: int
    """Pixels; a wider picture is shrunk. It takes half the time, and misses hardly more."""
    smoothing: float
    """Pixels by which it is smoothed then: the noise of a camera has features, too."""
    most: int
    """Features of a picture; the strongest are taken."""
    most_of_view: int
    """The same of a learned view, at each scale."""
    decoys: int
    """How many features of no object it is compared with; twice as many make no difference."""


def _sift(most: int) -> Any:
    return cv2.SIFT.create(most, contrastThreshold=FAINTEST)


def _orb(most: int) -> Any:
    # The small steps between its scales keep a small object's features alike.
    return cv2.ORB.create(most, scaleFactor=1.15, nlevels=12, fastThreshold=10)


def rooted(descriptors: Descriptors) -> NDArray[np.float32]:
    """Descriptors of SIFT by the roots of their parts, of length 1 (Arandjelovic and Zisserman,
    "Three things everyone should know to improve object retrieval", 2012).
    """
    values = descriptors.astype(np.float32)
    values /= np.maximum(values.sum(axis=1, keepdims=True), 1.0)
    return np.sqrt(values, out=values)


def _cosines(one: Descriptors, other: Descriptors) -> NDArray[np.float32]:
    return np.asarray(rooted(one) @ rooted(other).T, np.float32)


def _bits_alike(one: Descriptors, other: Descriptors) -> NDArray[np.float32]:
    signs, others = (np.unpackbits(each, axis=1) * np.float32(2) - 1 for each in (one, other))
    return np.asarray((signs @ others.T / signs.shape[1] + 1) / 2, np.float32)


METHODS: Mapping[str, _Method] = {
    SIFT: _Method(_sift, 128, _cosines, 0.88, 480, 0.6, 2000, 1000, 8000),
    ORB: _Method(_orb, 32, _bits_alike, 0.75, 640, 0.0, 1000, 500, 3000),
}


class FeatureExtractor:
    """Finds the features of pictures; the same picture always has the same."""

    def __init__(self, method: str = SIFT, is_for_view: bool = False) -> None:
        """`method` is a key of `METHODS`; a view that is learned is given fewer features."""
        self._method = METHODS[method]
        self._most = self._method.most_of_view if is_for_view else self._method.most
        self._detector = self._method.make(self._most)
        self.least_likeness = self._method.least_likeness
        """Of two features that are of one place."""

    def likeness(self, one: Descriptors, other: Descriptors) -> NDArray[np.float32]:
        """How alike each of one picture is to each of another, at most 1, shape [one, other]."""
        return self._method.likeness(one, other)

    def extract(self, image: Image, mask: NDArray[np.uint8] | None = None) -> Features:
        """The features, those where `mask` is not 0; none of a picture without detail.

        `image` is uint8, [height, width] or [height, width, 3] in RGB.
        """
        if min(image.shape[:2]) < LEAST_SIZE:
            return self._features((), None)
        gray = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY) if image.ndim == 3 else image
        found, described = self._detector.detectAndCompute(gray, mask)
        return self._features(found[: self._most], described)  # a tie at the end gives some more

    def extract_shrunk(self, image: Image) -> Features:
        """The features of a picture of a camera, of any size, in its pixels."""
        scale = min(1.0, self._method.widest / image.shape[1])
        found = self.extract(_smoothed(resized(image, scale), self._method.smoothing))
        return replace(found, points=(found.points + 0.5) / np.float32(scale) - 0.5)

    def _features(self, found: Any, described: Any) -> Features:
        points = np.array([point.pt for point in found], np.float32).reshape(-1, 2)
        if described is None:
            return Features(points, np.zeros((0, self._method.width), np.uint8))
        # Those of SIFT are whole numbers from 0 to 255 in float32.
        return Features(points, np.ascontiguousarray(described[: len(points)].astype(np.uint8)))


def _smoothed(image: Image, deviation: float) -> Image:
    if deviation == 0:
        return image
    return np.asarray(cv2.GaussianBlur(image, (0, 0), deviation), np.uint8)


def resized(image: Image, scale: float) -> Image:
    """A smaller picture."""
    if scale == 1.0:
        return np.ascontiguousarray(image)
    size = max(1, round(image.shape[1] * scale)), max(1, round(image.shape[0] * scale))
    return np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), np.uint8)
