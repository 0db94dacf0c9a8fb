"""Objects without texture, recognized by color and silhouette: a second opinion.

A mixture of an object's colors marks where in the picture it could be; each blob is turned and
stretched until its silhouette has the moments of the learned one (Flusser and Suk, "Pattern
recognition by affine moment invariants", 1993), and then compared with it pixel by pixel, or by a
network that describes pictures.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import FoundObject, Image
from hri.vision.camera_view import CameraView
from hri.vision.color.color_mixture import (
    ColorMixture,
    ColorTable,
    Samples,
    chroma,
    fit,
    ratio_table,
)
from hri.vision.objects.embedding import Embedding
from hri.vision.objects.local_features import resized
from hri.vision.objects.object_model import ObjectModel, Outline, View

WIDEST = 320
"""Pixels; a wider picture is shrunk."""
COLORFUL = 20.0
"""Levels by which a plain object's color must differ from gray."""
LEAST_PIXELS = 200
"""Of a view."""
ENOUGH_PIXELS = 2000
"""Of them, for its colors."""
COMPONENTS = 3
"""Gaussians of an object's colors."""
LIGHTS = (0.65, 0.85, 1.0, 1.15)
"""Times the light it was learned in."""
SPREAD = 20.0
"""Variance of chroma, squared levels, by which another light may differ."""
LIKELY = (0.5, 1.5, 3.0)
"""Log-likelihood ratios from which a pixel may belong to an object: one of them parts it from what
is behind it.
"""
LEAST = 0.004
"""Part of the picture that an object takes at least."""
MOST = 6
"""Blobs that are looked at for each object, the largest."""
SIDE, RADIUS = 64, 22.0
"""Pixels of a silhouette that has been made comparable, and its standard deviation."""
TURNS = 36
"""Rotations that are tried."""
OVERLAP = 0.9
"""Intersection over union of two silhouettes that are of one object."""
GAINS = 0.7, 1.7
"""Of the light it was learned in to that in which it is seen."""
APART = 8.0
"""Levels of chroma by which the colors may differ in the mean."""
ALIKE = 0.7
"""Cosine of two pictures of one object, as a network describes them."""
MARGIN = 0.05
"""Score by which an object must be better than any other at its place."""
SUREST = 0.6
"""Confidence at most: color and shape say less than texture."""
ANYTHING = ColorMixture(np.array([1.0]), np.array([[128.0, 128.0]]), np.diag([500.0, 500.0])[None])
"""What a room's chroma is like: mostly gray."""
SMALLEST = 32
"""Pixels along a side of a picture."""
GROUND = 127
"""Gray around a silhouette."""


@dataclass(frozen=True, slots=True)
class _Normal:
    """A blob that has been moved and stretched until it can be compared."""

    shape: NDArray[np.bool_]
    """Its silhouette, [SIDE, SIDE]."""
    picture: Image
    """What is in it, [SIDE, SIDE, 3], RGB; `GROUND` around it."""


@dataclass(frozen=True, slots=True)
class _Known:
    name: str
    view: View
    table: ColorTable
    turned: tuple[_Normal, ...]
    """The view, in all rotations."""
    described: NDArray[np.float32] | None
    """By the network, the upright view."""


@dataclass(frozen=True, slots=True)
class _Candidate:
    """A blob that may be an object."""

    score: float
    known: _Known
    contour: Outline


class PlainRecognizer:
    """Looks for objects that have too few features; colorful ones only."""

    def __init__(
        self, models: Sequence[ObjectModel], view: CameraView, embedding: Embedding | None = None
    ) -> None:
        self._view, self._embedding = view, embedding
        self._known = [
            _learned(model.name, one, embedding)
            for model in models
            for one in model.views
            if is_colorful(one)
        ]

    def recognize(self, image: Image) -> tuple[FoundObject, ...]:
        """The objects in a picture (uint8, [height, width, 3], RGB), the surest first."""
        if not self._known or min(image.shape[:2]) < SMALLEST:
            return ()
        small = resized(image, min(1.0, WIDEST / image.shape[1]))
        candidates = sorted(self._candidates(small), key=lambda one: -one.score)
        chosen: list[_Candidate] = []
        for best in candidates:
            if any(_overlap(best.contour, other.contour) for other in chosen):
                continue
            others = (one for one in candidates if one.known.name != best.known.name)
            rivals = (one for one in others if _overlap(best.contour, one.contour))
            if all(one.score < best.score - MARGIN for one in rivals):
                chosen.append(best)
        return tuple(self._described(one, image, small) for one in chosen)

    def _candidates(self, small: Image) -> Iterator[_Candidate]:
        levels = chroma(small)
        for known in self._known:
            likely = known.table.ratios[levels[..., 0], levels[..., 1]]
            for least in LIKELY:
                for contour in _blobs(likely >= least):
                    score = self._score(known, _normal(small, contour))
                    if score > 0:
                        yield _Candidate(score, known, contour)

    def _score(self, known: _Known, seen: _Normal) -> float:
        """How well a blob is the object, 0 to 1; 0 where it is not."""
        overlaps = [_shared(seen.shape, turned.shape) for turned in known.turned]
        best = int(np.argmax(overlaps))
        if overlaps[best] < OVERLAP:
            return 0.0
        if self._embedding is None or known.described is None:
            return overlaps[best] * _alike_in_color(seen, known.turned[best])
        upright = _turned(seen, -math.tau * best / TURNS)
        cosine = float(self._embedding.describe(upright.picture) @ known.described)
        return overlaps[best] * cosine if cosine >= ALIKE else 0.0

    def _described(self, one: _Candidate, image: Image, small: Image) -> FoundObject:
        scale, view = image.shape[1] / small.shape[1], one.known.view
        corners = cv2.approxPolyDP(one.contour, 1.5, True).reshape(-1, 2) * scale
        moments = cv2.moments(one.contour)
        x, y = (moments[key] / moments["m00"] * scale for key in ("m10", "m01"))
        size = image.shape[1], image.shape[0]
        bearing, elevation = self._view.toward(x, y, size)
        distance = math.nan
        if view.scale > 0:
            # Of a tilted thing the longer side keeps its length.
            across = max(cv2.minAreaRect(corners.astype(np.float32))[1])
            meters = max(cv2.minAreaRect(view.outline)[1]) * view.scale
            distance = self._view.distance(x, y, across, meters, size)
        outline = tuple((float(a), float(b)) for a, b in corners)
        confidence = SUREST * min(1.0, one.score)
        return FoundObject(one.known.name, x, y, outline, confidence, distance, bearing, elevation)


def is_colorful(view: View) -> bool:
    """Whether a view can be found by its color."""
    pixels = _pixels(view)
    if len(pixels) < LEAST_PIXELS:
        return False
    return bool(np.median(np.hypot(*(pixels - 128).T)) >= COLORFUL)


def _pixels(view: View) -> Samples:
    """The chroma within the outline."""
    mask = np.zeros(view.picture.shape[:2], np.uint8)
    cv2.fillPoly(mask, [np.rint(view.outline).astype(np.int32)], 255)
    return np.asarray(chroma(view.picture)[mask > 0], float)


def _learned(name: str, view: View, embedding: Embedding | None) -> _Known:
    pixels = _pixels(view)
    pixels = pixels[:: max(1, len(pixels) // ENOUGH_PIXELS)]
    # Chroma grows with the light.
    lit = np.concatenate([(pixels - 128) * gain + 128 for gain in LIGHTS])
    mixture = fit(lit, COMPONENTS)
    wide = ColorMixture(mixture.weights, mixture.means, mixture.covariances + SPREAD * np.eye(2))
    upright = _normal(view.picture, np.rint(view.outline))
    turned = tuple(_turned(upright, math.tau * number / TURNS) for number in range(TURNS))
    described = embedding.describe(upright.picture) if embedding is not None else None
    return _Known(name, view, ratio_table(wide, ANYTHING), turned, described)


def _blobs(is_likely: NDArray[np.bool_]) -> list[Outline]:
    """Contours of what hangs together, the largest."""
    mask = is_likely.astype(np.uint8)
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (3, 3))
    mask = np.asarray(cv2.morphologyEx(mask, cv2.MORPH_OPEN, kernel), np.uint8)
    mask = np.asarray(cv2.morphologyEx(mask, cv2.MORPH_CLOSE, kernel, iterations=2), np.uint8)
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    large = [one for one in contours if cv2.contourArea(one) >= LEAST * mask.size]
    return sorted(large, key=cv2.contourArea, reverse=True)[:MOST]  # type: ignore[return-value]


def _normal(image: Image, contour: Outline) -> _Normal:
    """What is within a contour, moved and stretched to the same moments for all views of it."""
    mask = np.zeros(image.shape[:2], np.uint8)
    cv2.fillPoly(mask, [contour.astype(np.int32)], 255)
    moments = cv2.moments(mask, True)
    area = max(moments["m00"], 1.0)
    center = np.array([moments["m10"], moments["m01"]]) / area
    spread = [[moments["mu20"], moments["mu11"]], [moments["mu11"], moments["mu02"]]]
    values, vectors = np.linalg.eigh(np.array(spread) / area + 0.5 * np.eye(2))
    linear = RADIUS / 2 * (vectors / np.sqrt(values)) @ vectors.T
    way = np.column_stack((linear, np.array([SIDE / 2, SIDE / 2]) - linear @ center))
    return _cut(mask, image, way)


def _cut(mask: Image, image: Image, way: NDArray[np.float64]) -> _Normal:
    """A silhouette (255 where it is) and what is in it, moved by an affine map."""
    shape = cv2.warpAffine(mask, way, (SIDE, SIDE), flags=cv2.INTER_LINEAR) > 127
    picture = np.asarray(cv2.warpAffine(image, way, (SIDE, SIDE), flags=cv2.INTER_LINEAR), np.uint8)
    picture[~shape] = GROUND
    return _Normal(shape, picture)


def _turned(normal: _Normal, angle: float) -> _Normal:
    way = cv2.getRotationMatrix2D((SIDE / 2, SIDE / 2), math.degrees(angle), 1.0)
    return _cut(normal.shape.astype(np.uint8) * 255, normal.picture, np.asarray(way, np.float64))


def _shared(one: NDArray[np.bool_], other: NDArray[np.bool_]) -> float:
    """Intersection over union."""
    return float((one & other).sum()) / max(1.0, float((one | other).sum()))


def _alike_in_color(seen: _Normal, known: _Normal) -> float:
    """1 for the same chroma pixel by pixel, 0 for what is too far apart; any light is the same."""
    both = seen.shape & known.shape
    one, other = (
        cv2.cvtColor(each.picture, cv2.COLOR_RGB2YCrCb)[both].astype(np.float32)
        for each in (seen, known)
    )
    gain = float(np.clip(other[:, 0].mean() / max(1.0, one[:, 0].mean()), *GAINS))
    apart = float(np.abs((one[:, 1:] - 128) * gain - (other[:, 1:] - 128)).mean())
    return max(0.0, 1 - apart / APART)


def _overlap(one: Outline, other: Outline) -> bool:
    """Whether the boxes of two contours share a third of the smaller."""
    (left, top, width, height), (x, y, w, h) = cv2.boundingRect(one), cv2.boundingRect(other)
    across = min(left + width, x + w) - max(left, x)
    down = min(top + height, y + h) - max(top, y)
    return across > 0 and down > 0 and across * down * 3 > min(width * height, w * h)
