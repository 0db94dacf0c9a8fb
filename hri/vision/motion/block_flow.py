"""Optical flow averaged over square cells, and what it says about an approach.

The flow is that of Kroeger et al., "Fast optical flow using dense inverse search" (2016).
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


@dataclass(frozen=True, slots=True)
class BlockFlow:
    """The motion between two pictures."""

    cells: NDArray[np.float32]
    """Shape [rows, columns, 2]: pixels to the right and down, averaged over each cell."""

    @property
    def mean(self) -> tuple[float, float]:
        """Pixels to the right and down, averaged over the picture; 0 without cells."""
        if not self.cells.size:
            return 0.0, 0.0
        x, y = self.cells.mean(axis=(0, 1))
        return float(x), float(y)

    @property
    def expansion(self) -> float:
        """By which share of its size the picture grows; least squares over all cells."""
        rows, columns = self.cells.shape[:2]
        if rows < 2 or columns < 2:
            return 0.0
        y, x = np.mgrid[:rows, :columns] * float(CELL)
        x, y = x - x.mean(), y - y.mean()
        along = (x * self.cells[..., 0] + y * self.cells[..., 1]).sum()
        return float(along / (x**2 + y**2).sum())

    def time_to_contact(self, elapsed: float) -> float:
        """Seconds until the camera is where the scene is; infinite unless it comes nearer.

        `elapsed` is the seconds between the two pictures.
        """
        return elapsed / self.expansion if self.expansion > 0 and elapsed > 0 else math.inf


class BlockFlowFinder:
    """Finds the flow from one picture to another."""

    def __init__(self) -> None:
        self._flow = cv2.DISOpticalFlow_create(cv2.DISOPTICAL_FLOW_PRESET_FAST)  # type: ignore[attr-defined]

    def between(self, before: Gray, now: Gray) -> BlockFlow | None:
        """What has moved, by where it is now; None for tiny pictures, or of two sizes."""
        if before.shape != now.shape or min(now.shape) < SMALLEST:
            return None
        # Always from nothing: a guess from the picture before would make the result depend on it.
        dense = -self._flow.calc(now, before, None)
        rows, columns = now.shape[0] // CELL, now.shape[1] // CELL
        whole = dense[: rows * CELL, : columns * CELL].reshape(rows, CELL, columns, CELL, 2)
        return BlockFlow(np.asarray(whole.mean(axis=(1, 3)), np.float32))
