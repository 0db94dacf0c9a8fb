"""Paints a display list for weights: points are placed, lines become outlines, the kernel fills."""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from importlib import import_module
from typing import NamedTuple

import numpy as np

from hri.core.errors import HriError
from hri.face.drawing.baking import DisplayList, Item, Opening, Vector
from hri.face.drawing.outline import Matrix, apply, compose
from hri.face.layers import Layers
from hri.face.model import FaceModel
from hri.face.renderers.instructions import STEPS, Picture, Whole
from hri.face.renderers.program import lines, program_of, scratch_for
from hri.face.renderers.strokes import Points, Strokes
from hri.face.renderers.vectorized import paint_slowly

SMALLEST, LARGEST = 16, 4096
"""Pixels along a side of a picture."""
FARTHEST = 100_000
"""Pixels."""
UNCOMPILED = 8
"""Pictures of a process before the loops are compiled: to load the compiler takes as long as they
do, and to compile, once in an installation, ten times longer."""
_painted = itertools.count()


def load_compiler() -> None:
    """Draw with compiled loops from now on: for a robot that lives, and must not stand still when
    its ninth picture loads them.
    """
    global _painted
    import_module("hri.face.renderers.kernel")
    _painted = itertools.count(UNCOMPILED)


class Pen(NamedTuple):
    """A line along a shape as wide as pixels of the picture say, with the opacity of the shape."""

    scalar: int
    """Index of the opacity of the shape; the width of its line follows, 0 for a filled one."""
    added: float
    """Pixels, to that width."""
    least: float
    """Pixels of both together."""


class Painter:
    """Paints items of a model at one size, over what is on a canvas."""

    def __init__(
        self,
        model: FaceModel,
        items: Sequence[Item],
        size: tuple[int, int],
        pens: Sequence[Pen] = (),
    ) -> None:
        """`size` is width and height in pixels. Opacity and width of each pen stand behind the
        scalars of the model, where the items may use them.

        Raises HriError for one that is out of range, or a face with too deep clip paths.
        """
        width, height = size
        if not (SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
            raise HriError(
                f"a picture of {width}x{height} - give sides from {SMALLEST} to {LARGEST} pixels"
            )
        self._model = model
        self._scalars = np.array([pen.scalar for pen in pens], np.intp)
        self._added, self._least = np.array([pen[1:] for pen in pens], np.float32).reshape(-1, 2).T
        self._fit = fit(model.display, width, height)
        self._strokes = Strokes(lines(items))
        self._program = program_of(items, self._strokes)
        self._scratch = scratch_for(self._program, width, height)

    def paint(self, vector: Vector, canvas: Picture) -> None:
        """Paint for weights of all channels. Raises HriError for weights that are not finite."""
        if not np.isfinite(vector).all():
            raise HriError(f"weights of {self._model.name} are not numbers - give finite ones")
        points, scalars = self._model.placed(vector)
        linear = compose(self._fit, self._model.motion(vector))[:, :2]
        scale = math.sqrt(abs(np.linalg.det(linear)))
        points = apply(self._fit, points.astype(np.float64)).astype(np.float32)
        scalars = np.concatenate([scalars, self._pens(scalars, scale)])
        points = np.concatenate([self._strokes.outline(points, scalars, scale), points])
        vertices = _whole(points)
        if next(_painted) < UNCOMPILED:
            paint_slowly(self._program, vertices, scalars, canvas)
        else:
            from hri.face.renderers.kernel import paint  # loads the compiler

            paint(self._program, vertices, scalars, self._scratch, canvas)

    def _pens(self, scalars: Vector, scale: float) -> Vector:
        """Opacity and width of all pens, in units of the drawing."""
        per_pixel = np.float32(1 / max(scale, 1e-6))
        widths = scalars[self._scalars + 1] + self._added * per_pixel
        widths = np.maximum(widths, self._least * per_pixel)
        return np.column_stack([scalars[self._scalars], widths]).ravel()


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


def of_layers(items: Iterable[Item], layers: Layers, wanted: Collection[str]) -> Iterator[Item]:
    """The parts of a display list that are in the wanted layers, seen through their openings."""
    for item in items:
        if isinstance(item, Opening):
            if content := tuple(of_layers(item.content, layers, wanted)):
                yield Opening(item.clip, content)
        elif layers.of(item.id) in wanted:
            yield item
