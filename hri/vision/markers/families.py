"""Families of markers: which ids each has, and how one of them is drawn in cells."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np

from hri.core.errors import HriError, did_you_mean
from hri.core.geometry import Matrix


@dataclass(frozen=True)
class Family:
    """Square markers with a black frame of one cell around their bits."""

    name: str
    number: int
    """Of the dictionary in OpenCV."""
    most_wrong: int
    """Cells that may look otherwise: fewer than half of those in which two markers differ."""

    @cached_property
    def dictionary(self) -> cv2.aruco.Dictionary:
        """As OpenCV knows it."""
        return cv2.aruco.getPredefinedDictionary(self.number)

    @property
    def count(self) -> int:
        """Of its markers; their ids are 0 to one less."""
        return len(self.dictionary.bytesList)

    @property
    def width(self) -> int:
        """Cells of a side, with the black frame."""
        return int(self.dictionary.markerSize) + 2

    def cells(self, id: int) -> Matrix:
        """Of a marker, with one more white cell around: [`width` + 2, `width` + 2], 1 is white.

        Raises HriError for an id that the family does not have.
        """
        if not 0 <= id < self.count:
            raise HriError(f"{self.name} has no marker {id} - choose one of 0 to {self.count - 1}")
        drawn = self.dictionary.generateImageMarker(id, self.width, borderBits=1)
        return np.pad(drawn / 255.0, 1, constant_values=1.0)


FAMILIES = {
    family.name: family
    for family in (
        Family("apriltag_36h11", cv2.aruco.DICT_APRILTAG_36h11, 5),
        Family("aruco_4x4_50", cv2.aruco.DICT_4X4_50, 1),
        Family("aruco_5x5_50", cv2.aruco.DICT_5X5_50, 3),
    )
}
DEFAULT = "apriltag_36h11"
QR = "qr"
"""Codes with a text; they have no id."""


NAMES = (*FAMILIES, QR)


def check_families(names: Iterable[str]) -> tuple[str, ...]:
    """The same names. Raises HriError for one that is unknown, and for none at all."""
    chosen = tuple(names)
    for name in chosen:
        if name not in NAMES:
            raise HriError(f'no family "{name}" - {did_you_mean(name, NAMES)}')
    if not chosen:
        raise HriError(f"no family of markers to look for - name some of {', '.join(NAMES)}")
    return chosen
