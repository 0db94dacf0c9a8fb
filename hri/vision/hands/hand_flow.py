"""How far a hand has moved from one picture to the next, by optical flow at points of its palm.

A hand that waves leaves the region of the last look within two pictures; this follows it for half a
millisecond (Lucas and Kanade, with pyramids: Bouguet 2000).
"""

from __future__ import annotations

import cv2
import numpy as np

from hri.core.signals import Landmarks
from hri.vision.detectors.preprocessing import Gray

PALM = (0, 1, 2, 5, 9, 13, 17)
"""The points of a hand that are followed: those of the fingers move against each other."""
WINDOW = 15
"""Pixels of a gray picture around a point, which are compared."""
LEVELS = 3
LEAST = 3
"""Points that must be found again; else nothing is known."""


def moved_by(before: Gray, now: Gray, places: Landmarks) -> tuple[float, float]:
    """Pixels across and down by which a hand has moved; 0 where that cannot be told.

    `places` are the palm's points in the picture before, shape [n, 2].
    """
    start = np.ascontiguousarray(places, np.float32).reshape(-1, 1, 2)
    end, is_found, _ = cv2.calcOpticalFlowPyrLK(
        before, now, start, np.zeros_like(start), winSize=(WINDOW, WINDOW), maxLevel=LEVELS
    )
    shifts = (end - start).reshape(-1, 2)[is_found.ravel() == 1]
    shifts = shifts[np.isfinite(shifts).all(axis=1)]
    if len(shifts) < LEAST:
        return 0.0, 0.0
    across, down = np.median(shifts, axis=0).tolist()
    return across, down
