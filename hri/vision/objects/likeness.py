"""How alike a learned view is to what is seen in its place, also where something covers a part.

Both are compared cell by cell. A cover comes in from one side and hides all behind its edge: so the
cells before some straight line must agree, and those behind it must not.
Of two that only look alike, as the issues of a magazine do, the cells that agree lie all over.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.vision.objects.local_features import Points
from hri.vision.objects.object_model import Outline, View

COMPARED = 160
"""Pixels, longer side of the pictures that are compared."""
GRID = 10
"""Cells of them along each side."""
BLUR = 1.5
"""Pixels; features are placed no better."""
LEAST_VISIBLE = 0.2
"""Part of an object that must be within the picture."""
PLAIN = 4.0
"""Levels of gray; with less contrast two pictures cannot be compared, since noise decides."""
TEXTURE = 20.0
"""Variance of the levels of gray in a cell from which it says something."""
SAME = 0.6
"""Correlation of two cells of one place."""
ALIKE, ALIKE_VISIBLE = 0.75, 0.8
"""Correlation that is enough, by chance never reached: of the whole, and of what is not covered."""
CELLS, CELLS_VISIBLE = 0.75, 0.8
"""Part of the cells with texture that must be the same, in the whole and in what is not covered."""
KEPT = (0.85, 0.75, 0.65, 0.55, 0.45)
"""Parts of a thing that may be all that is not covered."""
SIDES = 16
"""Directions from which it may be covered."""
BEHIND = 0.4
"""Part of the covered cells that may agree by chance: more is another thing of the same layout."""
FEATURES, TEXTURED_CELLS = 12, 6
"""That what is not covered must have at least."""
LEVEL, LEAST_LEVEL = 0.35, 4.0
"""How far the brightness of two cells of one place may differ: of the contrast, and levels."""

Values = NDArray[np.float64]
Homography = NDArray[np.float64]
"""Shape [3, 3]: from pixels of a view to those of the picture."""


def projected(homography: Homography, points: Points | Outline) -> Outline:
    """Where points of a view are in the picture."""
    shaped = np.asarray(points, np.float32).reshape(-1, 1, 2)
    return np.asarray(cv2.perspectiveTransform(shaped, homography)[:, 0], np.float32)


def likeness(view: View, homography: Homography, image: Image, agreeing: Points) -> float:
    """How alike the view and what is seen there are, at most 1; 0 when it may be another thing.

    It is the correlation, for a thing that is partly covered that of what is not, times its part.
    `agreeing` are the places in the view, pixels, of the features that the homography places right.
    """
    cells = _compared(view, homography, image, agreeing)
    if cells is None:
        return 0.0
    whole = np.ones((1, GRID * GRID))
    correlation, share = cells.correlation(whole)[0], cells.share_alike(whole)[0]
    if correlation >= ALIKE and share >= CELLS:
        return float(correlation)
    kept, parts = cells.uncovered
    correlations = cells.correlation(kept)
    is_alike = (
        (correlations >= ALIKE_VISIBLE)
        & (cells.share_alike(kept) >= CELLS_VISIBLE)
        & (cells.agreeing_behind(kept) <= BEHIND)
        & (kept @ cells.features >= FEATURES)
        & (kept @ cells.is_textured.astype(float) >= TEXTURED_CELLS)
    )
    return float((correlations * parts)[is_alike].max(initial=0.0))


@dataclass(frozen=True)
class _Cells:
    """Sums over the cells of what is seen (`a`) and of the view (`b`), each of shape [cells]."""

    count: Values
    """Pixels."""
    sums: Values
    """Of a, b, aa, bb, and ab, shape [5, cells]."""
    features: Values
    """How many features agree there."""

    @cached_property
    def is_large(self) -> NDArray[np.bool_]:
        """Which cells are not just slivers at the edge of the thing."""
        return np.asarray(self.count > 0.3 * self.count.max())

    @cached_property
    def is_textured(self) -> NDArray[np.bool_]:
        """Which cells of the view say something."""
        _, variance, _, _ = _moments(self.count, self.sums)
        return self.is_large & (variance > TEXTURE)

    @cached_property
    def is_same(self) -> NDArray[np.bool_]:
        """Which cells correlate."""
        seen, known, common, _ = _moments(self.count, self.sums)
        return np.asarray(common >= SAME * np.sqrt(np.maximum(seen, 4) * np.maximum(known, 4)))

    @cached_property
    def uncovered(self) -> tuple[Values, Values]:
        """The cells that are not covered, shape [cases, cells], and their part of the whole."""
        down, across = np.divmod(np.arange(GRID * GRID), GRID)
        cases, parts = [], []
        for toward in np.arange(SIDES) * math.tau / SIDES:
            depth = (across - GRID / 2) * math.cos(toward) + (down - GRID / 2) * math.sin(toward)
            order = np.argsort(depth, kind="stable")
            reached = np.cumsum(self.count[order]) / self.count.sum()
            for part in KEPT:
                case = np.zeros(GRID * GRID)
                case[order[: int(np.searchsorted(reached, part)) + 1]] = 1.0
                cases.append(case)
                parts.append(part)
        return np.array(cases), np.array(parts)

    def correlation(self, kept: Values) -> Values:
        """Of the pixels of the cells that are kept, for each case."""
        seen, known, common, _ = _moments(kept @ self.count, self.sums @ kept.T)
        found = common / np.sqrt(np.maximum(seen, 1e-3) * np.maximum(known, 1e-3))
        return np.where(np.minimum(seen, known) < PLAIN**2, 0.0, found)

    def share_alike(self, kept: Values) -> Values:
        """Which part of the textured area in the cells that are kept is the same."""
        area = self.count * self.is_textured
        return np.asarray(kept @ (area * self.is_same) / np.maximum(kept @ area, 1.0))

    def agreeing_behind(self, kept: Values) -> Values:
        """Which part of the other cells is as the light on those that are kept predicts it."""
        seen, known, common, (a, b) = _moments(kept @ self.count, self.sums @ kept.T)
        gain = common / np.maximum(known, 1e-3)
        offset = a - gain * b
        here, there = self.sums[:2] / np.maximum(self.count, 1.0)
        apart = np.abs(here - gain[:, None] * there - offset[:, None])
        near = apart < np.maximum(LEVEL * np.sqrt(np.maximum(seen, 1.0)), LEAST_LEVEL)[:, None]
        of_seen, of_known, _, _ = _moments(self.count, self.sums)
        is_plain = np.minimum(of_seen, of_known) <= TEXTURE
        area = (1 - kept) * (self.is_large * self.count)
        agreeing = near & (self.is_same | is_plain)
        return np.asarray((agreeing * area).sum(axis=1) / np.maximum(area.sum(axis=1), 1.0))


def _moments(count: Values, sums: Values) -> tuple[Values, Values, Values, Values]:
    """Variance of a, of b, their covariance, and both means."""
    means = sums / np.maximum(count, 1.0)
    a, b, aa, bb, ab = means
    return aa - a * a, bb - b * b, ab - a * b, means[:2]


def _compared(view: View, homography: Homography, image: Image, agreeing: Points) -> _Cells | None:
    """The picture, seen from where the view was learned, beside it; None when too little is."""
    height, width = view.picture.shape[:2]
    side = math.sqrt(cv2.contourArea(projected(homography, view.outline)))
    shrunk = min(COMPARED, side) / max(height, width)
    size = max(GRID, round(width * shrunk)), max(GRID, round(height * shrunk))
    way = np.diag((shrunk, shrunk, 1.0)) @ np.linalg.inv(homography)
    there = cv2.warpPerspective(image, way, size)
    visible = cv2.warpPerspective(np.full(image.shape[:2], 255, np.uint8), way, size)
    known = cv2.resize(view.picture, size, interpolation=cv2.INTER_AREA)
    mask = np.zeros(size[::-1], np.uint8)
    cv2.fillPoly(mask, [np.rint(view.outline * shrunk).astype(np.int32)], 255)
    whole = np.count_nonzero(mask)
    inside = ((mask & visible) > 0).astype(float)
    if inside.sum() < max(1.0, LEAST_VISIBLE * whole):
        return None
    a, b = (
        cv2.GaussianBlur(cv2.cvtColor(each, cv2.COLOR_RGB2GRAY), (0, 0), BLUR).astype(float)
        for each in (there, known)
    )
    sums = np.array([_summed(each * inside) for each in (a, b, a * a, b * b, a * b)])
    cell = np.clip((agreeing / (width, height) * GRID).astype(int), 0, GRID - 1)
    features = np.bincount(cell[:, 1] * GRID + cell[:, 0], minlength=GRID * GRID)
    return _Cells(_summed(inside), sums, features.astype(float))


def _summed(values: Values) -> Values:
    """Over each of the cells, row by row."""
    down, across = (np.arange(GRID) * side // GRID for side in values.shape)
    return np.asarray(np.add.reduceat(np.add.reduceat(values, down, 0), across, 1).ravel())
