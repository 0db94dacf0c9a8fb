"""A face, loaded: its display list, its vocabulary, and the blend of both."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.face.drawing.baking import DisplayList, Item, Opening, Shape, Vector, pairs_of
from hri.face.drawing.blending import Blend
from hri.face.drawing.cache import baked
from hri.face.drawing.outline import Matrix
from hri.face.settings import Settings, Weights, load_settings
from hri.face.vocabulary import CORRECTIVE, MOTIONS, RHUBARB, TURNS, VISEMES, sides_of

MOST_TARGETS = 300
LARGEST_FILE = 600_000
"""Bytes; 10,000 nodes fit in."""
LARGEST_FACE = 4_000_000
"""Bytes of all files of a face together."""
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,60}(\+[A-Za-z0-9_+]{0,60})?")
CORRECTED = "*"
"""Stands in the name of the product of two channels."""
LARGEST_WEIGHT = 1.5
"""Weights beyond are cut off: no drawing survives them."""


class FaceModel:
    """A face that can take any expression; immutable."""

    def __init__(
        self, folder: Path, display: DisplayList, settings: Settings, targets: tuple[str, ...]
    ) -> None:
        self.folder = folder
        """Where it was loaded from."""
        self.name = folder.name
        self.display = display
        self.settings = settings
        self.targets = targets
        """Names of the drawings."""
        self.channels = (*display.channels, *MOTIONS)
        """What can be weighted, one number each: sides of targets and motions of the head."""
        self.correctives = tuple(CORRECTED.join(pair) for pair in display.products)
        """Products of two channels that have a drawing, such as "mouthSmileLeft*jawOpen"."""
        self.index = {channel: number for number, channel in enumerate(self.channels)}
        """The place of each channel among them."""
        self._blend = Blend(display.neutral, display.rows)
        pairs = [[self.index[name] for name in pair] for pair in display.products]
        self._factors = np.array(pairs, np.intp).reshape(-1, 2).T
        self._largest = np.array([_most(name) for name in display.channels], np.float32)
        turned = np.array([pair[0] in TURNS for pair in display.products], bool)
        self._least_factor = np.where(turned, -1, 0).astype(np.float32)
        neck = settings.motion.neck
        self._following = None if neck is None else following(display, *neck)[:, None]

    @property
    def expressions(self) -> Mapping[str, Weights]:
        """Weights by label, aliases too."""
        return self.settings.expressions

    @property
    def visemes(self) -> Mapping[str, Weights]:
        """Weights by Oculus name."""
        return self.settings.visemes

    @cached_property
    def names(self) -> frozenset[str]:
        """Every name that may be weighted: channels and whole targets."""
        drawn = (target for target in self.targets if CORRECTIVE not in target)
        return frozenset((*self.channels, *drawn))

    def expression(self, label: str) -> Weights:
        """The weights of an expression. Raises HriError for an unknown label."""
        if label not in self.expressions:
            remedy = did_you_mean(label, self.expressions)
            raise HriError(f'the face {self.name} has no expression "{label}" - {remedy}')
        return self.expressions[label]

    def viseme(self, name: str) -> Weights:
        """The weights of a viseme, by its name or by Rhubarb's. Raises HriError for another."""
        known = name if name in self.visemes else RHUBARB.get(name, name)
        if known not in self.visemes:
            raise HriError(f'no viseme "{name}" - {did_you_mean(name, VISEMES)}')
        return self.visemes[known]

    def vector(self, weights: Weights) -> Vector:
        """Weights as one number for each channel; the name of a whole target feeds both sides.

        Raises HriError for an unknown name or a weight that is not finite.
        """
        vector = np.zeros(len(self.channels), np.float32)
        for name, weight in weights.items():
            if not math.isfinite(weight):
                raise HriError(f"the weight of {name} is {weight} - give a finite number")
            for channel in (name,) if name in self.index else self._sides(name):
                vector[self.index[channel]] += weight
        return vector

    def _sides(self, name: str) -> tuple[str, ...]:
        if name not in self.names:
            remedy = did_you_mean(name, self.names)
            raise HriError(f'the face {self.name} has no target "{name}" - {remedy}')
        return sides_of(name)

    def weights(self, vector: NDArray[np.floating]) -> dict[str, float]:
        """Channels by name, those at rest left out."""
        return {
            channel: float(value)
            for channel, value in zip(self.channels, vector, strict=True)
            if abs(value) > 1e-4
        }

    def blend(self, vector: Vector) -> tuple[Vector, Vector]:
        """Points [n, 2] in units of the drawing, and scalars, for weights of all channels."""
        weights = np.empty(len(self.display.rows), np.float32)
        alone = weights[: len(self._largest)]
        np.minimum(vector[: len(alone)], self._largest, out=alone)
        np.maximum(alone, -self._largest, out=alone)
        # A corrective is drawn for weights from 0 to 1 and must not grow beyond.
        factors = np.minimum(alone, 1).take(self._factors)
        np.maximum(factors, self._least_factor, out=factors)
        np.multiply(factors[0], factors[1], out=weights[len(alone) :])
        blended = self._blend(weights)
        split = 2 * self.display.points
        return blended[:split].reshape(-1, 2), blended[split:]

    def placed(self, vector: Vector) -> tuple[Vector, Vector]:
        """The same, moved with the head: what is drawn, and where."""
        points, scalars = self.blend(vector)
        matrix = self.motion(vector).astype(np.float32)
        moved = points @ matrix[:, :2].T + matrix[:, 2]
        if self._following is not None:
            moved = points + self._following * (moved - points)
        return moved, scalars

    def motion(self, vector: Vector) -> Matrix:
        """How the head as a whole moves, in units of the drawing."""
        motion = self.settings.motion
        x, y, roll, size = (float(value) for value in np.clip(vector[-len(MOTIONS) :], -3, 3))
        angle = math.radians(motion.roll * roll)
        scale = 1 + motion.size * size
        linear = scale * np.array(
            [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
        )
        pivot = np.array(motion.pivot)
        shift = pivot + motion.shift * np.array([x, y]) - linear @ pivot
        return np.column_stack([linear, shift])


def _most(channel: str) -> float:
    """How far a channel goes: a head to its limits, and lids that are shut do not cross."""
    return 1.0 if channel in TURNS or channel.startswith("eyeBlink") else LARGEST_WEIGHT


def following(display: DisplayList, top: float, bottom: float) -> Vector:
    """How much each point [n] goes with the head, 0 to 1, by its height in the drawing at rest.

    `top` and `bottom` are the heights between which that falls from 1 to 0, smoothly. Anchors of a
    gradient count as within the height of their shape, so that light stays where it is drawn.
    """
    heights = display.neutral[1 : 2 * display.points : 2].copy()
    for shape in _shapes(display.items):
        first, last = shape.contours[0][0], shape.anchors[0]
        outline = heights[first:last]
        anchors = heights[last : shape.anchors[1]]
        np.clip(anchors, outline.min(), outline.max(), out=anchors)
    share = np.clip((bottom - heights) / (bottom - top), 0, 1)
    return np.asarray(share * share * (3 - 2 * share), np.float32)


def _shapes(items: Sequence[Item]) -> Iterator[Shape]:
    for item in items:
        if isinstance(item, Opening):
            yield item.clip
            yield from _shapes(item.content)
        else:
            yield item


def load_face(name: str | Path = "robot") -> FaceModel:
    """A face by its name in `faces/`, or by the path of its folder.

    Raises AuthoringError with the place of what is wrong, HriError when there is no such face.
    """
    folder = Path(name) if isinstance(name, Path) else paths.find("faces", name)
    if not (folder / "face.toml").is_file():
        raise HriError(f"{folder} is not a face - it needs face.toml, neutral.svg and targets/")
    return _load(folder.resolve(), stamps_of(folder))


Stamps = tuple[tuple[Path, int, int], ...]


def stamps_of(folder: Path) -> Stamps:
    """The files of a face with time and size, which differ when one was saved.

    Raises HriError when there are too many, they are too large or one cannot be looked at.
    """
    targets = sorted((folder / "targets").glob("*.svg"))
    if len(targets) > MOST_TARGETS:
        raise HriError(f"{folder}/targets has {len(targets)} drawings - keep to {MOST_TARGETS}")
    files = (folder / "face.toml", folder / "neutral.svg", *targets)
    stamps = tuple((file, *_stamp(file)) for file in files)
    for file, _, size in stamps:
        if size > LARGEST_FILE:
            raise HriError(f"{file}: {size:,} bytes are too much for a drawing - {_SMALLER}")
    total = sum(size for *_, size in stamps)
    if total > LARGEST_FACE:
        raise HriError(f"{folder}: {total:,} bytes are too much for a face - {_SMALLER}")
    return stamps


_SMALLER = "save plain SVG, with fewer nodes, and only what changes in targets/"


def _stamp(file: Path) -> tuple[int, int]:
    try:
        status = file.stat()
    except OSError as error:
        reason = error.strerror or str(error)
        raise HriError(f"{file}: cannot read this drawing: {reason} - add it") from error
    return status.st_mtime_ns, status.st_size


@lru_cache(maxsize=4)
def _load(folder: Path, stamps: Stamps) -> FaceModel:
    """Read a face; `stamps` make a changed face a new one."""
    _, neutral, *targets = (file for file, *_ in stamps)
    names = _names(targets)
    settings = load_settings(folder / "face.toml", names)
    display = baked(neutral, targets, settings.head)
    return FaceModel(folder, display, settings, tuple(file.stem for file in targets))


def _names(targets: Sequence[Path]) -> set[str]:
    """Names that the drawings give weights to. Raises HriError for an unusable drawing."""
    names: dict[str, Path] = {}
    for file in targets:
        if not _NAME.fullmatch(file.stem):
            what = f"{file.stem!r} is not a valid target name"
            raise HriError(f"{file.parent}: {what} - use letters, digits and _, as in jawOpen.svg")
        if CORRECTIVE in file.stem:
            continue
        for channel in sides_of(file.stem):
            if channel in names:
                what = f"{channel} is drawn by {names[channel].name} already"
                raise HriError(f"{file}: {what} - delete one of them")
            if channel in (*MOTIONS, *TURNS):
                what = f"{channel} is a motion of the whole head"
                raise HriError(f"{file}: {what} - set it up in face.toml, [motion] and [head]")
            names[channel] = file
    known = set(names) | {file.stem for file in targets if CORRECTIVE not in file.stem}
    corrected: dict[frozenset[str], Path] = {}
    for file in targets:
        if CORRECTIVE in file.stem:
            _check_corrective(file, known)
            for _, pair in pairs_of(file.stem):
                other = corrected.setdefault(frozenset(pair), file)
                if other != file:
                    what = f"{CORRECTED.join(pair)} is drawn by {other.name} already"
                    raise HriError(f"{file}: {what} - delete one of them")
    return known


def _check_corrective(file: Path, known: Collection[str]) -> None:
    parts = file.stem.split(CORRECTIVE)
    if len(parts) != 2 or parts[0] == parts[1]:
        what = f'"{file.stem}" does not name two targets'
        raise HriError(f"{file}: {what} - name it such as mouthSmile+jawOpen.svg")
    for part in parts:
        if part not in known:
            what = f'the face has no target "{part}"'
            raise HriError(f"{file}: {what} - {did_you_mean(part, known)}")
