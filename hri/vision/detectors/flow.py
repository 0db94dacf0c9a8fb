"""How a face moves from one picture to the next, by optical flow of points in its upper part.

Lucas and Kanade, "An iterative image registration technique" (1981), in pyramids.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import FaceBox
from hri.vision.detectors.preprocessing import Gray

Points = NDArray[np.float32]
"""Places in a picture, shape [n, 1, 2]: x and y in pixels."""

POINTS = 40
"""How many points are followed at most."""
ENOUGH = 8
"""With fewer points, no motion is found."""
FACE = (0.18, 0.20, 0.82, 0.72)
"""The part of a box that holds points: left, top, right, bottom; without hair and mouth."""
WINDOW = (15, 15)
"""Pixels around a point that are compared."""
LEVELS = 3
"""How many times the pictures are halved for large motions."""
PRECISION = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_COUNT, 15, 0.02)
"""The search ends after 15 steps or with one below 0.02 pixels."""
RETURN_ERROR = 0.7
"""Pixels by which a point may miss its origin when it is followed back."""


@dataclass(frozen=True, slots=True)
class Shift:
    """The motion of a face between two pictures."""

    x: float
    """Pixels to the right."""
    y: float
    """Pixels down."""
    growth: float
    """How much larger it is, 0 for the same size; a head that turns is only narrower one way."""


class FaceFlow:
    """Follows one face; `start` with each new box, then `follow` picture by picture."""

    def __init__(self) -> None:
        self._gray: Gray | None = None
        self._points = _none()

    def start(self, gray: Gray, box: FaceBox) -> None:
        """Choose the points to follow from this picture on."""
        left, top, right, bottom = FACE
        x, y = max(0, int(box.x + left * box.width)), max(0, int(box.y + top * box.height))
        end_x, end_y = int(box.x + right * box.width), int(box.y + bottom * box.height)
        part = gray[y : max(y, end_y), x : max(x, end_x)]
        self._gray, self._points = gray, _none()
        if not part.size:
            return
        points = cv2.goodFeaturesToTrack(part, POINTS, 0.01, max(2.0, box.width / 18))
        if points is not None:
            self._points = (points + np.array((x, y))).astype(np.float32)

    def follow(self, gray: Gray) -> Shift | None:
        """The motion since the picture before; None when too few points could be followed."""
        before, points = self._gray, self._points
        self._gray, self._points = gray, _none()
        if before is None or before.shape != gray.shape or len(points) < ENOUGH:
            return None
        moved, found = _moved(before, gray, points)
        back, also = _moved(gray, before, moved)
        good = found & also & (np.abs(back - points).max(axis=(1, 2)) < RETURN_ERROR)
        if good.sum() < ENOUGH:
            return None
        old, new = points[good][:, 0], moved[good][:, 0]
        self._points = moved[good]
        x, y = np.median(new - old, axis=0)
        growth = _spread(new) / np.maximum(_spread(old), 1e-6) - 1
        return Shift(float(x), float(y), float(min(growth, key=abs)))


def _moved(before: Gray, after: Gray, points: Points) -> tuple[Points, NDArray[np.bool_]]:
    """Where the points of one picture are in the other, and whether they were found there."""
    moved, found, _ = cv2.calcOpticalFlowPyrLK(
        before,
        after,
        points,
        np.zeros_like(points),
        winSize=WINDOW,
        maxLevel=LEVELS,
        criteria=PRECISION,
    )
    return np.asarray(moved, np.float32), np.asarray(found).ravel() == 1


def _none() -> Points:
    return np.zeros((0, 1, 2), np.float32)


def _spread(points: NDArray[np.float32]) -> NDArray[np.float32]:
    """The typical distance of points from their middle, across and down."""
    away: NDArray[np.float32] = np.abs(points - points.mean(axis=0)).mean(axis=0)
    return away
