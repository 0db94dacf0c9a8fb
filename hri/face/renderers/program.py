"""A display list as arrays, in the order of painting: what the compiled loops read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.face.drawing.baking import Item, Opening, Shape
from hri.face.drawing.paint import Gradient, Paint, Stop
from hri.face.renderers.instructions import (
    BLOCK,
    CLOSING,
    LINEAR,
    OPENING,
    RADIAL,
    SHADES,
    SOLID,
    Program,
    Scratch,
)
from hri.face.renderers.strokes import Strokes

DEEPEST = 8
"""Openings in openings."""

STEP = np.dtype(
    [
        ("kind", np.int64),
        ("first", np.int64),  # contour
        ("last", np.int64),  # the one after the last
        ("closing", np.int64),  # step that ends an opening
        ("anchor", np.int64),  # vertex; 0 for a plain color
        ("scalar", np.int64),  # opacity
        ("is_opaque", np.bool_),  # all shades are
        ("ramp", np.int64),  # row
    ]
)


def program_of(items: Sequence[Item], strokes: Strokes) -> Program:
    """The program of a display list, whose strokes stand before the points of the blend.

    Raises HriError when openings lie too deep in each other.
    """
    listed = list(_listed(items))
    steps = np.zeros(len(listed), STEP)
    contours: list[tuple[int, int]] = []
    ramps: list[NDArray[np.uint32]] = []
    openings: list[int] = []
    outlines = iter(strokes.contours)
    before = strokes.count
    for number, (kind, shape) in enumerate(listed):
        step = steps[number]
        step["kind"] = kind
        if kind == CLOSING:
            steps[openings.pop()]["closing"] = number
            continue
        if kind == OPENING:
            openings.append(number)
        step["first"] = len(contours)
        if shape.is_stroke:
            contours += next(outlines)
        else:
            contours += [(before + start, before + stop) for start, stop, _ in shape.contours]
        step["last"] = len(contours)
        step["scalar"] = shape.opacity
        if kind != OPENING:
            stops = _stops(shape.paint)
            step["is_opaque"] = all(stop.opacity >= 1 for stop in stops)
            step["ramp"] = len(ramps)
            ramps.append(_ramp(stops))
        if kind in (LINEAR, RADIAL):
            step["anchor"] = before + shape.anchors[0]
    return Program(
        steps, np.array(contours, np.int64), np.array(ramps, np.uint32).reshape(-1, SHADES)
    )


def lines(items: Sequence[Item]) -> list[Shape]:
    """The shapes of a display list that are strokes, in the order of painting."""
    return [shape for kind, shape in _listed(items) if shape.is_stroke and kind != CLOSING]


def _listed(items: Sequence[Item], depth: int = 0) -> Iterator[tuple[int, Shape]]:
    """Kinds of steps and shapes, an opening before and after what is in it."""
    if depth > DEEPEST:
        what = f"{depth} clip paths lie in each other"
        raise HriError(f"{what} - keep to {DEEPEST}")
    for item in items:
        if isinstance(item, Opening):
            yield OPENING, item.clip
            yield from _listed(item.content, depth + 1)
            yield CLOSING, item.clip
        elif isinstance(item.paint, Gradient):
            yield RADIAL if item.paint.is_radial else LINEAR, item
        else:
            yield SOLID, item


def _stops(paint: Paint) -> Sequence[Stop]:
    return paint.stops if isinstance(paint, Gradient) else (Stop(0.0, paint.color, paint.opacity),)


def _ramp(stops: Sequence[Stop]) -> NDArray[np.uint32]:
    at = (np.arange(SHADES) + 0.5) / SHADES
    offsets = [stop.offset for stop in stops]
    channels = np.array([(*stop.color, 255 * stop.opacity) for stop in stops]).T
    return packed(np.stack([np.interp(at, offsets, channel) for channel in channels], axis=-1))


def packed(colors: NDArray[np.floating]) -> NDArray[np.uint32]:
    """Channels, 0 to 255, of colors as one number each."""
    whole = np.rint(colors).astype(np.uint32)
    shifts = np.arange(0, 8 * whole.shape[-1], 8, dtype=np.uint32)
    return np.asarray((whole << shifts).sum(axis=-1), np.uint32)


def scratch_for(program: Program, width: int, height: int) -> Scratch:
    """Room to paint a program at a size in pixels."""
    kinds = program.steps["kind"]
    depth = int(np.cumsum((kinds == OPENING).astype(int) - (kinds == CLOSING)).max(initial=0))
    blocks = width // BLOCK + 1
    return Scratch(
        sums=np.zeros((height, width + 1), np.int32),
        touched=np.zeros((height, blocks), np.bool_),
        alphas=np.empty((height, width), np.uint8),
        spans=np.empty((height * blocks, 4), np.int32),
        shades=np.empty(width, np.uint32),
        masks=np.empty((depth, height, width), np.uint8),
        below=np.empty((depth, height, width), np.uint32),
    )
