"""Draws a face model: weights in, an RGB picture out.

What never morphs at the back of the display list (background, body, shell) is painted once, at
twice the size and a little beyond the frame; each frame starts with that picture moved as the head
moves. All the rest is painted anew, exactly where it is.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Image
from hri.face.baking import Item, Opening, Shape, Vector
from hri.face.model import FaceModel
from hri.face.outline import Matrix, apply, compose
from hri.face.renderers import raster
from hri.face.renderers.raster import Box, Mask, Points

SMALLEST, LARGEST = 16, 4096
"""Pixels along a side of a picture."""
_FINE = 2
"""Size of the backdrop's pixels against those of the picture."""
_BEYOND = 0.08
"""How far the backdrop reaches beyond the picture, as a share of its larger side."""
_FAINT = 1 / 255
"""Less opacity than this shows nothing."""


class OpenCvRenderer:
    """Draws one face at one size; the same weights always give the same bytes."""

    def __init__(self, model: FaceModel, size: tuple[int, int] = (640, 480)) -> None:
        """`size` is width and height in pixels. Raises HriError for one that is out of range."""
        width, height = size
        if not (SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
            raise HriError(
                f"a picture of {width}x{height} - give sides from {SMALLEST} to {LARGEST} pixels"
            )
        self.model = model
        self.width, self.height = width, height
        self._fit = _fit(model, width, height)
        self._moving = _after_still(model.display.items)
        self._margin = round(_BEYOND * max(size))
        self._backdrop = self._paint_backdrop()

    def render(self, vector: Vector) -> Image:
        """The picture, [height, width, 3] RGB, for weights of all channels of the model."""
        points, scalars = self.model.blend(vector)
        motion = self.model.motion(vector)
        canvas = self._moved_backdrop(motion)
        brush = _Brush(compose(self._fit, motion), points, scalars)
        brush.paint(self._moving, canvas, (0, 0, self.width, self.height))
        return canvas

    def _paint_backdrop(self) -> Image:
        display = self.model.display
        margin, fine = self._margin, _FINE
        height, width = ((side + 2 * margin) * fine for side in (self.height, self.width))
        canvas = _background(self.model, width, height, margin / (self.width + 2 * margin))
        split = 2 * display.points
        points = display.neutral[:split].reshape(-1, 2)
        larger = np.array([[fine, 0, fine * margin], [0, fine, fine * margin]], float)
        brush = _Brush(compose(larger, self._fit), points, display.neutral[split:])
        still = display.items[: len(display.items) - len(self._moving)]
        brush.paint(still, canvas, (0, 0, width, height))
        return canvas

    def _moved_backdrop(self, motion: Matrix) -> Image:
        """The backdrop as far as it is seen; pixel centers lie at half pixels."""
        back = _inverse(compose(self._fit, compose(motion, _inverse(self._fit))))
        half = np.array([[1, 0, 0.5], [0, 1, 0.5]])
        offset = _FINE * self._margin - 0.5
        larger = np.array([[_FINE, 0, offset], [0, _FINE, offset]], float)
        moved = cv2.warpAffine(
            self._backdrop,
            compose(larger, compose(back, half)),
            (self.width, self.height),
            flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
            borderMode=cv2.BORDER_REPLICATE,
        )
        return np.asarray(moved, np.uint8)


class _Brush:
    """Paints items of one blend under one transform."""

    def __init__(self, matrix: Matrix, points: Vector, scalars: Vector) -> None:
        self.points: Points = apply(matrix, points.astype(np.float64)).astype(np.float32)
        self.scalars = scalars
        self.scale = float(np.sqrt(abs(np.linalg.det(matrix[:, :2]))))

    def paint(self, items: Sequence[Item], canvas: Image, box: Box) -> None:
        """Paint on a canvas that shows this box of the picture."""
        for item in items:
            if isinstance(item, Opening):
                self._opening(item, canvas, box)
            else:
                self._shape(item, canvas, box)

    def _shape(self, shape: Shape, canvas: Image, box: Box) -> None:
        opacity = float(self.scalars[shape.opacity])
        if opacity < _FAINT:
            return
        covered = self._cover(shape, box)
        if covered is None:
            return
        mask, inner = covered
        anchors = self.points[shape.anchors[0] : shape.anchors[1]]
        mask, color = raster.shaded(shape.paint, anchors, min(opacity, 1.0), mask, inner)
        raster.paint(canvas, box[:2], mask, inner, color)

    def _opening(self, opening: Opening, canvas: Image, box: Box) -> None:
        covered = self._cover(opening.clip, box)
        if covered is None:
            return
        mask, inner = covered
        if not mask.any():
            return
        left, top = inner[0] - box[0], inner[1] - box[1]
        behind = canvas[top : top + mask.shape[0], left : left + mask.shape[1]]
        seen = behind.copy()
        self.paint(opening.content, seen, inner)
        raster.paint(canvas, box[:2], mask, inner, seen)

    def _cover(self, shape: Shape, box: Box) -> tuple[Mask, Box] | None:
        contours = [self.points[start:stop] for start, stop, _ in shape.contours]
        if not shape.is_stroke:
            inner = raster.box_of(contours, 0.5, box)
            return None if inner is None else (raster.filled(contours, inner), inner)
        width = self.scale * float(self.scalars[shape.opacity + 1])
        inner = raster.box_of(contours, width / 2 + 0.5, box)
        if inner is None or width <= 0:
            return None
        closed = [is_closed for *_, is_closed in shape.contours]
        return raster.stroked(contours, closed, width, inner), inner


def _fit(model: FaceModel, width: int, height: int) -> Matrix:
    """The whole drawing as large as the picture allows, in the middle."""
    display = model.display
    scale = min(width / display.width, height / display.height)
    x = (width - scale * display.width) / 2
    y = (height - scale * display.height) / 2
    return np.array([[scale, 0, x], [0, scale, y]])


def _after_still(items: tuple[Item, ...]) -> tuple[Item, ...]:
    """What is left of the display list behind the shapes at its start that never change."""
    for number, item in enumerate(items):
        if isinstance(item, Opening) or not item.is_still:
            return items[number:]
    return ()


def _inverse(matrix: Matrix) -> Matrix:
    linear = np.linalg.inv(matrix[:, :2])
    return np.column_stack([linear, -linear @ matrix[:, 2]])


def _background(model: FaceModel, width: int, height: int, margin: float) -> Image:
    """From the middle color to that of the corners, round."""
    middle, corners = (np.array(color, np.float32) for color in model.settings.background)
    x = np.linspace(-1, 1, width, dtype=np.float32)
    y = np.linspace(-1, 1, height, dtype=np.float32)
    reach = np.float32(1 - 2 * margin) * np.float32(np.sqrt(2))
    away = np.sqrt(np.add.outer(y * y, x * x)) / reach
    share = np.clip(away, 0, 1)[..., None]
    share = share * share * (3 - 2 * share)
    return np.asarray(np.rint(middle + (corners - middle) * share), np.uint8)
