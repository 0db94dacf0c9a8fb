"""Draws a face model: weights in, an RGB picture out."""

from __future__ import annotations

import math

import cv2
import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Image
from hri.face.drawing.baking import DisplayList, Vector
from hri.face.drawing.outline import Matrix, apply, compose
from hri.face.model import FaceModel
from hri.face.renderers.kernel import STEPS, Picture, Whole, paint
from hri.face.renderers.program import lines, packed, program_of, scratch_for
from hri.face.renderers.strokes import Points, Strokes

SMALLEST, LARGEST = 16, 4096
"""Pixels along a side of a picture."""
FARTHEST = 100_000
"""Pixels."""


class Renderer:
    """Draws one face at one size, one picture at a time; the same weights give the same bytes.

    The first picture of a new installation takes some seconds: the loops are compiled.
    """

    def __init__(self, model: FaceModel, size: tuple[int, int] = (640, 480)) -> None:
        """`size` is width and height in pixels.

        Raises HriError for one that is out of range, or a face with too deep clip paths.
        """
        width, height = size
        if not (SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
            raise HriError(
                f"a picture of {width}x{height} - give sides from {SMALLEST} to {LARGEST} pixels"
            )
        self.model = model
        self.width, self.height = width, height
        self._fit = fit(model.display, width, height)
        self._strokes = Strokes(lines(model.display.items))
        self._program = program_of(model.display.items, self._strokes)
        self._scratch = scratch_for(self._program, width, height)
        self._background = _background(model, width, height)
        self._canvas = np.empty_like(self._background)

    @property
    def background(self) -> Image:
        """What is behind the drawing."""
        return self._picture(self._background)

    def render(self, vector: Vector) -> Image:
        """The picture, [height, width, 3] RGB, for weights of all channels of the model.

        Raises HriError for weights that are not finite.
        """
        if not np.isfinite(vector).all():
            raise HriError(f"weights of {self.model.name} are not numbers - give finite ones")
        points, scalars = self.model.placed(vector)
        linear = compose(self._fit, self.model.motion(vector))[:, :2]
        scale = math.sqrt(abs(np.linalg.det(linear)))
        points = apply(self._fit, points.astype(np.float64)).astype(np.float32)
        points = np.concatenate([self._strokes.outline(points, scalars, scale), points])
        np.copyto(self._canvas, self._background)
        paint(self._program, _whole(points), scalars, self._scratch, self._canvas)
        return self._picture(self._canvas)

    def _picture(self, canvas: Picture) -> Image:
        channels = canvas.view(np.uint8).reshape(self.height, self.width, 4)
        return np.asarray(cv2.cvtColor(channels, cv2.COLOR_RGBA2RGB), np.uint8)


def _whole(points: Points) -> Whole:
    """Pixels in steps; what is farther away than any picture is large is moved there."""
    near = np.clip(points, -FARTHEST, FARTHEST)
    return np.rint(near * STEPS).astype(np.int32)


def fit(display: DisplayList, width: int, height: int) -> Matrix:
    """The whole drawing as large as the picture allows, in the middle."""
    scale = min(width / display.width, height / display.height)
    x = (width - scale * display.width) / 2
    y = (height - scale * display.height) / 2
    return np.array([[scale, 0, x], [0, scale, y]])


def _background(model: FaceModel, width: int, height: int) -> Picture:
    """From the middle color to that of the corners, round."""
    middle, corners = (np.array(color, np.float32) for color in model.settings.background)
    x, y = (
        np.linspace(-1, 1, side, dtype=np.float32) * np.float32(1 - 1 / side)
        for side in (width, height)
    )
    away = np.sqrt(np.add.outer(y * y, x * x)) / np.float32(np.sqrt(2))
    share = np.clip(away, 0, 1)[..., None]
    share = share * share * (3 - 2 * share)
    return packed(middle + (corners - middle) * share)
