"""What is held up before a camera; pictures of someone's face and of the room alone teach nothing.

What moves while the room stands still is the thing, without the hand that holds it. One picture
alone does not separate a thing from its background. So the area that is taken for the thing must
have an edge around it, and no face may be in it or where it is to be held.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np

from hri.core.signals import FaceBox, Image
from hri.vision.detectors.detector_choice import load_detectors
from hri.vision.objects.cutout import COARSE, Mask, coarse, in_the_middle, middle, whole
from hri.vision.objects.holding_hands import HandFinder
from hri.vision.objects.moving import MovingThing
from hri.vision.objects.object_model import Outline

SURE = 0.66
"""Score of a face: patterns of things look like fainter ones."""
COVERED = 0.25
"""Part of a face that is in what was cut out."""
EDGED = 0.8
"""Part of an outline that must be an edge of the picture, too."""
BESIDE = 0.02
"""Parts of the picture's width; so far on both sides of an edge the colors are compared."""
DIFFERENT = 16
"""Levels of a color by which they differ."""
A_FACE, NOTHING = "a face is in it", "nothing is held up"
"""Why a picture teaches nothing."""


@dataclass(frozen=True, slots=True)
class HeldUp:
    """The outline of a thing, or why there is none."""

    outline: Outline | None
    reason: str = ""
    has_moved: bool = False
    """Whether it is known by its motion."""


class HeldUpFinder:
    """Looks for the thing that is held up in the middle of the pictures of a camera at rest."""

    def __init__(self, *, is_whole: bool = False) -> None:
        """`is_whole`: the thing fills the pictures."""
        self._finder = load_detectors().finder
        self._hands = HandFinder()
        self._moving = MovingThing()
        self._is_whole = is_whole

    def find(self, image: Image, faces: Iterable[FaceBox] = ()) -> HeldUp:
        """`image` is uint8, [height, width, 3], RGB; `faces` are those that are known already."""
        boxes = [*faces, *self._near_faces(image)]
        moving = None if self._is_whole else self._moving.look(coarse(image))
        if self._is_whole:
            outline: Outline | None = whole(image)
        else:
            hidden = [*map(_corners, boxes), *self._hands.find(image)]
            outline = in_the_middle(image, hidden, moving)
        taken = [_filled(image, outline)] + ([] if moving is None else [moving])
        place = middle(image)
        for box in boxes:
            # A face that looks on from the room stands still.
            is_in_place = moving is None and _is_inside(box, place)
            if is_in_place or max(_share(box, mask, image) for mask in taken) > COVERED:
                return HeldUp(None, A_FACE)
        if outline is None or not (self._is_whole or _is_edged(image, outline)):
            return HeldUp(None, NOTHING)
        return HeldUp(outline, has_moved=moving is not None)

    def _near_faces(self, image: Image) -> list[FaceBox]:
        """Those as near as whoever holds the thing up."""
        height, width = image.shape[:2]
        squares = self._finder.squares(width, height)
        large = [square for square in squares if square.side >= squares[0].side]
        return [face.box for face in self._finder.find(image, large) if face.score >= SURE]


def _corners(box: FaceBox) -> Outline:
    right, bottom = box.x + box.width, box.y + box.height
    return np.array([(box.x, box.y), (right, box.y), (right, bottom), (box.x, bottom)], np.float32)


def _is_inside(box: FaceBox, place: Outline) -> bool:
    center = box.x + box.width / 2, box.y + box.height / 2
    return cv2.pointPolygonTest(place, center, False) >= 0


def _filled(image: Image, outline: Outline | None) -> Mask:
    """1 within an outline, in a picture of the size of `coarse`."""
    mask: Mask = np.zeros((max(1, round(image.shape[0] * COARSE / image.shape[1])), COARSE), "u1")
    if outline is not None:
        corners = np.rint(outline * (COARSE / image.shape[1])).astype(np.int32)
        cv2.fillPoly(mask, [corners], 1)
    return mask


def _share(box: FaceBox, mask: Mask, image: Image) -> float:
    """The part of a face that a mask of the size of `coarse` covers."""
    scale = COARSE / image.shape[1]
    across, down = (
        slice(max(0, int(low * scale)), max(0, int(high * scale)) + 1)
        for low, high in ((box.x, box.x + box.width), (box.y, box.y + box.height))
    )
    inside = mask[down, across]
    return float(inside.mean()) if inside.size else 0.0


def _is_edged(image: Image, outline: Outline) -> bool:
    """Whether colors differ across most of an outline: where the room goes on, they do not."""
    scale = COARSE / image.shape[1]
    small = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    soft = cv2.GaussianBlur(small, (0, 0), 0.8).astype(np.int16)
    corners = outline.astype(np.float64) * scale
    places, normals = [], []
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        length = float(np.hypot(*(end - start)))
        if length == 0:
            continue
        steps = (np.arange(max(1, int(length / 2))) + 0.5) / max(1, int(length / 2))
        places.append(start + (end - start) * steps[:, None])
        across = np.array([start[1] - end[1], end[0] - start[0]]) / length
        normals.append(np.repeat(across[None], len(steps), axis=0))
    if not places:
        return False
    at, aside = np.concatenate(places), np.concatenate(normals) * BESIDE * COARSE
    last = np.array([soft.shape[1] - 1, soft.shape[0] - 1])
    one, other = (np.clip(np.rint(at + way), 0, last).astype(int) for way in (aside, -aside))
    differences = np.abs(soft[one[:, 1], one[:, 0]] - soft[other[:, 1], other[:, 0]])
    return float((differences.max(axis=1) > DIFFERENT).mean()) >= EDGED
