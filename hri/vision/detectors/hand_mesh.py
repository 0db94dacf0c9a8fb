"""Twenty-one points fitted to a hand, by MediaPipe's hand landmark network.

Zhang et al., "MediaPipe Hands: on-device real-time hand tracking" (2020). The numbers are those of
MediaPipe's graphs hand_landmark_cpu and hand_landmark_landmarks_to_roi.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from hri.core.signals import Image, Landmarks
from hri.vision.detectors.mesh import Region, is_in, upright
from hri.vision.detectors.network import load_network
from hri.vision.detectors.preprocessing import evened, is_picture
from hri.vision.face_models import HAND, REMEDY

SIDE = 224
"""Pixels of the square picture that the network takes."""
POINTS = 21
WRIST = 0
KNUCKLES = (5, 9, 13, 17)
"""Of index, middle, ring and little finger."""
STEADY = (0, 1, 2, 3, 5, 6, 9, 10, 13, 14, 17, 18)
"""Points without the ends of the fingers: the region does not jump when one is bent."""
SCALE, SHIFT = 2.0, -0.1
"""Of the region of a hand: its side, and how far its middle lies toward the fingers, in sides of
the box around the steady points."""


@dataclass(frozen=True, slots=True)
class FittedHand:
    """Points that were fitted to a hand: wrist, then four from the root of each finger to its tip,
    the thumb first.
    """

    landmarks: Landmarks
    """Shape [21, 3]: pixels, and depth in pixels, negative nearer than the wrist."""
    presence: float
    """How surely there is a hand in the region, 0 to 1."""
    left: float
    """How surely it is the person's left one, 0 to 1."""


class HandMesh:
    """Fits the points in about 4 ms; it knows nothing of the picture before.

    Raises NotAvailable when the file is not the network.
    """

    def __init__(self, file: Path) -> None:
        self._network = load_network(file, HAND.sha256, REMEDY)

    def fit(self, image: Image, region: Region) -> FittedHand | None:
        """The points of the hand in a region.

        Its presence says whether a hand is there. None for what is not a picture of 8 bits RGB,
        and for a region that is not in it.
        """
        if not is_picture(image) or not is_in(region, image):
            return None
        part, there = upright(image, region, SIDE)
        # The fourth are the points in meters. OpenCV 4.14 has those wrong, and the others by up to
        # a seventieth of the region.
        points, presence, right, _ = self._network.run(evened(part))
        if not np.isfinite(points).all():
            return None
        places, back = points.reshape(POINTS, 3), cv2.invertAffineTransform(there)
        placed = np.empty((POINTS, 3), np.float32)
        placed[:, :2] = places[:, :2] @ back[:, :2].T + back[:, 2]
        placed[:, 2] = places[:, 2] * (region.side / SIDE)
        return FittedHand(placed, float(presence[0]), 1 - float(right[0]))


def region_of_hand(landmarks: Landmarks) -> Region:
    """The region where the hand of these landmarks is expected in the next picture."""
    places = landmarks[:, :2].astype(np.float64)
    index, middle, ring = (places[number] for number in KNUCKLES[:3])
    x, y = ((index + ring) / 2 + middle) / 2 - places[WRIST]
    roll = math.atan2(x, -y)
    turn = _rotation(roll)
    steady = places[list(STEADY)] @ turn
    low, high = steady.min(axis=0), steady.max(axis=0)
    middle_x, middle_y = (low + high) / 2 + (0, SHIFT * (high[1] - low[1]))
    x, y = turn @ (middle_x, middle_y)
    return Region(float(x), float(y), SCALE * float((high - low).max()), roll)


def _rotation(roll: float) -> Landmarks:
    """Clockwise in the picture."""
    cosine, sine = math.cos(roll), math.sin(roll)
    return np.array([[cosine, -sine], [sine, cosine]], np.float32)
