"""Faces by BlazeFace short range, MediaPipe's detector for faces near the camera.

Bazarevsky et al., "BlazeFace: sub-millisecond neural face detection on mobile GPUs" (2019).

The network sees faces of at least an eighth of its picture. So it looks at squares that cover the
picture together; small ones show faces that are far away.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np

from hri.core.signals import FaceBox, Image
from hri.vision.detectors.face import FoundFace, Places, merged
from hri.vision.detectors.network import Tensor, load_network
from hri.vision.detectors.preprocessing import evened, is_picture
from hri.vision.detectors.search_squares import Square, all_squares
from hri.vision.detectors.ssd_anchors import ssd_anchors
from hri.vision.face_models import DETECTOR, REMEDY

SIDE = 128
"""Pixels of the square picture that the network takes."""
GRIDS = ((16, 2), (8, 6))
"""Cells of each of its two grids along a side, and its proposals for each cell."""
POINTS = 6
"""Eyes, tip of the nose, mouth, ears."""
LEAST_SCORE = 0.55
AROUND = 4.0
"""Side of the square in which a face is looked at again, in sizes of the face: the network sees
faces best that are a quarter of its picture, and patterns that looked like one no longer do."""
SAME_PLACE = 0.5
"""Sizes of the face by which its middle may move then."""
SEEN_SIDE = 800
"""Pixels; of a larger picture only each second, third ... pixel is looked at."""


class BlazeFace:
    """Finds faces in about 4 ms a square, and 4 ms for each face.

    Raises NotAvailable when the file is not the network.
    """

    def __init__(self, file: Path) -> None:
        self._network = load_network(file, DETECTOR.sha256, REMEDY)
        self._anchors = ssd_anchors(GRIDS)

    def squares(self, width: int, height: int) -> list[Square]:
        """Those of all sizes, down to where a face of 20 pixels is found (of at most 800)."""
        step = _step(width, height)
        seen = all_squares(math.ceil(width / step), math.ceil(height / step))
        return [Square(one.left * step, one.top * step, one.side * step) for one in seen]

    def find(self, image: Image, squares: Sequence[Square] | None = None) -> list[FoundFace]:
        """The faces in these squares, or in all of them, the surest first.

        An invalid picture has no faces.
        """
        if not is_picture(image):
            return []
        height, width = image.shape[:2]
        step = _step(width, height)
        sparse = image[::step, ::step]
        found = [
            face
            for one in (self.squares(width, height) if squares is None else squares)
            for face in self._look(
                sparse, Square(one.left // step, one.top // step, one.side // step)
            )
        ]
        sure = [again for face in merged(found) if (again := self._seen_again(sparse, face))]
        return [_scaled(face, step) for face in merged(sure)]

    def _seen_again(self, image: Image, face: FoundFace) -> FoundFace | None:
        """The face as it is seen in a square around it; None where a pattern is not seen again."""
        x, y = face.middle
        breadth = max(face.box.width, face.box.height)
        side = round(min(AROUND * breadth, max(image.shape[:2])))
        square = Square(round(x - side / 2), round(y - side / 2), side)
        near = [
            other
            for other in self._look(image, square)
            if math.dist(other.middle, face.middle) < SAME_PLACE * breadth
        ]
        return max(near, key=lambda other: other.score, default=None)

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


def _step(width: int, height: int) -> int:
    """Each how many-th pixel is looked at."""
    return math.ceil(max(width, height) / SEEN_SIDE)


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
