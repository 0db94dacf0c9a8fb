"""Finds the markers of a picture: which they are, where, and how they are turned."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import cv2
import numpy as np

from hri.core.geometry import ROBOT_FROM_CAMERA, Matrix, Pose3D
from hri.core.signals import Image, Marker
from hri.vision.camera_view import CameraView
from hri.vision.markers.families import DEFAULT, FAMILIES, QR, Family, check_families
from hri.vision.markers.marker_pose import square_pose, tilt_of
from hri.vision.markers.qr_codes import codes
from hri.vision.markers.quads import quads
from hri.vision.markers.reading import read

SIDE = 0.1
"""Meters of the black square of a card, as `hri marker print` makes it."""
LIKENESS, LEAD = 0.82, 0.065
"""Least correlation with a marker, and by how much it leads; of 88 squares in photographs that
are not markers, none came near both."""
Sign = tuple[str, int, str, Matrix]
"""Family, id, text and corners of a marker."""


class MarkerReader:
    """Finds markers of some families, all of the same size, each picture by itself."""

    def __init__(
        self,
        families: Sequence[str] = (DEFAULT,),
        side: float = SIDE,
        view: CameraView | None = None,
    ) -> None:
        """`side` is of the black square, meters. Raises HriError for an unknown family."""
        self._names = check_families(families)
        self._side, self._view = side, view or CameraView()

    def find(self, image: Image, pan: float = 0.0) -> tuple[Marker, ...]:
        """The markers of a picture, the nearest first.

        `image` is uint8, [height, width, 3], RGB; `pan` is by how much the camera is turned to the
        left beside its mount, radians.
        """
        if min(image.shape[:2]) < 8:
            return ()
        gray = np.asarray(cv2.cvtColor(image, cv2.COLOR_RGB2GRAY), np.uint8)
        size = image.shape[1], image.shape[0]
        found = (self._placed(sign, size, pan) for sign in self._signs(gray))
        return tuple(sorted(filter(None, found), key=lambda one: one.distance))

    def _signs(self, gray: Image) -> Iterator[Sign]:
        if families := [FAMILIES[name] for name in self._names if name in FAMILIES]:
            squares = quads(gray)
            for family in families:
                yield from _of_family(gray, squares, family)
        if QR in self._names:
            for text, corners in codes(gray):
                yield QR, -1, text, corners

    def _placed(self, sign: Sign, size: tuple[int, int], pan: float) -> Marker | None:
        family, id, text, corners = sign
        pose = square_pose(corners, self._view.focal_length(size), size)
        if pose is None:
            return None
        mount = self._view.mount
        turn = Pose3D(yaw=pan).rotation() @ mount.rotation() @ ROBOT_FROM_CAMERA
        away: Matrix = turn @ (pose.place * self._side)
        x, y = corners.mean(axis=0)
        return Marker(
            family,
            id,
            tuple((float(x), float(y)) for x, y in corners),
            float(x),
            float(y),
            float(np.linalg.norm(away)),
            math.atan2(away[1], away[0]),
            math.atan2(away[2], math.hypot(away[0], away[1])),
            tilt_of(pose),
            _triple(away + np.array([mount.x, mount.y, mount.z])),
            _triple(turn @ pose.rotation[:, 2]),
            pose.is_sure,
            text,
        )


def _of_family(gray: Image, squares: Matrix, family: Family) -> Iterator[Sign]:
    """What of these squares is surely a marker; the surest where the same is read twice."""
    sure = [
        one
        for one in read(gray, squares, family)
        if one.likeness >= LIKENESS and one.lead >= LEAD and one.wrong <= family.most_wrong
    ]
    kept: list[Matrix] = []
    for one in sorted(sure, key=lambda one: -one.likeness):
        middle = one.corners.mean(axis=0)
        reach = float(np.ptp(one.corners, axis=0).max()) / 2
        if all(np.abs(middle - other).max() > reach for other in kept):
            kept.append(middle)
            yield family.name, one.id, "", one.corners


def _triple(vector: Matrix) -> tuple[float, float, float]:
    x, y, z = vector.tolist()
    return x, y, z
