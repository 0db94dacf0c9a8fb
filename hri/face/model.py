"""A face, loaded: its display list, its vocabulary, and the blend of both."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.face.baking import DisplayList, Vector, bake
from hri.face.drawing import load_drawing
from hri.face.outline import Matrix
from hri.face.settings import Settings, Weights, load_settings
from hri.face.vocabulary import MOTIONS, VISEMES, sides_of

MOST_TARGETS = 300
LEAST_WEIGHT, LARGEST_WEIGHT = -1.5, 1.5
"""Weights beyond are cut off: no drawing survives them."""


class FaceModel:
    """A face that can take any expression; immutable."""

    def __init__(
        self, name: str, display: DisplayList, settings: Settings, targets: tuple[str, ...]
    ) -> None:
        self.name = name
        self.display = display
        self.settings = settings
        self.targets = targets
        """Names of the drawings."""
        self.channels = (*display.channels, *MOTIONS)
        """What can be weighted, one number each: sides of targets and motions of the head."""
        self._index = {channel: number for number, channel in enumerate(self.channels)}

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
        return frozenset((*self.channels, *self.targets))

    def expression(self, label: str) -> Weights:
        """The weights of an expression. Raises HriError for an unknown label."""
        if label not in self.expressions:
            remedy = did_you_mean(label, self.expressions)
            raise HriError(f'the face {self.name} has no expression "{label}" - {remedy}')
        return self.expressions[label]

    def viseme(self, name: str) -> Weights:
        """The weights of a viseme. Raises HriError for an unknown name."""
        if name not in self.visemes:
            raise HriError(f'no viseme "{name}" - {did_you_mean(name, VISEMES)}')
        return self.visemes[name]

    def vector(self, weights: Weights) -> Vector:
        """Weights as one number for each channel; the name of a whole target feeds both sides.

        Raises HriError for an unknown name or a weight that is not finite.
        """
        vector = np.zeros(len(self.channels), np.float32)
        for name, weight in weights.items():
            if not math.isfinite(weight):
                raise HriError(f"the weight of {name} is {weight} - give a finite number")
            for channel in (name,) if name in self._index else self._sides(name):
                vector[self._index[channel]] += weight
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
        weights = np.clip(vector[: -len(MOTIONS)], LEAST_WEIGHT, LARGEST_WEIGHT)
        blended = self.display.neutral + weights @ self.display.rows
        split = 2 * self.display.points
        return blended[:split].reshape(-1, 2), blended[split:]

    def motion(self, vector: Vector) -> Matrix:
        """How the whole head moves, in units of the drawing."""
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


def load_face(name: str | Path = "robot") -> FaceModel:
    """A face by its name in `faces/`, or by the path of its folder.

    Raises AuthoringError with the place of what is wrong, HriError when there is no such face.
    """
    folder = Path(name) if isinstance(name, Path) else paths.find("faces", name)
    if not (folder / "face.toml").is_file():
        raise HriError(f"{folder} is no face - it needs face.toml, neutral.svg and targets/")
    files = [folder / "face.toml", folder / "neutral.svg", *_target_files(folder)]
    stamps = tuple((str(file), _stamp(file)) for file in files)
    return _load(folder.resolve(), stamps)


def _stamp(file: Path) -> tuple[int, int]:
    try:
        status = file.stat()
    except OSError as error:
        reason = error.strerror or str(error)
        raise HriError(f"{file}: cannot read this drawing: {reason} - add it") from error
    return status.st_mtime_ns, status.st_size


def _target_files(folder: Path) -> list[Path]:
    files = sorted((folder / "targets").glob("*.svg"))
    if len(files) > MOST_TARGETS:
        raise HriError(f"{folder}/targets has {len(files)} drawings - keep to {MOST_TARGETS}")
    return files


@lru_cache(maxsize=4)
def _load(folder: Path, stamps: tuple[tuple[str, tuple[int, int]], ...]) -> FaceModel:
    """Read a face; `stamps` make a changed face a new one."""
    targets = {file.stem: load_drawing(file) for file in _target_files(folder)}
    display = bake(load_drawing(folder / "neutral.svg"), targets)
    names = {*targets, *display.channels, *MOTIONS}
    settings = load_settings(folder / "face.toml", names)
    return FaceModel(folder.name, display, settings, tuple(targets))
