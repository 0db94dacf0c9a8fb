"""A face found in a picture, and what finds faces."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import astuple, dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import FaceBox, Image
from hri.vision.detectors.search_squares import Square

Places = NDArray[np.float32]
"""Places in a picture, shape [n, 2]: x and y in pixels."""

SAME = 0.3
"""Boxes that overlap by this part of all they cover are of one face."""
INSIDE = 0.6
"""So are those of which one has this share of its area in the other."""


@dataclass(frozen=True, slots=True)
class FoundFace:
    """A face in a picture, in its pixels."""

    box: FaceBox
    score: float
    """How surely it is a face, 0 to 1."""
    points: Places | None = None
    """The person's right eye (at the left of the picture), left eye, tip of the nose, middle of the
    mouth, and further points of the detector; None when it gives only a box.
    """

    @property
    def middle(self) -> tuple[float, float]:
        """Of the box, in pixels."""
        return self.box.x + self.box.width / 2, self.box.y + self.box.height / 2


class FaceFinder(Protocol):
    """Finds the faces of a picture; remembers nothing of those before."""

    def squares(self, width: int, height: int) -> list[Square]:
        """The parts of a picture of this size that a whole search looks at, the largest first."""
        ...

    def find(self, image: Image, squares: Sequence[Square] | None = None) -> list[FoundFace]:
        """The faces in these parts, or in all of them, the surest first.

        What is not an 8-bit RGB picture has none.
        """
        ...


def overlap(first: FaceBox, second: FaceBox) -> float:
    """The common area of two boxes as a part of all they cover, 0 to 1."""
    common = _common(first, second)
    covered = first.width * first.height + second.width * second.height - common
    return common / covered if covered > 0 else 0.0


def is_same(first: FaceBox, second: FaceBox) -> bool:
    """Whether two boxes found in one picture are of one face."""
    smaller = min(first.width * first.height, second.width * second.height)
    return overlap(first, second) > SAME or _common(first, second) > INSIDE * smaller


def merged(found: Iterable[FoundFace]) -> list[FoundFace]:
    """One face for all findings of the same one: the average of those of about the surest one's
    size, weighted by their scores.

    Either all findings have points, or none. The surest face comes first.
    """
    # The box decides between equal scores, so that the order never depends on the input's.
    rest = sorted(found, key=lambda face: (-face.score, *astuple(face.box)))
    faces = []
    while rest:
        best = rest[0]
        alike = [face for face in rest if overlap(face.box, best.box) > SAME or face is best]
        faces.append(_average(alike, best.score))
        rest = [face for face in rest[1:] if not is_same(face.box, best.box)]
    return faces


def _average(same: list[FoundFace], score: float) -> FoundFace:
    weights = [face.score for face in same]
    rows = [astuple(face.box) for face in same]
    box = FaceBox(*np.average(rows, axis=0, weights=weights).tolist())
    places = [face.points for face in same if face.points is not None]
    points = np.average(places, axis=0, weights=weights).astype(np.float32) if places else None
    return FoundFace(box, score, points)


def _common(first: FaceBox, second: FaceBox) -> float:
    across = min(first.x + first.width, second.x + second.width) - max(first.x, second.x)
    down = min(first.y + first.height, second.y + second.height) - max(first.y, second.y)
    return max(0.0, across) * max(0.0, down)
