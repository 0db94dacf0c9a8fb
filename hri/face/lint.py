"""What loads, but is likely a slip: the findings of `hri face check`.

All is measured on the baked face, as it is drawn: which parts move, turn inside out, or leave the
picture when expressions and visemes meet.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import Place, did_you_mean
from hri.core.toml import Table, load_toml
from hri.face.drawing.baking import Item, Opening, Shape, pairs_of
from hri.face.drawing.outline import Points
from hri.face.drawing.paint import Gradient
from hri.face.drawing.svg import STROKE, Drawing, load_drawing
from hri.face.model import CORRECTED, LARGEST_WEIGHT, FaceModel
from hri.face.motion.gesture_tracks import load_gestures
from hri.face.settings import Timing
from hri.face.still import still_vector
from hri.face.vocabulary import ARKIT, CORRECTIVE, LABELS, PAIRED, SIDES, SINGLE, sides_of

Faces = NDArray[np.float32]
"""Shape [n, points, 2]: points of the face, n times."""

COLUMNS = 48
"""How many lines are laid across an opening to see where it is inside out."""
LEAST_FLIPPED = 6e-5
"""Share of the area of the drawing that may be inside out before anyone sees it."""
LEAST_MOVE = 0.2
"""Units; a target that moves nothing farther changes nothing."""
LARGEST_SLANT = 1.5
"""Units by which two sides may fail to mirror each other."""


@dataclass(frozen=True)
class Finding:
    """Something to look at, with its place."""

    place: Place
    what: str
    remedy: str
    is_slip: bool = True
    """False for what may well be wanted."""

    def __str__(self) -> str:
        kind = "warning" if self.is_slip else "note"
        return f"{self.place}: {kind}: {self.what} - {self.remedy}"


def findings(model: FaceModel, folder: Path) -> list[Finding]:
    """All findings about a face that loads; `folder` is where it was loaded from.

    Raises AuthoringError when it was changed and does not load any more.
    """
    inspection = _Inspection(model, folder)
    return [
        *inspection.missing(),
        *inspection.unused(),
        *inspection.without_effect(),
        *inspection.excessive(),
        *inspection.alike(),
        *inspection.patterns(),
        *inspection.inside_out(),
        *inspection.outside(),
        *inspection.unlike_sides(),
    ]


class _Inspection:
    def __init__(self, model: FaceModel, folder: Path) -> None:
        self.model = model
        self.folder = folder
        self.toml: Table = load_toml(folder / "face.toml", "face")
        self.neutral: Drawing = load_drawing(folder / "neutral.svg")
        self.size = np.array([model.display.width, model.display.height])

    def missing(self) -> Iterator[Finding]:
        """Expressions without a drawing, and timing left at the default."""
        missing = [label for label in LABELS if label not in self.model.expressions]
        if missing:
            what = f"{_listed(missing)} cannot be shown"
            yield self._in_toml("expressions", None, what, f"add [expressions.{missing[0]}] ...")
        if set(self.model.settings.timing.values()) == {Timing()}:
            what = "all expressions come and go alike"
            remedy = "add [timing], and [timing.surprised] for what is quick"
            yield Finding(Place(self.folder / "face.toml"), what, remedy, is_slip=False)

    def unused(self) -> Iterator[Finding]:
        """Targets that neither face.toml nor a gesture asks for."""
        settings = self.model.settings
        gaze, known = settings.gaze, (*ARKIT, *PAIRED, *SINGLE)
        asked = [*self.model.expressions.values(), *self.model.visemes.values(), settings.pupils]
        asked += [gaze.left, gaze.right, gaze.up, gaze.down, settings.blink.weights]
        used = {name for weights in asked for name in weights}
        for gesture in load_gestures(self.model).values():
            used |= set(gesture.weights)
        for target in self.model.targets:
            if CORRECTIVE in target or used & {target, *sides_of(target)} or target in known:
                continue
            own = "give it a weight, or delete it"
            near = did_you_mean(target, known, own)
            what = f"neither face.toml nor a gesture uses {target}"
            yield Finding(self._target(target), what, near, is_slip=near != own)

    def without_effect(self) -> Iterator[Finding]:
        """Targets that look like the neutral drawing."""
        display = self.model.display
        names = (*display.channels, *self.model.correctives)
        largest = dict(zip(names, np.abs(display.rows).max(axis=1, initial=0.0), strict=True))
        opacities = np.abs(display.rows[:, 2 * display.points :]).max(axis=1, initial=0.0)
        faded = dict(zip(names, opacities > 0.01, strict=True))
        for target in self.model.targets:
            for channel in _channels_of(target):
                if largest[channel] < LEAST_MOVE and not faded[channel]:
                    what = f"{channel} changes nothing"
                    yield Finding(self._target(target), what, "move its nodes, or delete it")

    def excessive(self) -> Iterator[Finding]:
        """Weights of a whole and a side that add up to more than is drawn."""
        for kind, entries in (
            ("expressions", self.model.expressions),
            ("visemes", self.model.visemes),
        ):
            for label, weights in entries.items():
                vector = self.model.vector(weights)
                for number in np.flatnonzero(np.abs(vector) > LARGEST_WEIGHT):
                    channel = self.model.channels[number]
                    what = f"{label}: {channel} adds up to {vector[number]:.2f}"
                    yield self._in_toml(kind, label, what, f"stay within {LARGEST_WEIGHT:g}")

    def alike(self) -> Iterator[Finding]:
        """Expressions that look the same."""
        seen: dict[bytes, str] = {}
        for label, weights in self.model.expressions.items():
            if label not in LABELS:
                continue  # An alias.
            twin = seen.setdefault(np.round(self.model.vector(weights), 2).tobytes(), label)
            if twin != label:
                what = f"{label} looks the same as {twin}"
                yield self._in_toml("expressions", label, what, "give it different weights")

    def patterns(self) -> Iterator[Finding]:
        """Patterns of the head and of layers that fit no part."""
        settings = self.model.settings
        head = () if settings.head is None else (*settings.head.still, *settings.head.depths)
        asked: list[tuple[str, str | None, str]] = [("head", None, pattern) for pattern in head]
        asked += [("layers", layer, pattern) for pattern, layer in settings.layers.patterns.items()]
        ids = [id.removesuffix(STROKE) for id in self.neutral.parts]
        for table, key, pattern in asked:
            if not any(fnmatchcase(id, pattern) for id in ids):
                what = f'"{pattern}" fits no part'
                remedy = did_you_mean(pattern.strip("*"), ids, "fix it, or delete it")
                yield self._in_toml(table, key, what, remedy)

    def inside_out(self) -> Iterator[Finding]:
        """Openings whose edges cross: lids, or lips, that go through each other."""
        least = LEAST_FLIPPED * self.size.prod()
        names, faces = self.meetings
        for opening in self._openings(self.model.display.items):
            edges, which = np.unique(_outline(opening.clip, faces), axis=0, return_inverse=True)
            turn = np.sign(sum(map(_signed_area, edges)))
            flipped = np.array([_flipped_area(edge, turn) for edge in edges])[which.ravel()]
            if flipped.max() > least:
                what = f'"{opening.clip.id}" is inside out at {names[int(flipped.argmax())]}'
                times = np.count_nonzero(flipped > least)
                if times > 1:
                    what += f" and {times - 1} more"
                remedy = "let its edges meet, but not cross, or draw a corrective"
                yield Finding(self._part(opening.clip.id), what, remedy)

    def outside(self) -> Iterator[Finding]:
        """Parts that lie inside of the drawing at rest, and leave it."""
        split = 2 * self.model.display.points
        rest = self.model.display.neutral[:split].reshape(1, -1, 2)
        names, faces = self.meetings
        for shape in self._shapes(self.model.display.items):
            if not self._leaves(_outline(shape, rest), 0.0).any():
                left = np.flatnonzero(self._leaves(_outline(shape, faces), 1.0))
                if len(left):
                    what = f'"{shape.id}" leaves the drawing at {names[left[0]]}'
                    yield Finding(self._part(shape.id), what, "move it less, or draw more room")

    def unlike_sides(self) -> Iterator[Finding]:
        """Parts of the left and the right that do not mirror each other."""
        parts = self.neutral.parts
        for id in parts:
            other = id.replace(SIDES[0], SIDES[1])
            if SIDES[0] not in id or STROKE in id:
                continue
            if other not in parts:
                what = f'"{id}" has no "{other}"'
                yield Finding(self._part(id), what, "draw it, if it should", is_slip=False)
                continue
            gap = _slant(parts[id].outline.points, parts[other].outline.points, self.size[0])
            if gap > LARGEST_SLANT:
                what = f'"{id}" and "{other}" do not mirror by {gap:.1f} units'
                remedy = "copy one and flip it, if they should"
                yield Finding(self._part(id), what, remedy, is_slip=False)

    @cached_property
    def meetings(self) -> tuple[list[str], Faces]:
        """The face at each expression, silent and with each viseme, and what that is called."""
        pairs = [
            (label, viseme)
            for label in self.model.expressions
            if label in LABELS
            for viseme in ("", *self.model.visemes)
        ]
        vectors = (
            still_vector(self.model, label, viseme=viseme or None) for label, viseme in pairs
        )
        faces = np.array([self.model.blend(vector)[0] for vector in vectors])
        return [f"{a} with {b}" if b else a for a, b in pairs], faces.round(2)

    def _leaves(self, faces: Faces, slack: float) -> NDArray[np.bool_]:
        """For each of them, whether a point lies farther out than the slack."""
        return np.asarray(((faces < -slack) | (faces > self.size + slack)).any(axis=(1, 2)))

    def _openings(self, items: tuple[Item, ...]) -> Iterator[Opening]:
        for item in items:
            if isinstance(item, Opening):
                yield item
                yield from self._openings(item.content)

    def _shapes(self, items: tuple[Item, ...]) -> Iterator[Shape]:
        """Shapes that are seen wherever they are: what is in an opening is cut off anyway."""
        return (item for item in items if isinstance(item, Shape) and not _is_glow(item))

    def _in_toml(self, table: str, key: str | None, what: str, remedy: str) -> Finding:
        return Finding(self.toml.table(table).place(key), what, remedy)

    def _target(self, name: str) -> Place:
        return Place(self.folder / "targets" / f"{name}.svg")

    def _part(self, id: str) -> Place:
        return self.neutral.parts[id].element.place


def _is_glow(shape: Shape) -> bool:
    """Whether it fades out to its edge, so that nobody sees where it ends."""
    return isinstance(shape.paint, Gradient) and shape.paint.stops[-1].opacity == 0


def _listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _channels_of(target: str) -> list[str]:
    """The rows that a drawing fills, as the model names them."""
    if CORRECTIVE not in target:
        return list(sides_of(target))
    return [CORRECTED.join(pair) for _, pair in pairs_of(target)]


def _slant(one: Points, other: Points, width: float) -> float:
    """How far two sides are from mirroring each other; a copy may be moved without a flip, as
    the light in both eyes is."""
    mirrored = other * [-1, 1] + [width, 0]
    corners = [(points.min(axis=0), points.max(axis=0)) for points in (one, mirrored)]
    (low, high), (other_low, other_high) = corners
    gap = max(np.abs(low - other_low).max(), np.abs(high - other_high).max())
    size = np.abs((high - low) - (other_high - other_low)).max()
    lift = abs(low[1] - other_low[1])
    return float(gap if size > LARGEST_SLANT else lift)


def _outline(shape: Shape, faces: Faces) -> Faces:
    first, last = shape.contours[0][0], shape.contours[-1][1]
    return faces[:, first:last]


def _signed_area(edge: NDArray[np.float32]) -> float:
    x, y = edge.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def _flipped_area(edge: NDArray[np.float32], turn: float) -> float:
    """The area that an edge runs around the wrong way, in square units.

    Lines are laid across it; along each, the winding number changes wherever it meets the edge.
    """
    ends = np.roll(edge, -1, axis=0)
    low, high = edge[:, 0].min(), edge[:, 0].max()
    step = (high - low) / COLUMNS
    across = (low + step * (np.arange(COLUMNS) + 0.5))[:, None]
    meets = (edge[:, 0] <= across) != (ends[:, 0] <= across)
    run = np.where(ends[:, 0] == edge[:, 0], 1.0, ends[:, 0] - edge[:, 0])
    heights = edge[:, 1] + (across - edge[:, 0]) / run * (ends[:, 1] - edge[:, 1])
    order = np.argsort(np.where(meets, heights, np.inf), axis=1)
    signs: NDArray[np.float64] = np.where(meets, np.sign(run), 0.0)
    winding = np.cumsum(np.take_along_axis(signs, order, axis=1), axis=1)[:, :-1]
    sorted_heights = np.take_along_axis(np.where(meets, heights, np.nan), order, axis=1)
    lengths = np.nan_to_num(np.diff(sorted_heights, axis=1))
    return float((lengths * (winding * turn < 0)).sum() * step)
