"""Bakes drawings into one linear morph: a frame is one matrix product.

Vertices, gradient anchors, opacities and stroke widths of the whole display list stand in one
vector. Each channel has a row of differences, and so has each product of two channels that has its
own drawing (a corrective, after J. P. Lewis et al., "Pose Space Deformation", 2000): `vector =
neutral + [weights, products of weights] @ rows`. Curves are sampled here, once, since sampling is
linear in their handles.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError, did_you_mean
from hri.face.drawing.head_turn import PRODUCTS, depth_of, turned
from hri.face.drawing.light import with_light
from hri.face.drawing.outline import Contour, Outline, Points
from hri.face.drawing.paint import Gradient, Paint, Solid
from hri.face.drawing.svg import STROKE, Drawing, Group, Part
from hri.face.settings import HeadSettings
from hri.face.vocabulary import CORRECTIVE, SIDES, TURNS, sides_of

Vector = NDArray[np.float32]
Row = NDArray[np.float64]

FLATNESS = 0.1
"""Units of the drawing that the sampled line may run beside a curve."""
MOST_SAMPLES = 32
"""Of one curve."""
SEAM = 18.0
"""Half the width, in units, over which a drawing is split into left and right."""
MOST_NUMBERS = 12_000_000
"""The largest matrix; the built-in faces have less than a tenth of it."""
_UNSEEN = 1e-3
"""Units, or opacity: what an editor's rounding may change."""


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
    """The shapes, back to front, and how they morph."""

    width: float
    height: float
    items: tuple[Item, ...]
    channels: tuple[str, ...]
    products: tuple[tuple[str, str], ...]
    """Pairs of channels whose product has a row, behind those of the channels."""
    points: int
    """How many points lead the vector, x and y each; scalars follow."""
    neutral: Vector
    rows: Vector
    """Shape [channels + products, len(neutral)]."""


def bake(
    neutral: Drawing, targets: Mapping[str, Drawing], head: HeadSettings | None = None
) -> DisplayList:
    """Bake a neutral drawing and its targets by name, those of two at once too.

    Raises AuthoringError where a target does not fit the neutral drawing, HriError when all of
    them are too much.
    """
    if not neutral.parts:
        raise HriError(f"{neutral.path}: it draws nothing - draw a face")
    for target in targets.values():
        _check(neutral, target)
    baker = _Baker(neutral, targets)
    for name in targets:
        if CORRECTIVE not in name:
            baker.add_target(name)
    if head is not None:
        baker.add_turns(head)
    for name, drawing in targets.items():
        if CORRECTIVE in name:
            baker.add_corrective(name, drawing)
    return baker.display_list(neutral)


class _Baker:
    """Fills the rows of the matrix one after the other."""

    def __init__(self, neutral: Drawing, targets: Mapping[str, Drawing]) -> None:
        self.parts = {id: _Baked(part, targets) for id, part in neutral.parts.items()}
        self.order = {id: number for number, id in enumerate(self.parts)}
        self.starts: dict[str, int] = {}
        self.points = 0
        for id, part in self.parts.items():
            self.starts[id] = self.points
            self.points += len(part.neutral)
        self.length = 2 * (self.points + len(self.parts))
        if self.length * (2 * len(targets) + 5) > MOST_NUMBERS:
            what = f"{self.points} points in {len(targets)} targets are too much for a face"
            raise HriError(f"{neutral.path.parent}: {what} - simplify its paths")
        self.shares = {side: self._share(side, neutral.width / 2) for side in ("", *SIDES)}
        self.rows: dict[str, Row] = {}
        self.products: dict[tuple[str, str], Row] = {}

    def add_target(self, name: str) -> None:
        difference = self._difference(name)
        for channel in sides_of(name):
            self.rows[channel] = difference * self.shares[channel[len(name) :]]

    def add_turns(self, head: HeadSettings) -> None:
        rows: dict[str | tuple[str, str], Row] = {
            name: np.zeros(self.length) for name in (*TURNS, *PRODUCTS)
        }
        for id, part in self.parts.items():
            depth = depth_of(id.removesuffix(STROKE), head)
            if depth is not None:
                for name, move in turned(part.vertices, head, depth).items():
                    self._points(rows[name], id)[:] = part.lit(move)
        self.rows |= {name: rows[name] for name in TURNS}
        self.products |= {pair: rows[pair] for pair in PRODUCTS}

    def add_corrective(self, name: str, drawing: Drawing) -> None:
        """What is missing to this drawing where the two targets of its name add up."""
        first, second = name.split(CORRECTIVE)
        difference = self._difference(name)
        for id in drawing.parts:
            if id in self.parts:
                for channel in (*sides_of(first), *sides_of(second)):
                    self._points(difference, id)[:] -= self._points(self.rows[channel], id)
                    self._scalars(difference, id)[:] -= self._scalars(self.rows[channel], id)
        for side, pair in pairs_of(name):
            self.products[pair] = difference * self.shares[side]

    def display_list(self, neutral: Drawing) -> DisplayList:
        rows = np.array([*self.rows.values(), *self.products.values()], np.float32)
        rows = rows.reshape(-1, self.length)
        rows[np.abs(rows) < _UNSEEN] = 0
        vector = np.zeros(self.length)
        for id, part in self.parts.items():
            self._points(vector, id)[:] = part.neutral
            self._scalars(vector, id)[:] = part.scalars
        shapes = {id: self._shape(id, rows) for id in self.parts}
        return DisplayList(
            neutral.width,
            neutral.height,
            tuple(_item(item, shapes) for item in neutral.content),
            tuple(self.rows),
            tuple(self.products),
            self.points,
            vector.astype(np.float32),
            rows,
        )

    def _difference(self, name: str) -> Row:
        """How the drawing of a target differs from the neutral one."""
        row = np.zeros(self.length)
        for id, part in self.parts.items():
            if name in part.redrawn:
                self._points(row, id)[:] = part.delta(name)
                self._scalars(row, id)[:] = part.scalar_delta(name)
        return row

    def _share(self, side: str, middle: float) -> Row:
        """How much of each number belongs to a side; all of it when `side` is empty."""
        row = np.zeros(self.length)
        for id, part in self.parts.items():
            share = _share(part.neutral, side, middle)
            self._points(row, id)[:] = share[:, None]
            self._scalars(row, id)[:] = share.mean()
        return row

    def _points(self, row: Row, id: str) -> Row:
        """The points of a part in a row, [n, 2]."""
        start = self.starts[id]
        return row[2 * start : 2 * (start + len(self.parts[id].neutral))].reshape(-1, 2)

    def _scalars(self, row: Row, id: str) -> Row:
        """Opacity and stroke width of a part in a row."""
        start = self._scalar(id)
        return row[start : start + 2]

    def _scalar(self, id: str) -> int:
        return 2 * (self.points + self.order[id])

    def _shape(self, id: str, rows: Vector) -> Shape:
        part, start, scalar = self.parts[id], self.starts[id], self._scalar(id)
        end = start + len(part.neutral)
        moved = rows[:, 2 * start : 2 * end].any() or rows[:, scalar : scalar + 2].any()
        return part.shape(start, scalar - 2 * self.points, is_still=not moved)


def pairs_of(corrective: str) -> list[tuple[str, tuple[str, str]]]:
    """The channels that a drawing of two targets multiplies, each pair with the side it serves.

    Of two paired targets only the same sides meet: left with left, right with right.
    """
    one, other = (sides_of(name) for name in corrective.split(CORRECTIVE))
    if len(one) == len(other) == 1:
        return [("", (one[0], other[0]))]
    ones = one if len(one) == 2 else one * 2
    others = other if len(other) == 2 else other * 2
    return list(zip(SIDES, zip(ones, others, strict=True), strict=True))


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
        self._vertices = sum(
            sum(counts) + (not contour.is_closed)
            for contour, counts in zip(part.outline.contours, self.counts, strict=True)
        )
        self.neutral = self._points(part)
        self.scalars = (part.opacity, part.stroke_width)

    @property
    def vertices(self) -> Points:
        """Of the outline."""
        return self.neutral[: self._vertices]

    def lit(self, move: Points) -> Points:
        """How all points move when those of the outline want to move like that."""
        if isinstance(self.part.paint, Gradient) and not self.part.is_clip:
            return with_light(self.vertices, self.part.paint, move)
        return move

    def delta(self, name: str) -> NDArray[np.float64]:
        """How a target that redraws this part moves its points."""
        return self._points(self.redrawn[name]) - self.neutral

    def scalar_delta(self, name: str) -> tuple[float, float]:
        other = self.redrawn[name]
        return other.opacity - self.scalars[0], other.stroke_width - self.scalars[1]

    def _points(self, part: Part) -> NDArray[np.float64]:
        sampled = [
            _sampled(contour, counts)
            for contour, counts in zip(part.outline.contours, self.counts, strict=True)
        ]
        if isinstance(part.paint, Gradient) and not self.part.is_clip:
            sampled.append(part.paint.anchors)
        return np.concatenate(sampled)

    def shape(self, first: int, scalar: int, is_still: bool) -> Shape:
        contours, at = [], first
        for contour, counts in zip(self.part.outline.contours, self.counts, strict=True):
            stop = at + sum(counts) + (not contour.is_closed)
            contours.append((at, stop, contour.is_closed))
            at = stop
        return Shape(
            self.part.id,
            tuple(contours),
            self.part.paint,
            (at, first + len(self.neutral)),
            scalar,
            self.part.stroke_width > 0,
            is_still,
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
    if not base.is_clip and _look(part.paint) != _look(base.paint):
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
    """Samples for each curve, enough for all drawings; one for what is straight in all of them.

    Between samples a curve leaves its chord by no more than |B"| / (8 n n), and |B"| is 6 times
    the largest second difference of its four points.
    """
    curves = np.array([contour.curves for contour in contours])
    seconds = np.diff(curves, n=2, axis=2)
    bend = np.hypot(seconds[..., 0], seconds[..., 1]).max(axis=(0, 2))
    steps = np.diff(curves, axis=2)
    chord = curves[:, :, 3] - curves[:, :, 0]
    slack = np.abs(steps - chord[:, :, None] / 3).max(axis=(0, 2, 3))
    counts = np.clip(np.ceil(np.sqrt(0.75 * bend / FLATNESS)), 3, MOST_SAMPLES)
    return [int(count) for count in np.where(slack < 0.02, 1, counts)]


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
