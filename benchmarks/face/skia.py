"""The same display list, drawn by skia-python."""

from __future__ import annotations

import importlib
import time
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.bench.table import Row, amount, at_least, at_most
from hri.core.errors import NotAvailable
from hri.core.signals import Image
from hri.face.drawing.baking import Item, Shape, Vector
from hri.face.drawing.outline import apply, compose
from hri.face.drawing.paint import Gradient, Solid
from hri.face.model import FaceModel
from hri.face.renderers.painter import fit
from hri.face.renderers.renderer import Renderer

TIMES = 3.0
WARM = 5
"""Frames before those that count."""
DIFFERENCE = 0.7
"""Of 255, mean over all pixels."""


def rows(model: FaceModel, vectors: Sequence[Vector], size: tuple[int, int]) -> Iterator[Row]:
    """How many times faster ours is, frame by frame in turns, and how much the pictures differ.

    Raises NotAvailable without skia-python.
    """
    ours, theirs = Renderer(model, size), SkiaRenderer(model, size)
    for vector in vectors[:WARM]:
        ours.render(vector)
        theirs.render(vector)
    fast, slow, apart = [], [], []
    for vector in vectors[WARM:]:
        picture, own_s = timed(ours, vector)
        other_picture, other_s = timed(theirs, vector)
        fast.append(1e3 * own_s)
        slow.append(1e3 * other_s)
        apart.append(float(np.abs(picture.astype(int) - other_picture).mean()))
    own, other = float(np.median(fast)), float(np.median(slow))
    more = {"own_ms": round(own, 2), "skia_ms": round(other, 2), "skia": theirs.version}
    yield amount("times faster than skia-python", other / own, "", at_least(TIMES), **more)
    what = "difference from skia-python, mean"
    yield amount(what, float(np.mean(apart)), "of 255", at_most(DIFFERENCE))


def timed(renderer: Renderer | SkiaRenderer, vector: Vector) -> tuple[Image, float]:
    """A picture, and the seconds of the thread that it took."""
    begun = time.thread_time()
    picture = renderer.render(vector)
    return picture, time.thread_time() - begun


class SkiaRenderer:
    """Draws a face with the same vertices, gradients, clips and opacities as our renderer."""

    def __init__(self, model: FaceModel, size: tuple[int, int]) -> None:
        """Raises NotAvailable without skia-python."""
        try:
            self._skia: Any = importlib.import_module("skia")
        except ImportError as error:
            remedy = "pip install skia-python"
            raise NotAvailable(f"skia-python is not installed - {remedy}") from error
        self.version: str = self._skia.__version__
        self.model = model
        self._fit = fit(model.display, *size)
        self._pixels = np.zeros((size[1], size[0], 4), np.uint8)
        self._surface = self._skia.Surface(self._pixels)
        below = Renderer(model, size).background
        self._background = self._skia.Image.fromarray(
            np.dstack([below, np.full(below.shape[:2], 255, np.uint8)])
        )

    def render(self, vector: Vector) -> Image:
        """The picture, as `Renderer.render` gives it."""
        skia = self._skia
        points, scalars = self.model.placed(vector)
        matrix = compose(self._fit, self.model.motion(vector))
        self._points = apply(self._fit, points.astype(np.float64))
        self._scale = float(np.sqrt(abs(np.linalg.det(matrix[:, :2]))))
        self._scalars = scalars
        with self._surface as canvas:
            canvas.drawImage(self._background, 0, 0)
            for item in self.model.display.items:
                self._draw(canvas, item)
        self._surface.flushAndSubmit()
        picture: Image = self._pixels[..., _channels(skia)]
        return picture

    def _draw(self, canvas: Any, item: Item) -> None:
        if isinstance(item, Shape):
            self._shape(canvas, item)
            return
        canvas.save()
        canvas.clipPath(self._path(item.clip), doAntiAlias=True)
        for inner in item.content:
            self._draw(canvas, inner)
        canvas.restore()

    def _shape(self, canvas: Any, shape: Shape) -> None:
        opacity = min(float(self._scalars[shape.opacity]), 1.0)
        if opacity < 1 / 255:
            return
        skia = self._skia
        paint = skia.Paint(AntiAlias=True)
        if isinstance(shape.paint, Solid):
            paint.setColor4f(_color(skia, shape.paint.color, shape.paint.opacity * opacity))
        else:
            anchors = self._points[shape.anchors[0] : shape.anchors[1]]
            paint.setShader(self._shader(shape.paint, anchors))
            paint.setAlphaf(opacity)
        if shape.is_stroke:
            paint.setStyle(skia.Paint.kStroke_Style)
            paint.setStrokeWidth(self._scale * max(float(self._scalars[shape.opacity + 1]), 0.0))
            paint.setStrokeCap(skia.Paint.kRound_Cap)
            paint.setStrokeJoin(skia.Paint.kRound_Join)
        canvas.drawPath(self._path(shape), paint)

    def _path(self, shape: Shape) -> Any:
        path = self._skia.Path()
        for start, stop, is_closed in shape.contours:
            vertices = [self._skia.Point(x, y) for x, y in self._points[start:stop].tolist()]
            path.addPoly(vertices, is_closed)
        return path

    def _shader(self, gradient: Gradient, anchors: NDArray[np.float64]) -> Any:
        skia = self._skia
        colors = [int(_color(skia, stop.color, stop.opacity).toColor()) for stop in gradient.stops]
        offsets = [stop.offset for stop in gradient.stops]
        if not gradient.is_radial:
            ends = [skia.Point(x, y) for x, y in anchors.tolist()]
            return skia.GradientShader.MakeLinear(ends, colors, offsets)
        center, (ux, uy), (vx, vy) = anchors[0], anchors[1] - anchors[0], anchors[2] - anchors[0]
        place = skia.Matrix()
        place.setAll(ux, vx, center[0], uy, vy, center[1], 0, 0, 1)
        mode = skia.TileMode.kClamp
        return skia.GradientShader.MakeRadial((0, 0), 1, colors, offsets, mode, 0, place)


def _color(skia: Any, color: tuple[int, int, int], opacity: float) -> Any:
    return skia.Color4f(*(value / 255 for value in color), opacity)


def _channels(skia: Any) -> list[int]:
    """Where red, green and blue stand in what skia writes."""
    is_rgba = skia.kN32_ColorType == skia.kRGBA_8888_ColorType
    return [0, 1, 2] if is_rgba else [2, 1, 0]
