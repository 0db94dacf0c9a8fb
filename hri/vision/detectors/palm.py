"""Palms found in a part of a picture, by MediaPipe's palm detection network.

Zhang et al., "MediaPipe Hands: on-device real-time hand tracking" (2020). The numbers are those of
MediaPipe's graphs palm_detection_cpu and palm_detection_detection_to_roi.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from hri.core.signals import FaceBox, Image
from hri.vision.detectors.face import Places, is_same
from hri.vision.detectors.mesh import Region, is_in, upright
from hri.vision.detectors.network import Tensor, load_network
from hri.vision.detectors.preprocessing import evened, is_picture
from hri.vision.detectors.ssd_anchors import ssd_anchors
from hri.vision.face_models import PALM, REMEDY

SIDE = 192
"""Pixels of the square picture that the network takes."""
GRIDS = ((24, 2), (12, 6))
"""Cells of each of its two grids along a side, and its proposals for each cell."""
POINTS = 7
WRIST, MIDDLE_KNUCKLE = 0, 2
"""Which of its points they are."""
LEAST_SCORE = 0.15
"""Lower than MediaPipe's 0.5: the fit of a hand decides, and who points, or holds a thumb up, hides
much of the palm."""
HAND_SCALE, HAND_SHIFT = 2.6, -0.5
"""Of the region of a hand: its side, and how far its middle lies toward the fingers, in sides of
the palm."""


@dataclass(frozen=True, slots=True)
class FoundPalm:
    """A palm in a picture, in its pixels."""

    box: FaceBox
    score: float
    """How surely it is a palm, 0 to 1."""
    points: Places
    """Wrist, knuckles of index, middle, ring and little finger, root and knuckle of the thumb."""


class PalmDetector:
    """Finds palms of at least a twelfth of the part that is looked at, in about 11 ms.

    Raises NotAvailable when the file is not the network.
    """

    def __init__(self, file: Path) -> None:
        self._network = load_network(file, PALM.sha256, REMEDY)
        self._anchors = ssd_anchors(GRIDS)

    def find(self, image: Image, part: Region) -> list[FoundPalm]:
        """The palms in an upright part, the surest first.

        There are none in what is not an 8-bit RGB picture, or in a part outside of it.
        """
        if not is_picture(image) or not is_in(part, image):
            return []
        small, there = upright(image, part, SIDE)
        # The two answers: a score for each proposal, and its box and points.
        scores, places = sorted(self._network.run(evened(small)), key=len)
        likely = np.flatnonzero(scores > math.log(LEAST_SCORE / (1 - LEAST_SCORE)))
        rows = places.reshape(len(scores), -1)[likely].astype(np.float32)
        back = cv2.invertAffineTransform(there).astype(np.float32)
        found = [
            _palm(row, anchor * SIDE, float(score), back)
            for row, score, anchor in zip(rows, scores[likely], self._anchors[likely], strict=True)
            if np.isfinite(row).all() and min(row[2:4]) > 0
        ]
        return _merged(found)


def hand_region(palm: FoundPalm) -> Region:
    """The region that holds the hand of a palm, fingers up."""
    wrist, knuckle = palm.points[WRIST].tolist(), palm.points[MIDDLE_KNUCKLE].tolist()
    roll = math.atan2(knuckle[0] - wrist[0], wrist[1] - knuckle[1])
    side = max(palm.box.width, palm.box.height)
    shift = HAND_SHIFT * side
    x = palm.box.x + palm.box.width / 2 - shift * math.sin(roll)
    y = palm.box.y + palm.box.height / 2 + shift * math.cos(roll)
    return Region(x, y, HAND_SCALE * side, roll)


def _palm(row: Tensor, anchor: Tensor, score: float, back: Tensor) -> FoundPalm:
    """What a proposal says, in pixels of the picture: middle, size and points."""
    scale = float(back[0, 0])
    places = np.vstack([row[:2], row[4:].reshape(POINTS, 2)]) + anchor
    placed = places @ back[:, :2].T + back[:, 2]
    width, height = row[2] * scale, row[3] * scale
    x, y = placed[0] - (width / 2, height / 2)
    box = FaceBox(float(x), float(y), float(width), float(height))
    return FoundPalm(box, 1 / (1 + math.exp(-min(50.0, score))), placed[1:].astype(np.float32))


def _merged(found: list[FoundPalm]) -> list[FoundPalm]:
    """The surest of all findings of one palm, the surest palm first."""
    # The place decides between equal scores, so that the order never depends on the input's.
    palms: list[FoundPalm] = []
    for palm in sorted(found, key=lambda palm: (-palm.score, palm.box.x, palm.box.y)):
        if not any(is_same(palm.box, other.box) for other in palms):
            palms.append(palm)
    return palms
