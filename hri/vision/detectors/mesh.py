"""A mesh of 468 points fitted to a face, by MediaPipe's face landmark network.

Kartynnik et al., "Real-time facial surface geometry from monocular video on mobile GPUs" (2019).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image, Landmarks
from hri.vision.detectors.face import FoundFace
from hri.vision.detectors.network import load_network
from hri.vision.detectors.preprocessing import darkness, evened, is_picture
from hri.vision.face_models import MESH, REMEDY

SIDE = 192
"""Pixels of the square picture that the network takes."""
POINTS = 468
MARGIN = 1.5
"""Width of the region relative to the face, as in MediaPipe."""
RIGHT_EYE, LEFT_EYE = 33, 263
"""Outer corners of the person's eyes; the right eye is at the left of the picture."""
SHARED = np.array([(33, 133), (362, 263), (1, 1), (13, 14)])
"""Between which two points of the mesh the eyes, the nose and the mouth of a finder lie."""
SMOOTHING = 1.2
"""Pixels of the network's picture by which it is smoothed: it halves the noise of the pose, and
neither its gain nor the presence change. More in the dark: what is brightened, noise and all, is
as quiet then, and still seen as a face."""
MOST_SMOOTHING = 3.6
"""Pixels, likewise; more would hide the eyes."""
SMALLEST_REGION = 16
"""Smallest face, pixels."""

Affine = NDArray[np.float64]
"""Leads from places of one picture to those of another, shape [2, 3]."""


@dataclass(frozen=True, slots=True)
class Region:
    """The square of a picture that holds a face or a hand, turned so that it is upright in it."""

    x: float
    """Pixels, the middle."""
    y: float
    side: float
    """Pixels."""
    roll: float = 0.0
    """Radians, from upright toward the person's left shoulder (clockwise in the picture)."""


@dataclass(frozen=True, slots=True)
class FittedFace:
    """A mesh that was fitted to a face."""

    landmarks: Landmarks
    presence: float
    """How surely there is a face in the region, 0 to 1."""


class FaceMesh:
    """Fits the mesh in about 5 ms; it knows nothing of the picture before.

    Raises NotAvailable when the file is not the network.
    """

    def __init__(self, file: Path) -> None:
        self._network = load_network(file, MESH.sha256, REMEDY)

    def fit(self, image: Image, region: Region) -> FittedFace | None:
        """The mesh of the face in a region.

        Its presence says whether a face is there: trust the landmarks above 0.5. None for what
        is not a picture of 8 bits RGB, and for a region that is not in it.
        """
        if not is_picture(image) or not is_in(region, image):
            return None
        part, to_part = upright(image, region, SIDE)
        smoothing = min(MOST_SMOOTHING, SMOOTHING * darkness(part))
        smooth = np.asarray(cv2.GaussianBlur(part, (0, 0), smoothing), np.uint8)
        answers = self._network.run(evened(smooth))
        # The two answers: the logit of the presence, and the points.
        logit, points = sorted(answers, key=len)
        landmarks = points.reshape(POINTS, 3)
        if not np.isfinite(landmarks).all():
            return None
        back = cv2.invertAffineTransform(to_part)
        placed = np.empty((POINTS, 3), np.float32)
        placed[:, :2] = landmarks[:, :2] @ back[:, :2].T + back[:, 2]
        placed[:, 2] = landmarks[:, 2] * (region.side / SIDE)
        return FittedFace(placed, 1 / (1 + math.exp(-min(50.0, max(-50.0, float(logit[0]))))))


def region_of(found: FoundFace) -> Region:
    """The region for a face that a finder has found."""
    box, roll = found.box, 0.0
    if found.points is not None:
        right, left = found.points[:2]
        roll = math.atan2(float(left[1] - right[1]), float(left[0] - right[0]))
    side = MARGIN * max(box.width, box.height)
    return Region(box.x + box.width / 2, box.y + box.height / 2, side, roll)


def region_of_landmarks(landmarks: Landmarks) -> Region:
    """The region where the face of these landmarks is expected in the next picture."""
    right, left = landmarks[RIGHT_EYE], landmarks[LEFT_EYE]
    roll = math.atan2(float(left[1] - right[1]), float(left[0] - right[0]))
    cosine, sine = math.cos(roll), math.sin(roll)
    upright = landmarks[:, :2] @ np.array([[cosine, -sine], [sine, cosine]], np.float32)
    low, high = upright.min(axis=0), upright.max(axis=0)
    x, y = ((low + high) / 2).tolist()
    side = MARGIN * float((high - low).max())
    return Region(cosine * x - sine * y, sine * x + cosine * y, side, roll)


def disagreement(found: FoundFace, landmarks: Landmarks) -> float:
    """How far a finder's eyes, nose and mouth are from those of the mesh, in sizes of the face.

    0 for a finder that gives no points.
    """
    if found.points is None:
        return 0.0
    places = landmarks[SHARED, :2].mean(axis=1)
    away = np.linalg.norm(places - found.points[: len(places)], axis=1).mean()
    return float(away) * MARGIN / region_of_landmarks(landmarks).side


def is_in(region: Region, image: Image) -> bool:
    """Whether a region is of a sensible size, with its middle in the picture."""
    height, width = image.shape[:2]
    numbers = (region.x, region.y, region.side, region.roll)
    return (
        all(map(math.isfinite, numbers))
        and SMALLEST_REGION <= region.side <= 2 * max(width, height)
        and 0 <= region.x < width
        and 0 <= region.y < height
    )


def upright(image: Image, region: Region, side: int) -> tuple[Image, Affine]:
    """The region turned upright, in a square of that many pixels, and what leads there."""
    turn = cv2.getRotationMatrix2D(
        (region.x, region.y), math.degrees(region.roll), side / region.side
    )
    there: Affine = np.asarray(turn, np.float64)
    there[:, 2] += (side / 2 - region.x, side / 2 - region.y)
    reach = region.side * math.sqrt(0.5) + 1
    left, top = max(0, int(region.x - reach)), max(0, int(region.y - reach))
    part = image[top : int(region.y + reach), left : int(region.x + reach)]
    # A large face is averaged to about the size of the network's picture: turning it below takes
    # single pixels, with all their noise.
    shrink = max(1, min(int(region.side / side), *part.shape[:2]))
    height, width = part.shape[0] // shrink, part.shape[1] // shrink
    whole = part[: height * shrink, : width * shrink]
    small = cv2.resize(whole, (width, height), interpolation=cv2.INTER_AREA)
    # The middle of a pixel lies at whole numbers, so that a corner lies half a pixel before.
    half = (shrink - 1) / 2
    back = np.array([[shrink, 0, left + half], [0, shrink, top + half], [0, 0, 1]])
    return np.asarray(cv2.warpAffine(small, there @ back, (side, side)), np.uint8), there
