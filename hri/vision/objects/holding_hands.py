"""Hands and forearms in a picture: they hold the thing and move with it, but belong to someone."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.core.signals import Image, Landmarks
from hri.vision.detectors.hand_mesh import HandMesh
from hri.vision.detectors.mesh import Region
from hri.vision.detectors.palm import PalmDetector, hand_region
from hri.vision.face_models import HAND, PALM, find_hand_models
from hri.vision.objects.object_model import Outline

MOST = 2
PRESENT = 0.5
"""Least presence of a hand."""
WRIST, FOREFINGER, MIDDLE, LITTLE = 0, 5, 9, 17
"""Which of a hand's points are the wrist, and knuckles."""
FLESH = 0.25
"""Breadths of the palm from its points to the edge of the hand."""


class HandFinder:
    """Finds those of a picture; none where the networks of hands were not fetched."""

    def __init__(self) -> None:
        self._networks: tuple[PalmDetector, HandMesh] | None = None
        try:
            folder = find_hand_models()
            self._networks = PalmDetector(folder / PALM.name), HandMesh(folder / HAND.name)
        except (HriError, RuntimeError):  # the latter of a home folder that nobody has
            pass

    def find(self, image: Image) -> list[Outline]:
        """The outlines of hands and of forearms, which reach to the edge of the picture, in pixels.

        `image` is uint8, [height, width, 3], RGB. It takes some 70 ms with two hands.
        """
        if self._networks is None:
            return []
        palms, mesh = self._networks
        height, width = image.shape[:2]
        outlines: list[Outline] = []
        for palm in palms.find(image, Region(width / 2, height / 2, max(width, height)))[:MOST]:
            fitted = mesh.fit(image, hand_region(palm))
            if fitted is not None and fitted.presence >= PRESENT:
                outlines += outlines_of(fitted.landmarks, float(np.hypot(width, height)))
        return outlines


def outlines_of(landmarks: Landmarks, length: float) -> list[Outline]:
    """Around a hand and around its forearm of a length, all in pixels; shape [21, 2] or [21, 3]."""
    points = landmarks[:, :2].astype(np.float32)
    return [_hand(points), _forearm(points, length)]


def _breadth(points: NDArray[np.float32]) -> float:
    return float(np.hypot(*(points[FOREFINGER] - points[LITTLE])))


def _hand(points: NDArray[np.float32]) -> Outline:
    """The convex hull of the points, with the flesh around them."""
    flesh = FLESH * _breadth(points)
    corners = flesh * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], np.float32)
    around = (points[:, None] + corners).reshape(-1, 2)
    return np.asarray(cv2.convexHull(around)[:, 0], np.float32)


def _forearm(points: NDArray[np.float32], length: float) -> Outline:
    """A strip as broad as the palm, from the wrist away from the fingers."""
    along = points[WRIST] - points[MIDDLE]
    along /= max(1e-6, float(np.hypot(*along)))
    aside = np.array([-along[1], along[0]]) * (0.5 + FLESH) * _breadth(points)
    near, far = points[WRIST], points[WRIST] + along * length
    return np.array([near - aside, near + aside, far + aside, far - aside], np.float32)
