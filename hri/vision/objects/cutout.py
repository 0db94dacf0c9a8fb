"""Where in a picture the object is that is shown, so that what is behind it is not learned."""

from __future__ import annotations

from collections.abc import Iterable

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.vision.objects.object_model import Outline

MIDDLE = 0.6
"""Part of the picture, in each direction, in which an object is held up."""
EVEN = 12.0
"""Standard deviation, of 255, of a border that is one color."""
DIFFERENT = 28
"""Levels of a color by which a pixel is not the background's."""
SMALLEST, LARGEST = 0.01, 0.95
"""Parts of the picture; what is smaller or larger is not an outline."""
MAIN = 0.8
"""Of the whole, a part that stands for it."""
CORNER = 0.006
"""How far an outline may be simplified, as a part of its length."""
COARSE = 160
"""Pixels, width of the picture in which an object is cut out of a room."""
AROUND = 0.3
"""Sizes of what moves: the breadth of the room around it that is looked at."""
LONGEST = 16
"""Times the shorter side; nothing is held up in a picture that is longer."""

Mask = NDArray[np.uint8]


def whole(image: Image) -> Outline:
    """The outline of the whole picture."""
    height, width = image.shape[:2]
    return np.array([(0, 0), (width, 0), (width, height), (0, height)], np.float32)


def middle(image: Image) -> Outline:
    """The box in the middle in which an object is to be held."""
    center = np.array([image.shape[1] / 2, image.shape[0] / 2], np.float32)
    return np.asarray(center + (whole(image) - center) * MIDDLE, np.float32)


def opaque(image: Image, alpha: Mask | None) -> Outline | None:
    """The outline of the opaque part, else of a thing before an even background, else of all.

    None when hardly anything is opaque.
    """
    share = 1.0 if alpha is None else float((alpha > 127).mean())
    if alpha is None or share > LARGEST:
        return on_even_background(image)
    return _largest((alpha > 127).astype(np.uint8), has_parts=True)


def on_even_background(image: Image) -> Outline:
    """What stands before a background of one color; the whole picture where there is none."""
    border = np.concatenate([image[0], image[-1], image[:, 0], image[:, -1]]).astype(np.float32)
    if border.std(axis=0).max() > EVEN:
        return whole(image)
    distance = np.abs(image.astype(np.float32) - np.median(border, axis=0)).max(axis=2)
    outline = _largest((distance > DIFFERENT).astype(np.uint8))
    return whole(image) if outline is None else outline


def in_the_middle(
    image: Image, hidden: Iterable[Outline] = (), moving: Mask | None = None
) -> Outline | None:
    """What is held in the middle of a picture of a room (Rother et al., "GrabCut", 2004).

    `hidden` are outlines of what does not belong to it: faces that look over it, and hands.
    `moving` is where it can be, as far as it was seen to move, of the size of `coarse`; else it can
    be anywhere in the middle. None when nothing stands out.
    """
    if max(image.shape[:2]) > LONGEST * min(image.shape[:2]):
        return None
    small = coarse(image)
    scale = small.shape[1] / image.shape[1]
    possible = np.zeros(small.shape[:2], np.uint8)
    if moving is None:
        (left, top), _, (right, bottom), _ = middle(small).astype(int).tolist()
        possible[top:bottom, left:right] = 1
    else:
        possible[:] = cv2.dilate(moving, np.ones((3, 3), np.uint8))
    for outline in hidden:
        cv2.fillPoly(possible, [np.rint(outline * scale).astype(np.int32)], 0)
    if not possible.any():
        return None
    near = (slice(None), slice(None)) if moving is None else _around(possible)
    mask = np.where(possible[near] > 0, cv2.GC_PR_FGD, cv2.GC_BGD).astype(np.uint8)
    if (mask == cv2.GC_PR_FGD).all():
        return None
    models = np.zeros((1, 65)), np.zeros((1, 65))
    cv2.setRNGSeed(0)
    no_box = (0, 0, 0, 0)  # the mask says it all
    cv2.grabCut(small[near][..., ::-1].copy(), mask, no_box, *models, 3, cv2.GC_INIT_WITH_MASK)
    found = np.zeros(small.shape[:2], np.uint8)
    found[near] = mask & 1
    largest = _largest(found)
    return None if largest is None else np.asarray(largest / scale, np.float32)


def coarse(image: Image) -> Image:
    """The picture in which an object is cut out of a room."""
    scale = COARSE / image.shape[1]
    size = COARSE, max(1, round(image.shape[0] * scale))
    return np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), np.uint8)


def _around(mask: Mask) -> tuple[slice, slice]:
    """What is near it: farther away the room may have the thing's colors."""
    left, top, width, height = cv2.boundingRect(mask)
    margin = max(4, round(AROUND * max(width, height)))
    return (
        slice(max(0, top - margin), top + height + margin),
        slice(max(0, left - margin), left + width + margin),
    )


def _largest(mask: Mask, *, has_parts: bool = False) -> Outline | None:
    """The outline of the largest region, without its fringes; None when it is out of range.

    What `has_parts` is around all of them, unless the others hardly count.
    """
    size = max(3, round(max(mask.shape) / 80)) | 1
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
    closed = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, kernel)
    found, _ = cv2.findContours(
        cv2.morphologyEx(closed, cv2.MORPH_OPEN, kernel),
        cv2.RETR_EXTERNAL,
        cv2.CHAIN_APPROX_SIMPLE,
    )
    if not found:
        return None
    contour = max(found, key=cv2.contourArea)
    if has_parts and cv2.contourArea(contour) < MAIN * sum(map(cv2.contourArea, found)):
        contour = cv2.convexHull(np.concatenate(found))
    if not SMALLEST <= cv2.contourArea(contour) / mask.size <= LARGEST:
        return None
    corners = cv2.approxPolyDP(contour, CORNER * cv2.arcLength(contour, True), True)
    return np.asarray(corners[:, 0], np.float32) if len(corners) >= 3 else None
