"""What the compiled loops of `kernel` do, in numpy: ten times slower, but ready at once.

All numbers are the same, to the bit, and so are the pictures: edges are cut at the lines between
pixels in whole numbers, gradients are computed in single precision, colors are mixed in bytes.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hri.face.renderers.instructions import (
    BITS,
    CLOSING,
    FAINT,
    FULL,
    HALF,
    OPENING,
    RADIAL,
    SHADES,
    SHIFT,
    SOLID,
    STEPS,
    Box,
    Contours,
    Floats,
    Picture,
    Program,
    Whole,
)

Numbers = NDArray[np.int64]
Alphas = NDArray[np.uint32]
"""Coverage times opacity, 0 to 255, [height, width] of a box."""
_RED_BLUE, _ALPHA_GREEN = np.uint32(0x00FF00FF), np.uint32(0xFF00FF00)
_HALVES, _OPAQUE = np.uint32(0x00800080), np.uint32(0xFF000000)
_BYTE, _HALF_BYTE, _MOST = np.uint32(8), np.uint32(0x80), np.uint32(255)


class _Opened(NamedTuple):
    """An opening that is being painted in."""

    box: Box
    below: Picture
    """What was there before, of the box."""
    mask: Alphas


def paint_slowly(program: Program, vertices: Whole, scalars: Floats, canvas: Picture) -> None:
    """Paint a program on a canvas; `vertices` are in steps, [n, 2]."""
    steps, contours, ramps = program
    places = vertices.astype(np.int64)
    opened = [_Opened((0, 0, canvas.shape[1], canvas.shape[0]), canvas, np.empty(0, np.uint32))]
    number = 0
    while number < len(steps):
        step = steps[number]
        number += 1
        if step["kind"] == CLOSING:
            box, below, mask = opened.pop()
            inside = _part(canvas, box)
            inside[:] = _mixed(below, inside, mask)
            continue
        edges = _edges(places, contours[step["first"] : step["last"]])
        box = _box(edges, opened[-1].box)
        opacity = float(scalars[step["scalar"]])
        if not opacity >= FAINT or box[0] >= box[2] or box[1] >= box[3]:
            number = max(number, step["closing"] + 1)
            continue
        is_opening = step["kind"] == OPENING
        alphas = _covered(edges, box, 1.0 if is_opening else min(opacity, 1.0))
        inside = _part(canvas, box)
        if is_opening:
            opened.append(_Opened(box, inside.copy(), alphas))
            continue
        colors = ramps[step["ramp"]][_shades(step, vertices, box)]
        if not step["is_opaque"]:
            alphas = _share(alphas, colors >> np.uint32(24))
        inside[:] = _mixed(inside, colors | _OPAQUE, alphas)


def _part(canvas: Picture, box: Box) -> Picture:
    left, top, right, bottom = box
    return canvas[top:bottom, left:right]


# --- coverage ---


def _edges(vertices: Numbers, contours: Contours) -> Numbers:
    """Of closed contours, [4, n]: x and y of where each begins, and of where it ends."""
    ends = np.concatenate([vertices[first:last] for first, last in contours])
    begins = np.concatenate([np.roll(vertices[first:last], 1, axis=0) for first, last in contours])
    return np.concatenate([begins, ends], axis=1).T


def _box(edges: Numbers, limits: Box) -> Box:
    """Pixels within limits that edges touch; it may be empty."""
    (low_x, low_y), (high_x, high_y) = edges[2:].min(axis=1), edges[2:].max(axis=1) + STEPS - 1
    left, top, right, bottom = limits
    return (
        max(int(low_x) >> BITS, left),
        max(int(low_y) >> BITS, top),
        min(int(high_x) >> BITS, right),
        min(int(high_y) >> BITS, bottom),
    )


def _covered(edges: Numbers, box: Box, opacity: float) -> Alphas:
    left, top, right, bottom = box
    height, width = bottom - top, right - left
    sums = np.zeros((height, width + 1))
    for rows, columns, changes in _changes(_pieces(edges, box), left, right):
        at = (rows - top) * (width + 1) + columns - left
        sums += np.bincount(at, changes, sums.size).reshape(sums.shape)
    covered = np.minimum(np.abs(sums[:, :width].cumsum(axis=1).astype(np.int64)), FULL)
    strength = int(255 * opacity * FULL + 0.5)
    return np.asarray((covered * strength + HALF) >> SHIFT, np.uint32)


class _Pieces(NamedTuple):
    """Edges cut at the lines between rows, from their left ends."""

    row: Numbers
    way: Numbers
    """1 down, -1 up."""
    height: Numbers
    low: Numbers
    """Steps, x of the left end."""
    high: Numbers


def _pieces(edges: Numbers, box: Box) -> _Pieces:
    """Those of the edges in the rows of a box that do not lie right of it."""
    _, top, right, bottom = box
    x0, y0, x1, y1 = edges
    seen = (y0 != y1) & ((x0 >> BITS < right) | (x1 >> BITS < right))
    x0, y0, x1, y1 = edges[:, seen]
    is_down = y0 < y1
    upper_x, upper_y = np.where(is_down, x0, x1), np.where(is_down, y0, y1)
    lower_x, lower_y = np.where(is_down, x1, x0), np.where(is_down, y1, y0)
    slope = (x1 - x0) / (y1 - y0)
    begin, end = np.maximum(upper_y, top << BITS), np.minimum(lower_y, bottom << BITS)
    first = begin >> BITS
    counts = np.maximum(((end - 1) >> BITS) - first + 1, 0) * (begin < end)
    edge, row = _counted(first, counts)
    y = np.maximum(begin[edge], row << BITS)
    lower = np.minimum((row + 1) << BITS, end[edge])

    def x_at(height: Numbers) -> Numbers:
        run = (height - upper_y[edge]) * slope[edge] + 0.5
        return np.asarray(upper_x[edge] + run.astype(np.int64), np.int64)

    x, after = x_at(y), np.where(lower == lower_y[edge], lower_x[edge], x_at(lower))
    way = np.where(is_down, 1, -1)[edge]
    return _Pieces(row, way, lower - y, np.minimum(x, after), np.maximum(x, after))


def _changes(pieces: _Pieces, left: int, right: int) -> list[tuple[Any, Any, Any]]:
    """Rows, columns and changes of coverage there, along a row."""
    row, way, height, low, high = pieces
    at = np.maximum(low, left << BITS)
    beside = low < left << BITS
    before = np.where(beside, np.where(high > at, _height_at(at, pieces), height), 0)
    # What an edge left of the box covers is covered from the first column on.
    changes = [(row[beside], np.full(beside.sum(), left), (way * before * 2 * STEPS)[beside])]
    first = at >> BITS
    last = np.minimum(np.maximum((high - 1) >> BITS, first), right - 1)
    counts = np.where(before < height, np.maximum(last - first + 1, 0), 0)
    piece, column = _counted(first, counts)
    cut = _Pieces(*(each[piece] for each in pieces))
    is_first = column == first[piece]
    begin = np.where(is_first, at[piece], column << BITS)
    stop = np.minimum((column + 1) << BITS, cut.high)
    done = np.where(is_first, before[piece], _height_at(begin, cut))
    covered = np.where(stop < cut.high, _height_at(stop, cut), cut.height)
    turn = cut.way * (covered - done)
    rest = turn * (begin + stop - (column << (BITS + 1)))
    changes.append((cut.row, column, turn * 2 * STEPS - rest))
    changes.append((cut.row, column + 1, rest))
    return changes


def _height_at(x: Numbers, pieces: _Pieces) -> Numbers:
    """How much of the height of pieces lies left of x."""
    run = np.maximum(pieces.high - pieces.low, 1)
    return np.asarray(((x - pieces.low) * pieces.height / run + 0.5).astype(np.int64), np.int64)


def _counted(first: Numbers, counts: Numbers) -> tuple[Numbers, Numbers]:
    """As many numbers from each first one on, and whose they are."""
    owner = np.repeat(np.arange(len(counts)), counts)
    return owner, np.arange(len(owner)) - (np.cumsum(counts) - counts - first)[owner]


# --- colors ---


def _shades(step: Any, vertices: Whole, box: Box) -> Any:
    """Places in the ramp of a step, [height, width] of a box, or one for all of it."""
    if step["kind"] == SOLID:
        return 0
    a, b, c, d, e, f = _place(step, vertices)
    left, top, right, bottom = box
    x = np.arange(left, right, dtype=np.float32)
    y = np.arange(top, bottom, dtype=np.float32)[:, None]
    last = np.float32(SHADES - 1)
    at = a * x + (b * y + c)
    if step["kind"] == RADIAL:
        across = d * x + (e * y + f)
        at = np.sqrt(at * at + across * across)
    else:
        at = (at + np.abs(at)) * np.float32(0.5)
    return np.where(at < last, at, last).astype(np.int32)


def _place(step: Any, vertices: Whole) -> tuple[np.float32, ...]:
    """Where a gradient lies; see `kernel`."""
    corners = vertices[step["anchor"] : step["anchor"] + 3].astype(float).tolist()
    (x, y), (ux, uy) = corners[:2]
    ux, uy = ux - x, uy - y
    vx, vy = -uy, ux
    if step["kind"] == RADIAL:
        vx, vy = corners[2][0] - x, corners[2][1] - y
    area = ux * vy - uy * vx
    size = SHADES / (area if abs(area) >= 1 else 1.0)
    a, b, d, e = vy * size, -vx * size, -uy * size, ux * size
    x, y = STEPS / 2 - x, STEPS / 2 - y
    numbers = a * STEPS, b * STEPS, a * x + b * y, d * STEPS, e * STEPS, d * x + e * y
    return tuple(map(np.float32, numbers))


def _mixed(below: Picture, above: Picture, alpha: Alphas) -> Picture:
    """A color over another one, rounded, each byte for itself."""
    rest = _MOST - alpha
    both = (below & _RED_BLUE) * rest + (above & _RED_BLUE) * alpha + _HALVES
    both += (both >> _BYTE) & _RED_BLUE
    others = ((below >> _BYTE) & _RED_BLUE) * rest + ((above >> _BYTE) & _RED_BLUE) * alpha
    others += _HALVES
    others += (others >> _BYTE) & _RED_BLUE
    return np.asarray(((both >> _BYTE) & _RED_BLUE) | (others & _ALPHA_GREEN), np.uint32)


def _share(alpha: Alphas, other: Alphas) -> Alphas:
    """The product of two fractions of 255, rounded."""
    product = alpha * other + _HALF_BYTE
    return np.asarray((product + (product >> _BYTE)) >> _BYTE, np.uint32)
