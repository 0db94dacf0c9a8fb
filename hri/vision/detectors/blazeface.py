"""Faces by BlazeFace short range, MediaPipe's detector for faces near the camera, in OpenCV.

Bazarevsky et al., "BlazeFace: sub-millisecond neural face detection on mobile GPUs" (2019).

The network sees faces of at least an eighth of its picture. So it looks at squares that cover the
picture together, and each time in turn at the whole of it or at one of some smaller squares: a
face that is very near, or far away, is found within some pictures.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from hri.core.signals import FaceBox, Image
from hri.vision.detectors.face import FoundFace, Places, merged
from hri.vision.detectors.opencv_network import OpenCvNetwork, Tensor
from hri.vision.detectors.preprocessing import evened, is_picture
from hri.vision.face_models import DETECTOR, REMEDY

SIDE = 128
"""Pixels of the square picture that the network takes."""
GRIDS = ((16, 2), (8, 6))
"""Cells of each of its two grids along a side, and its proposals for each cell."""
POINTS = 6
"""Eyes, tip of the nose, mouth, ears."""
LEAST_SCORE = 0.55
SEEN_SIDE = 800
"""Pixels; of a larger picture only each second, third ... pixel is looked at."""
OVERLAP = 0.2
"""Part of a square by which the next one reaches into it, at least."""
BETWEEN = 3
"""Smaller squares between two looks at the whole: only a face that fills it needs the whole."""
MOST_PIECES = 6
"""Squares along a side at most; of a picture more oblong than any camera's some is not seen."""
SMALLER = 2 / 3
"""Side of the smaller squares as a part of that of the larger ones."""


@dataclass(frozen=True, slots=True)
class Square:
    """A part of a picture, which may reach over its edges."""

    left: int
    top: int
    side: int


class BlazeFace:
    """Finds faces in about 8 ms.

    Raises NotAvailable when the file is not the network.
    """

    def __init__(self, file: Path) -> None:
        self._network = OpenCvNetwork(file, DETECTOR.sha256, REMEDY)
        self._anchors = _anchors()

    def find(self, image: Image, turn: int = 0) -> list[FoundFace]:
        """All faces, the surest first; none for an invalid picture."""
        if not is_picture(image):
            return []
        step = math.ceil(max(image.shape[:2]) / SEEN_SIDE)
        sparse = image[::step, ::step]
        height, width = sparse.shape[:2]
        squares, others = squares_of(width, height)
        squares.append(others[turn % len(others)])
        found = [face for square in squares for face in self._look(sparse, square)]
        return [_scaled(face, step) for face in merged(found)]

    def _look(self, image: Image, square: Square) -> list[FoundFace]:
        picture = evened(_part(image, square)) * 2 - 1
        answers = self._network.run(picture)
        # The two answers: a score for each proposal, and its box and points.
        scores, places = sorted(answers, key=len)
        likely = np.flatnonzero(scores > math.log(LEAST_SCORE / (1 - LEAST_SCORE)))
        rows = places.reshape(len(scores), -1)[likely].astype(np.float64)
        found = []
        for row, score, anchor in zip(rows, scores[likely], self._anchors[likely], strict=True):
            face = _face(row, anchor, 1 / (1 + math.exp(-min(50.0, float(score)))), square)
            if min(face.box.width, face.box.height) > 0 and _is_whole(face.box, square, image):
                found.append(face)
        return found


def squares_of(width: int, height: int) -> tuple[list[Square], list[Square]]:
    """Where to look each time, and where in turn."""
    long, short = max(width, height), min(width, height)
    always = _covering(width, height, short)
    smaller = _covering(width, height, max(1, round(SMALLER * short)))
    if len(always) == 1:
        return always, smaller
    whole = Square((width - long) // 2, (height - long) // 2, long)
    in_turn = []
    for first in range(0, len(smaller), BETWEEN):
        in_turn += [whole, *smaller[first : first + BETWEEN]]
    return always, in_turn


def _covering(width: int, height: int, side: int) -> list[Square]:
    return [
        Square(left, top, side)
        for top, left in itertools.product(_starts(height, side), _starts(width, side))
    ]


def _starts(length: int, side: int) -> list[int]:
    """Where pieces of a length begin that overlap enough and cover it evenly."""
    rest = max(0, length - side)
    count = min(MOST_PIECES, 1 + math.ceil(rest / ((1 - OVERLAP) * side)))
    return [round(place) for place in np.linspace(0, rest, count)]


def _part(image: Image, square: Square) -> Image:
    """The part as the network takes it; black where it reaches over the edge of the picture."""
    height, width = image.shape[:2]
    left, top = max(0, square.left), max(0, square.top)
    right, bottom = min(width, square.left + square.side), min(height, square.top + square.side)
    scale = SIDE / square.side
    size = max(1, round((right - left) * scale)), max(1, round((bottom - top) * scale))
    part = np.zeros((SIDE, SIDE, 3), np.uint8)
    x, y = round((left - square.left) * scale), round((top - square.top) * scale)
    small = cv2.resize(image[top:bottom, left:right], size, interpolation=cv2.INTER_AREA)
    part[y : y + size[1], x : x + size[0]] = small[: SIDE - y, : SIDE - x]
    return part


def _face(row: Tensor, anchor: Tensor, score: float, square: Square) -> FoundFace:
    """What a proposal says, in pixels of the picture: middle, size and points."""
    corner = np.array((square.left, square.top))
    x, y = (row[:2] / SIDE + anchor) * square.side + corner
    width, height = row[2:4] / SIDE * square.side
    points = (row[4:].reshape(POINTS, 2) / SIDE + anchor) * square.side + corner
    box = FaceBox(float(x - width / 2), float(y - height / 2), float(width), float(height))
    return FoundFace(box, score, points.astype(np.float32))


def _is_whole(box: FaceBox, square: Square, image: Image) -> bool:
    """Whether a box is not cut by an edge of the square inside of the picture."""
    height, width = image.shape[:2]
    return (
        (box.x > square.left or square.left <= 0)
        and (box.y > square.top or square.top <= 0)
        and (box.x + box.width < square.left + square.side or square.left + square.side >= width)
        and (box.y + box.height < square.top + square.side or square.top + square.side >= height)
    )


def _scaled(face: FoundFace, scale: int) -> FoundFace:
    box = face.box
    points: Places | None = None if face.points is None else face.points * np.float32(scale)
    return FoundFace(
        FaceBox(box.x * scale, box.y * scale, box.width * scale, box.height * scale),
        face.score,
        points,
    )


def _anchors() -> Tensor:
    """The middle of the cell of each proposal, shape [896, 2], 0 to 1."""
    anchors: Sequence[tuple[float, float]] = [
        ((x + 0.5) / cells, (y + 0.5) / cells)
        for cells, proposals in GRIDS
        for y in range(cells)
        for x in range(cells)
        for _ in range(proposals)
    ]
    return np.array(anchors, np.float32)
