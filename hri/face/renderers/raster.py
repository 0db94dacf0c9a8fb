"""Paints shapes into an RGB picture with OpenCV: sharp at any size, the same bytes every time.

A shape becomes a coverage mask: filled at four times the size, averaged down. A gradient becomes
an index map looked up in 256 colors. Both are only as large as the shape.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.face.paint import Gradient, Paint, Solid, Stop

Mask = NDArray[np.uint8]
"""Shape [height, width], 0 to 255: how much of each pixel is covered."""
Points = NDArray[np.float32]
"""Shape [n, 2], pixels."""
Box = tuple[int, int, int, int]
"""Left, top, right, bottom in pixels; right and bottom lie outside."""

FINE = 4
"""Sub-pixels along each side of a pixel."""
_SHIFT = 4
"""Bits behind the point of a vertex."""


def box_of(contours: Sequence[Points], margin: float, within: Box) -> Box | None:
    """The pixels that contours may touch; None when there are none."""
    low = np.min([points.min(axis=0) for points in contours], axis=0) - margin
    high = np.max([points.max(axis=0) for points in contours], axis=0) + margin
    left, top = max(int(np.floor(low[0])), within[0]), max(int(np.floor(low[1])), within[1])
    right, bottom = min(int(np.ceil(high[0])), within[2]), min(int(np.ceil(high[1])), within[3])
    return (left, top, right, bottom) if left < right and top < bottom else None


def filled(contours: Sequence[Points], box: Box) -> Mask:
    """Coverage of the inside of contours (even-odd)."""
    mask = _fine_mask(box)
    cv2.fillPoly(mask, [_fixed(points, box) for points in contours], 255, cv2.LINE_8, _SHIFT)
    return _averaged(mask, box)


def stroked(contours: Sequence[Points], closed: Sequence[bool], width: float, box: Box) -> Mask:
    """Coverage of a line of a width in pixels along contours, with round ends."""
    mask = _fine_mask(box)
    thickness = max(1, round(width * FINE))
    for points, is_closed in zip(contours, closed, strict=True):
        line = [_fixed(points, box)]
        cv2.polylines(mask, line, is_closed, 255, thickness, cv2.LINE_8, _SHIFT)
    return _averaged(mask, box)


def paint(
    canvas: Image, origin: tuple[int, int], mask: Mask, box: Box, color: Image | Solid
) -> None:
    """Lay a color, or a picture of the size of the box, over the canvas where the mask says."""
    left, top = box[0] - origin[0], box[1] - origin[1]
    region = canvas[top : top + mask.shape[0], left : left + mask.shape[1]]
    mask3 = cv2.cvtColor(mask, cv2.COLOR_GRAY2RGB)
    if isinstance(color, Solid):
        laid = cv2.multiply(mask3, np.array((*color.color, 0), float), scale=1 / 255)
    else:
        laid = cv2.multiply(color, mask3, scale=1 / 255)
    kept = cv2.multiply(region, cv2.bitwise_not(mask3), scale=1 / 255)
    cv2.add(kept, laid, dst=region)


def shaded(
    fill: Paint, anchors: Points, opacity: float, mask: Mask, box: Box
) -> tuple[Mask, Image | Solid]:
    """The mask with all opacities in it, and what to lay down through it."""
    if isinstance(fill, Solid):
        share = opacity * fill.opacity
        return (mask if share >= 1 else _scaled(mask, share)), fill
    index = _index_map(fill, anchors, box)
    colors, alphas = _tables(fill.stops)
    if alphas is not None:
        product = cv2.multiply(mask, cv2.LUT(index, alphas), scale=opacity / 255)
        mask = np.asarray(product, np.uint8)
    elif opacity < 1:
        mask = _scaled(mask, opacity)
    return mask, np.asarray(cv2.applyColorMap(index, colors), np.uint8)


def _scaled(values: NDArray[Any], factor: float) -> Mask:
    return np.asarray(cv2.convertScaleAbs(values, alpha=factor), np.uint8)


def _fine_mask(box: Box) -> Mask:
    return np.zeros(((box[3] - box[1]) * FINE, (box[2] - box[0]) * FINE), np.uint8)


def _fixed(points: Points, box: Box) -> NDArray[np.int32]:
    """Vertices in sub-pixels of the box; sub-pixel n has its center at n."""
    fine = (points - np.array(box[:2], np.float32)) * FINE - np.float32(0.5)
    fixed: NDArray[np.int32] = np.rint(fine * (1 << _SHIFT)).astype(np.int32)
    return fixed


def _averaged(mask: Mask, box: Box) -> Mask:
    size = (box[2] - box[0], box[3] - box[1])
    return np.asarray(cv2.resize(mask, size, interpolation=cv2.INTER_AREA), np.uint8)


def _index_map(gradient: Gradient, anchors: Points, box: Box) -> Mask:
    """How far along the gradient each pixel lies, 0 to 255."""
    x = np.arange(box[0], box[2], dtype=np.float32) + np.float32(0.5) - anchors[0, 0]
    y = np.arange(box[1], box[3], dtype=np.float32) + np.float32(0.5) - anchors[0, 1]
    axes = anchors[1:] - anchors[0]
    if not gradient.is_radial:
        slope = axes[0] * 255 / max(float(axes[0] @ axes[0]), 1e-9)
        along = np.add.outer(y * slope[1], x * slope[0])
        return np.asarray(np.clip(along, 0, 255, out=along), np.uint8)
    size = float(axes[0, 0] * axes[1, 1] - axes[0, 1] * axes[1, 0])
    scale = np.float32(255 / (size if abs(size) > 1e-9 else 1e-9))
    across = np.add.outer(y * (-axes[1, 0] * scale), x * (axes[1, 1] * scale))
    down = np.add.outer(y * (axes[0, 0] * scale), x * (-axes[0, 1] * scale))
    return _scaled(cv2.magnitude(across, down), 1.0)


@lru_cache(maxsize=512)
def _tables(stops: tuple[Stop, ...]) -> tuple[Image, Mask | None]:
    """256 colors and, unless all are opaque, 256 opacities."""
    offsets = [stop.offset for stop in stops]
    at = np.linspace(0, 1, 256)
    colors = np.array([stop.color for stop in stops])
    opacities = [stop.opacity for stop in stops]
    table = np.stack([np.interp(at, offsets, colors[:, k]) for k in range(3)], axis=-1)
    rounded = np.rint(table).astype(np.uint8).reshape(256, 1, 3)
    if min(opacities) >= 1:
        return rounded, None
    return rounded, np.rint(np.interp(at, offsets, opacities) * 255).astype(np.uint8)
