"""Optical flow averaged over square cells, how sure each is, and what it says about an approach.

The flow is that of Kroeger et al., "Fast optical flow using dense inverse search" (2016). Where the
whole picture has moved farther than that can follow, it begins at the shift that phase correlation
finds (Kuglin and Hines, "The phase correlation image alignment method", 1975).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.vision.detectors.preprocessing import Gray

CELL = 16
"""Pixels along a side of a cell."""
SMALLEST = 32
"""Pixels along a side of a picture below which it has no flow."""
LEAST_NOISE = 1.0
"""Squared levels by which pictures differ that are the same."""
UNEXPLAINED = 5.0
"""Times the structure of a cell, what remains when the flow is subtracted: then nothing is known of
its motion. Noise has some structure, too, but leaves twice as much."""
SURE = 0.5
"""Confidence from which a cell is."""
STRUCTURED = 10.0
"""Structure, squared levels a pixel, that the noise of a camera hardly has. When most of the cells
with more are unsure, the picture may have moved far."""
ALIKE = 0.05
"""Response of the phase correlation, 0 to 1, from which two pictures share a shift."""
FEWEST = 12
"""Sure cells that tell that a picture has moved far, or how it grows: that, if it does ..."""
CERTAIN = 10.0
"""... by at least as many times its standard error, since neighbors err alike ..."""
LEAST_GROWTH = 0.1
"""... and at least by as many pixels at the border."""

EDGE = cv2.BORDER_REPLICATE

Cells = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class BlockFlow:
    """The motion between two pictures."""

    cells: Cells
    """Shape [rows, columns, 2]: pixels to the right and down, averaged over each cell."""
    confidence: Cells
    """Shape [rows, columns], 0 to 1: low where a cell has no structure in two directions, and where
    the flow does not map the first picture onto the second."""

    @property
    def mean(self) -> tuple[float, float]:
        """Pixels to the right and down, of the cells by their confidence; 0 without any."""
        return mean_of(self.cells, self.confidence)

    @property
    def expansion(self) -> float:
        """By which share of its size the picture grows; least squares over all sure cells, 0 with
        fewer than 12.
        """
        return self._growth()[0]

    def time_to_contact(self, elapsed: float) -> float:
        """Seconds until the camera is where the scene is; infinite unless it surely comes nearer.

        `elapsed` is the seconds between the two pictures.
        """
        growth, error = self._growth()
        least = LEAST_GROWTH / (CELL * max(self.cells.shape[:2]) / 2)
        is_sure = growth > max(CERTAIN * error, least)
        return elapsed / growth if is_sure and elapsed > 0 else math.inf

    def _growth(self) -> tuple[float, float]:
        """How much the picture grows, and the standard error of that."""
        grown = self.grown()
        if grown is None:
            return 0.0, math.inf
        # The flow is known by where things are now, when the picture has already grown.
        scale = 1 / (1 - min(grown.along, 0.5))
        return grown.along * scale, grown.error * scale

    def grown(self) -> Grown | None:
        """Growth and shift that fit best; None with fewer than 12 sure cells."""
        is_sure = self.confidence > SURE
        weights = self.confidence[is_sure].astype(np.float64)
        if len(weights) < FEWEST:
            return None
        where = _middles(self.cells)[is_sure]
        flow = self.cells[is_sure].astype(np.float64)
        middle, shift = (weights @ values / weights.sum() for values in (where, flow))
        where -= middle
        flow -= shift
        spread = weights @ (where**2).sum(axis=1)
        along = float(weights @ (where * flow).sum(axis=1) / spread)
        rest = weights @ ((flow - along * where) ** 2).sum(axis=1)
        return Grown(along, middle, shift, math.sqrt(rest / (2 * len(weights) - 3) / spread))


@dataclass(frozen=True, slots=True)
class Grown:
    """A picture that has grown and moved as a whole."""

    along: float
    """Part of the way from the middle by which each point has moved away from it."""
    middle: NDArray[np.float64]
    """Pixels to the right and down."""
    shift: NDArray[np.float64]
    """By which the middle has moved, likewise."""
    error: float
    """Standard error of `along`."""

    @property
    def origins(self) -> NDArray[np.float64]:
        """Shape [2, 3]: leads from where something is to where it was."""
        stay = 1 - self.along
        moved = self.along * self.middle - self.shift
        return np.array([[stay, 0, moved[0]], [0, stay, moved[1]]])

    def flow(self, cells: Cells) -> NDArray[np.float64]:
        """What it makes of cells, in their shape."""
        return self.shift + self.along * (_middles(cells) - self.middle)


def mean_of(cells: Cells, confidence: Cells) -> tuple[float, float]:
    """Of the motion of cells, weighted by how sure they are; less when all together are not as much
    as a sure one, 0 without any.
    """
    x, y = (cells * confidence[..., None]).sum(axis=(0, 1)) / max(1.0, float(confidence.sum()))
    return float(x), float(y)


class BlockFlowFinder:
    """Finds the flow from one picture to another."""

    def __init__(self) -> None:
        self._flow = cv2.DISOpticalFlow_create(cv2.DISOPTICAL_FLOW_PRESET_FAST)  # type: ignore[attr-defined]

    def between(self, before: Gray, now: Gray) -> BlockFlow | None:
        """What has moved, by where it is now; None for tiny pictures, or of two sizes."""
        if before.shape != now.shape or min(now.shape) < SMALLEST:
            return None
        structure = _structure(now)
        # Always from nothing: a guess from the picture before would make the result depend on it.
        found = self._from(before, now, structure, None)
        is_sure = found.confidence[structure > STRUCTURED] > SURE
        if is_sure.size < FEWEST or is_sure.mean() > 0.5:
            return found
        if (shift := _shared_shift(before, now)) is None:
            return found
        guess = np.full((*now.shape, 2), -np.array(shift), np.float32)
        far = self._from(before, now, structure, guess)
        is_better = far.confidence.sum() > 2 * found.confidence.sum() + FEWEST
        return far if is_better else found

    def again(self, before: Gray, now: Gray, grown: Grown) -> BlockFlow | None:
        """The flow from a picture that has grown so already.

        Of a motion the search finds some percent too little; here it is what is left of it that is
        found too little, so that the sum is right to a thousandth or so.
        """
        way = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        size = (now.shape[1], now.shape[0])
        near = cv2.warpAffine(before, grown.origins, size, flags=way, borderMode=EDGE)
        left = self.between(np.asarray(near, np.uint8), now)
        if left is None:
            return None
        cells = grown.flow(left.cells) + (1 - grown.along) * left.cells
        return BlockFlow(np.asarray(cells, np.float32), left.confidence)

    def _from(self, before: Gray, now: Gray, structure: Cells, guess: Cells | None) -> BlockFlow:
        dense = self._flow.calc(now, before, guess)
        left = UNEXPLAINED * np.maximum(structure, 1e-6)
        sure = np.clip(1 - _unexplained(before, now, dense) / left, 0, 1)
        cells = -_by_cell(dense)
        sure[~_was_inside(cells, now.shape)] = 0
        return BlockFlow(cells, np.asarray(sure, np.float32))


def _shared_shift(before: Gray, now: Gray) -> tuple[float, float] | None:
    """Pixels to the right and down by which the whole picture has moved; None when it has not."""
    small = [cv2.resize(one, None, fx=0.5, fy=0.5).astype(np.float32) for one in (before, now)]
    window = cv2.createHanningWindow(small[0].shape[::-1], cv2.CV_32F)
    (x, y), alike = cv2.phaseCorrelate(small[0], small[1], window)
    return (2 * x, 2 * y) if alike >= ALIKE else None


def _structure(picture: Gray) -> Cells:
    """Of each cell, squared levels a pixel: the smaller eigenvalue of its structure tensor (Shi and
    Tomasi, "Good features to track", 1994).
    """
    across, down = (cv2.Scharr(picture, cv2.CV_32F, *way, scale=1 / 32) for way in ((1, 0), (0, 1)))
    xx, yy = _by_cell(across * across), _by_cell(down * down)
    xy = _by_cell(across * down)
    return np.asarray((xx + yy) / 2 - np.sqrt(((xx - yy) / 2) ** 2 + xy**2), np.float32)


def _unexplained(before: Gray, now: Gray, dense: Cells) -> Cells:
    """Of each cell, squared levels: what the flow leaves different, but for the light."""
    y, x = np.indices(now.shape, np.float32)
    expected = cv2.remap(before, x + dense[..., 0], y + dense[..., 1], cv2.INTER_LINEAR)
    rest = np.asarray(cv2.subtract(now, expected, dtype=cv2.CV_32F), np.float32)
    return np.asarray(_by_cell(rest * rest) - _by_cell(rest) ** 2 + LEAST_NOISE, np.float32)


def _middles(cells: Cells) -> NDArray[np.float64]:
    """Pixels to the right and down, shape [rows, columns, 2]: the middles of cells."""
    rows, columns = np.indices(cells.shape[:2], np.float64)
    return CELL * (np.stack([columns, rows], axis=-1) + 0.5) - 0.5


def _was_inside(cells: Cells, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Which cells were in the picture before, but for a border of half a cell."""
    rows, columns = np.indices(cells.shape[:2], np.float32)
    x, y = (columns + 0.5) * CELL - cells[..., 0], (rows + 0.5) * CELL - cells[..., 1]
    return np.asarray((x > 0) & (y > 0) & (x < shape[1]) & (y < shape[0]))


def _by_cell(values: Cells) -> Cells:
    """The mean of the pixels of each cell."""
    rows, columns = values.shape[0] // CELL, values.shape[1] // CELL
    whole = values[: rows * CELL, : columns * CELL]
    return np.asarray(cv2.resize(whole, (columns, rows), interpolation=cv2.INTER_AREA), np.float32)
