"""Lines of a width as polygons to fill, with round ends and rounded corners.

The pen is a circle: it covers the area swept by a radius that stands across the line and turns at
each corner. The polygons have the same vertices, in number, however the lines bend.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hri.face.drawing.baking import Shape, Vector

Points = NDArray[np.float32]
"""Shape [n, 2], pixels."""

_CORNER = 3
"""Points of each side at a vertex: across the segment before, between, across the one after."""
_CAP = 7
"""Points of a round end between its two sides."""
_ANGLES = np.arange(1, _CAP + 1) * np.pi / (_CAP + 1)
_ACROSS = np.cos(_ANGLES).astype(np.float32)[:, None]
_ALONG = np.sin(_ANGLES).astype(np.float32)[:, None]

Indexes = NDArray[np.intp]


class Strokes:
    """All lines of a display list at once."""

    def __init__(self, shapes: Sequence[Shape]) -> None:
        self.contours: list[list[tuple[int, int]]] = [[] for _ in shapes]
        """Of each shape: first vertex, and the one after the last, of what `outline` gives."""
        lines = [
            (number, shape.opacity + 1, *contour)
            for number, shape in enumerate(shapes)
            for contour in shape.contours
        ]
        ranges = [np.arange(start, stop) for _, _, start, stop, _ in lines]
        counts = [len(around) for around in ranges]
        self._vertices = _joined(ranges)
        self._widths = _joined([np.full(n, line[1]) for n, line in zip(counts, lines, strict=True)])
        first = np.cumsum([0, *counts])
        total, ends, order = int(first[-1]), list[tuple[int, int]](), list[Indexes]()
        self.count = 0
        """Vertices of all outlines."""
        after, before = np.arange(1, total + 1), np.arange(-1, total - 1)
        for begin, count, (number, *_, is_closed) in zip(first, counts, lines, strict=False):
            last = int(begin) + count - 1
            after[last], before[begin] = (begin, last) if is_closed else (last, begin)
            left = np.arange(_CORNER * begin, _CORNER * (last + 1))
            right = left[::-1] + _CORNER * total
            loops = [left, right]
            if not is_closed:
                caps = 2 * _CORNER * total + _CAP * len(ends) + np.arange(2 * _CAP)
                loops = [np.concatenate([left, caps[:_CAP], right, caps[_CAP:]])]
                ends += [(last, 1), (int(begin), -1)]
            order += loops
            for loop in loops:
                self.contours[number].append((self.count, self.count + len(loop)))
                self.count += len(loop)
        self._after, self._before, self._order = after, before, _joined(order)
        self._ends = np.array([at for at, _ in ends], np.intp)
        self._ways = np.array([way for _, way in ends], np.float32)[:, None]

    def outline(self, points: Points, scalars: Vector, scale: float) -> Points:
        """Vertices of all outlines, for the vertices of all lines and their widths."""
        line = points[self._vertices]
        along = _unit(line[self._after] - line)
        behind = _unit(line - line[self._before])
        # At the ends of an open line nothing follows or nothing came.
        along = np.where(along.any(axis=1, keepdims=True), along, behind)
        behind = np.where(behind.any(axis=1, keepdims=True), behind, along)
        ways = np.stack([behind, _unit(behind + along), along], axis=1)
        half = np.maximum(scalars[self._widths], 0) * np.float32(scale / 2)
        ways *= half[:, None, None]
        radii = np.stack([ways[..., 1], -ways[..., 0]], axis=-1)
        left, right = line[:, None] + radii, line[:, None] - radii
        way, radius = ways[self._ends, 1] * self._ways, radii[self._ends, 1] * self._ways
        caps = line[self._ends, None] + _ACROSS * radius[:, None] + _ALONG * way[:, None]
        parts = [part.reshape(-1, 2) for part in (left, right, caps)]
        return np.concatenate(parts)[self._order]


def _joined(parts: Sequence[Indexes]) -> Indexes:
    """All parts behind each other, even when there are none."""
    return np.concatenate([np.empty(0, np.intp), *parts])


def _unit(vectors: Points) -> Points:
    lengths = np.hypot(vectors[:, :1], vectors[:, 1:])
    return np.asarray(vectors / np.maximum(lengths, 1e-6), np.float32)
