"""Dark squares on a light ground: where a picture may have markers, and where their edges are.

Two adaptive thresholds propose quadrilaterals. Their corners are those of a polygon through pixels,
up to two pixels off; so each side is moved to where the picture gets brighter fastest, as in
AprilTag 2 (Wang and Olson 2016), before anything is read.
"""

from __future__ import annotations

from collections.abc import Iterator

import cv2
import numpy as np

from hri.core.geometry import Matrix
from hri.core.signals import Image

WINDOWS = (7, 23)
"""Pixels, widths of the adaptive thresholds."""
DARKER = 5
"""Levels below the mean around it that make a pixel dark."""
SMALLEST = 12
"""Pixels, mean side of a quadrilateral that is looked at."""
SHORTEST = 4.0
"""Pixels of each side."""
ROUGH = 0.05
"""Part of an outline's length by which its corners may be off."""
SAME = 1.5
"""Pixels by which middle and side of one quadrilateral differ, found twice."""
MOST = 400
"""Dark areas that are looked at; of a picture full of them the largest."""
BESIDE = (0.08, 0.16, 0.24)
"""Parts of the size by which it is made smaller and larger to see black ink and white paper."""
CONTRAST = 1.25
"""Times by which the paper is brighter than the ink, on each side."""
ROUNDS = 2
STEPS = 16
"""Places along a side where its edge is looked for."""
REACH = 2.5
"""Pixels to each side of it."""
ENDS = 0.08
"""Part of a side, at each end, in which it is not: corners are round in a blurred picture."""
STRAY = 0.5
"""Pixels off the line from where a place counts less."""
MOST_AT_ONCE = 30_000
"""Rows that OpenCV takes from a picture at a time; its limit is 32,767."""


def quads(gray: Image) -> Matrix:
    """Corners, clockwise, [count, 4, 2], pixels from the upper left corner of the picture."""
    rough = _framed(gray, _rough(gray))
    for _ in range(ROUNDS):
        rough = _on_edges(gray, rough)
    return rough


def sampled(gray: Image, places: Matrix) -> Matrix:
    """Brightness at places, [..., 2], pixels from the upper left corner."""
    flat = (places.reshape(-1, 1, 2) - 0.5).astype(np.float32)
    rows = [
        cv2.remap(
            gray, part[..., 0], part[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
        )
        for part in np.split(flat, range(MOST_AT_ONCE, len(flat), MOST_AT_ONCE))
    ]
    return np.concatenate(rows).astype(np.float64).reshape(places.shape[:-1])


def _rough(gray: Image) -> Matrix:
    found: list[Matrix] = []
    for window in WINDOWS:
        dark = cv2.adaptiveThreshold(
            gray, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY_INV, window, DARKER
        )
        found += _squares(np.asarray(dark, np.uint8))
    return np.array(found, np.float64).reshape(-1, 4, 2) + 0.5


def _squares(dark: Image) -> Iterator[Matrix]:
    """Outlines of dark areas that have four corners."""
    _, labels, boxes, _ = cv2.connectedComponentsWithStats(dark, connectivity=8)
    sides = boxes[1:, 2:4]  # the first is all that is not dark
    is_large = (sides.sum(axis=1) >= 2 * SMALLEST) & (sides.min(axis=1) >= SHORTEST)
    large = np.flatnonzero(is_large) + 1
    for label in large[np.argsort(-boxes[large, 2:4].sum(axis=1), kind="stable")][:MOST]:
        left, top, width, height = boxes[label, :4]
        area = (labels[top : top + height, left : left + width] == label).astype(np.uint8)
        outlines, _ = cv2.findContours(
            area, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE, offset=(int(left), int(top))
        )
        outline = max(outlines, key=len)
        corners = cv2.approxPolyDP(outline, ROUGH * len(outline), True)
        if len(corners) == 4 and cv2.isContourConvex(corners):
            yield corners.reshape(4, 2)[::-1]  # clockwise


def _framed(gray: Image, corners: Matrix) -> Matrix:
    """Those with ink on one side of each edge and paper on the other, each once."""
    middle = corners.mean(axis=1, keepdims=True)
    steps = np.linspace(0.1, 0.9, 7)[:, None]

    def beside(scale: float) -> Matrix:
        moved = middle + (corners - middle) * scale
        along = np.roll(moved, -1, axis=1) - moved
        light = sampled(gray, moved[:, :, None] + steps * along[:, :, None])
        mean: Matrix = light.mean(axis=2)
        return mean

    if not len(corners):
        return corners
    paper = np.max([beside(1 + step) for step in BESIDE], axis=0)
    ink = np.min([beside(1 - step) for step in BESIDE], axis=0)
    is_framed = (paper > CONTRAST * ink).all(axis=1)
    is_framed &= _lengths(corners).min(axis=1) >= SHORTEST
    return _once(corners[is_framed])


def _once(corners: Matrix) -> Matrix:
    """Without those that are nearly the same as one before."""
    about = np.concatenate([corners.mean(axis=1), _lengths(corners).mean(axis=1)[:, None]], axis=1)
    gaps = np.abs(about[:, None] - about[None]).max(axis=2)
    once: Matrix = corners[~np.tril(gaps <= SAME, -1).any(axis=1)]
    return once


def _on_edges(gray: Image, corners: Matrix) -> Matrix:
    """Where the sides meet once each lies on its edge; those without such edges are left out."""
    if not len(corners):
        return corners
    along = np.roll(corners, -1, axis=1) - corners
    lengths = _lengths(corners)[..., None]
    out = np.stack([along[..., 1], -along[..., 0]], axis=-1) / lengths
    middle = corners.mean(axis=1, keepdims=True)
    out *= np.sign(((corners + along / 2 - middle) * out).sum(axis=-1, keepdims=True))
    parts = np.linspace(ENDS, 1 - ENDS, STEPS)
    offsets = np.arange(-REACH, REACH + 0.25, 0.5)
    places = corners[:, :, None] + parts[:, None] * along[:, :, None]
    values = sampled(gray, places[..., None, :] + offsets[:, None] * out[:, :, None, None])
    rising = np.maximum(np.diff(values, axis=-1), 0.0) ** 2
    weights = rising.sum(axis=-1)
    shifts = (rising @ ((offsets[1:] + offsets[:-1]) / 2)) / np.maximum(weights, 1e-9)
    first, last = _fitted(parts, shifts, np.sqrt(weights))
    starts = corners + first[..., None] * out
    ends = corners + along + last[..., None] * out
    met = _crossings(starts, ends - starts)
    is_near = np.abs(met - corners).max(axis=(1, 2)) < 3 * REACH
    is_near &= np.isfinite(met).all(axis=(1, 2))
    is_near &= _lengths(met).min(axis=1) >= SHORTEST
    near: Matrix = met[is_near]
    return near


def _fitted(parts: Matrix, shifts: Matrix, weights: Matrix) -> tuple[Matrix, Matrix]:
    """By how much both ends of each side move: a line through the shifts, against outliers."""
    now = weights + 1e-6
    for _ in range(3):
        total = now.sum(axis=-1)
        mean_x, mean_y = (now @ parts) / total, (now * shifts).sum(axis=-1) / total
        x, y = parts - mean_x[..., None], shifts - mean_y[..., None]
        slope = (now * x * y).sum(axis=-1) / np.maximum((now * x * x).sum(axis=-1), 1e-12)
        off = y - slope[..., None] * x
        now = weights / (1 + (off / STRAY) ** 2) + 1e-6
    first: Matrix = mean_y - slope * mean_x
    return first, first + slope


def _crossings(places: Matrix, ways: Matrix) -> Matrix:
    """Where each side meets the one before."""
    before, back = np.roll(places, 1, axis=1), np.roll(ways, 1, axis=1)
    gap = places - before
    with np.errstate(divide="ignore", invalid="ignore"):
        part = _cross(gap, ways) / _cross(back, ways)
        met: Matrix = before + part[..., None] * back
    return met


def _cross(one: Matrix, other: Matrix) -> Matrix:
    across: Matrix = one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
    return across


def _lengths(corners: Matrix) -> Matrix:
    lengths: Matrix = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=-1)
    return lengths
