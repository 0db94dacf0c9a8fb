"""Bakes drawings into one linear morph: a frame is one matrix product.

Vertices, gradient anchors, opacities and stroke widths of the whole display list stand in one
vector. Each channel has a row of differences: `vector = neutral + weights @ rows`. Curves are
sampled here, once, since sampling is linear in their handles.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import did_you_mean
from hri.face.drawing import Drawing, Group, Part
from hri.face.outline import Contour, Outline
from hri.face.paint import Gradient, Paint, Solid
from hri.face.vocabulary import SIDES, sides_of

Vector = NDArray[np.float32]

SAMPLE_LENGTH = 6.0
"""A curve gets a vertex for each of so many units of the drawing."""
SEAM = 18.0
"""Half the width, in units, over which a drawing is split into left and right."""


@dataclass(frozen=True)
class Shape:
    """One shape of the display list: where its numbers stand in the vector."""

    id: str
    contours: tuple[tuple[int, int, bool], ...]
    """First vertex, the one after the last, whether closed."""
    paint: Paint
    anchors: tuple[int, int]
    """First gradient anchor and the one after the last; equal for a plain color."""
    opacity: int
    """Index among the scalars; the stroke's width follows."""
    is_stroke: bool
    is_still: bool
    """No channel changes it."""


@dataclass(frozen=True)
class Opening:
    """Shapes seen through an opening."""

    clip: Shape
    content: tuple[Item, ...]


Item = Shape | Opening


@dataclass(frozen=True)
class DisplayList:
    """What is drawn, back to front, and how it morphs."""

    width: float
    height: float
    items: tuple[Item, ...]
    channels: tuple[str, ...]
    points: int
    """How many points lead the vector, x and y each; scalars follow."""
    neutral: Vector
    rows: Vector
    """Shape [channels, len(neutral)]."""


def bake(neutral: Drawing, targets: Mapping[str, Drawing]) -> DisplayList:
    """Bake a neutral drawing and its targets by name.

    Raises AuthoringError where a target does not fit the neutral drawing.
    """
    for target in targets.values():
        _check(neutral, target)
    baked = {id: _Baked(part, targets) for id, part in neutral.parts.items()}
    offsets, points = {}, 0
    for id, part in baked.items():
        offsets[id] = points
        points += len(part.neutral)
    index = {id: number for number, id in enumerate(baked)}
    channels = tuple(channel for name in targets for channel in sides_of(name))
    vector = _stack(baked, points)
    rows = np.zeros((len(channels), len(vector)), np.float32)
    row = 0
    for name in targets:
        for side in sides_of(name):
            _fill(rows[row], baked, offsets, points, name, side[len(name) :], neutral.width / 2)
            row += 1
    shapes = {
        id: part.shape(offsets[id], 2 * index[id], rows, points) for id, part in baked.items()
    }
    items = tuple(_item(item, shapes) for item in neutral.content)
    return DisplayList(neutral.width, neutral.height, items, channels, points, vector, rows)


class _Baked:
    """One part: its sampled points in the neutral drawing and how targets move them."""

    def __init__(self, part: Part, targets: Mapping[str, Drawing]) -> None:
        self.part = part
        self.redrawn = {
            name: drawing.parts[part.id]
            for name, drawing in targets.items()
            if part.id in drawing.parts
        }
        outlines = [part.outline, *(other.outline for other in self.redrawn.values())]
        self.counts = [
            _sample_counts([outline.contours[k] for outline in outlines])
            for k in range(len(part.outline.contours))
        ]
        self.neutral = self._points(part)
        self.scalars = (part.opacity, part.stroke_width)

    def delta(self, name: str) -> NDArray[np.float64] | None:
        """How a target moves the points; None when it leaves this part alone."""
        other = self.redrawn.get(name)
        return None if other is None else self._points(other) - self.neutral

    def scalar_delta(self, name: str) -> tuple[float, float]:
        other = self.redrawn.get(name)
        if other is None:
            return 0.0, 0.0
        return other.opacity - self.scalars[0], other.stroke_width - self.scalars[1]

    def _points(self, part: Part) -> NDArray[np.float64]:
        sampled = [
            _sampled(contour, counts)
            for contour, counts in zip(part.outline.contours, self.counts, strict=True)
        ]
        if isinstance(part.paint, Gradient):
            sampled.append(part.paint.anchors)
        return np.concatenate(sampled)

    def shape(self, first: int, scalar: int, rows: Vector, points: int) -> Shape:
        contours, at = [], first
        for contour, counts in zip(self.part.outline.contours, self.counts, strict=True):
            stop = at + sum(counts) + (not contour.is_closed)
            contours.append((at, stop, contour.is_closed))
            at = stop
        end = first + len(self.neutral)
        moved = rows[:, 2 * first : 2 * end].any() or rows[:, 2 * points + scalar :][:, :2].any()
        return Shape(
            self.part.id,
            tuple(contours),
            self.part.paint,
            (at, end),
            scalar,
            self.part.stroke_width > 0,
            not moved,
        )


def _check(neutral: Drawing, target: Drawing) -> None:
    if (target.width, target.height) != (neutral.width, neutral.height):
        first = next(iter(target.parts.values()), None)
        if first is not None:
            what = f"the viewBox differs from that of {neutral.path.name}"
            raise first.element.error(what, f"make it 0 0 {neutral.width:g} {neutral.height:g}")
    for id, part in target.parts.items():
        if id not in neutral.parts:
            remedy = did_you_mean(id, neutral.parts, f"draw it in {neutral.path.name} too")
            raise part.element.error(f'{neutral.path.name} has no part "{id}"', remedy, "id")
        _check_part(neutral.parts[id], part, neutral.path.name)


def _check_part(base: Part, part: Part, file: str) -> None:
    if part.outline.structure != base.outline.structure:
        here, there = _count(part.outline), _count(base.outline)
        what = f'"{part.id}" has {here} here, but {there} in {file}'
        remedy = f"copy it from {file} and move its nodes, adding and deleting none"
        raise part.element.error(what, remedy, "d")
    if _look(part.paint) != _look(base.paint):
        what = f'"{part.id}" has another color or gradient than in {file}'
        remedy = "colors do not morph: give it the same, or fade a second part in with opacity"
        raise part.element.error(what, remedy, "fill")


def _count(outline: Outline) -> str:
    contours = outline.contours
    kinds = "closed" if all(contour.is_closed for contour in contours) else "open"
    if len(contours) > 1:
        return f"{outline.nodes} nodes in {len(contours)} contours"
    return f"{outline.nodes} nodes ({kinds})"


def _look(paint: Paint) -> object:
    if isinstance(paint, Solid):
        return paint
    return paint.is_radial, paint.stops


def _sample_counts(contours: list[Contour]) -> list[int]:
    """Samples for each curve: one for a straight line, else by the longest of all drawings."""
    curves = np.array([contour.curves for contour in contours])
    steps = np.diff(curves, axis=2)
    lengths = np.hypot(steps[..., 0], steps[..., 1]).sum(axis=2).max(axis=0)
    chord = curves[:, :, 3] - curves[:, :, 0]
    bend = np.abs(steps - chord[:, :, None] / 3).max(axis=(0, 2, 3))
    return [
        1 if flat < 0.02 else min(max(math.ceil(length / SAMPLE_LENGTH), 3), 16)
        for flat, length in zip(bend, lengths, strict=True)
    ]


def _sampled(contour: Contour, counts: list[int]) -> NDArray[np.float64]:
    parts = []
    for curve, count in zip(contour.curves, counts, strict=True):
        t = np.arange(count)[:, None] / count
        s = 1 - t
        parts.append(
            s**3 * curve[0] + 3 * s * s * t * curve[1] + 3 * s * t * t * curve[2] + t**3 * curve[3]
        )
    if not contour.is_closed:
        parts.append(contour.curves[-1, 3:])
    return np.concatenate(parts)


def _stack(baked: Mapping[str, _Baked], points: int) -> Vector:
    vector = np.empty(2 * points + 2 * len(baked), np.float32)
    vector[: 2 * points] = np.concatenate([part.neutral for part in baked.values()]).ravel()
    vector[2 * points :] = np.concatenate([part.scalars for part in baked.values()])
    return vector


def _fill(
    row: Vector,
    baked: Mapping[str, _Baked],
    offsets: Mapping[str, int],
    points: int,
    name: str,
    side: str,
    middle: float,
) -> None:
    """Write what a target does on one side of the face, or on the whole when `side` is empty."""
    for number, (id, part) in enumerate(baked.items()):
        delta = part.delta(name)
        if delta is None:
            continue
        share = _share(part.neutral, side, middle)
        start = 2 * offsets[id]
        row[start : start + delta.size] = (delta * share[:, None]).ravel()
        scalars = 2 * points + 2 * number
        row[scalars : scalars + 2] = np.array(part.scalar_delta(name)) * share.mean()


def _share(points: NDArray[np.float64], side: str, middle: float) -> NDArray[np.float64]:
    """How much of each point belongs to a side: 0 to 1, smooth over the seam."""
    if not side:
        return np.ones(len(points))
    across = np.clip(0.5 + (points[:, 0] - middle) / (2 * SEAM), 0.0, 1.0)
    smooth = across * across * (3 - 2 * across)
    return smooth if side == SIDES[0] else 1 - smooth


def _item(item: Part | Group, shapes: Mapping[str, Shape]) -> Item:
    if isinstance(item, Part):
        return shapes[item.id]
    content = tuple(_item(child, shapes) for child in item.content)
    return Opening(shapes[item.clip.id], content)
