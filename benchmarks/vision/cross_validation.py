"""The same recordings, judged by limits that were chosen without them.

The limits of `config/gestures.toml` were fitted to these recordings, so they are right more often
on them than on others. Here the limits of the two-swing rows, which matter most, are chosen again
on four fifths of the recordings and judged on the last fifth, for each fifth in turn. The form of
the rows and the limits that are not chosen were made with all recordings in view.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from benchmarks.vision.recordings import (
    ACCURACY,
    F1,
    KINDS,
    NOD_AS_SHAKE,
    RATE,
    SHAKE_AS_NOD,
    Recording,
    read_recordings,
)
from hri.bench.table import Row as Figure, amount, at_least, at_most, share
from hri.vision.gestures.angle_noise import Noise
from hri.vision.gestures.gesture_patterns import ANSWERS, Pattern, PatternRow, answer_patterns
from hri.vision.gestures.gesture_recognizer import Movement

FOLDS, DIVISIONS, SEEDS = 5, 3, 3
"""Parts, ways to divide, and draws of the noise."""
NOD_CHOICES = tuple(itertools.product((0.5, 0.6, 0.7), (1.5, 2.0, 2.5)))
"""Rest, dominance over yaw."""
SHAKE_CHOICES = tuple(itertools.product((0.4, 0.45, 0.5), (0.4, 0.5, 0.6), (0.7, 0.8, 0.9)))
"""Seconds of a swing, rest, slowing."""
CONTRADICTION = 2.5
"""Ratio; a head must move farther by it on the other axis for its label to be doubted."""

NAME = f"prompted, real heads, {FOLDS}-fold cross-validated"

Moments = NDArray[np.float64]
"""Number of the pose at which a gesture is recognized, infinity for never: [series, choices]."""
Confusion = NDArray[np.int_]
"""How many of each kind were taken for each kind: [done, told]."""


@dataclass(frozen=True, eq=False)
class Told:
    """What each choice of limits makes of each series of poses."""

    kinds: NDArray[np.int_]
    """What was done: index in KINDS, by series."""
    recordings: NDArray[np.int_]
    """Of which recording a series was made."""
    moments: Mapping[str, Moments]
    """By gesture."""

    def judged(self, series: NDArray[np.bool_]) -> NDArray[np.int_]:
        """What some series are taken for: index in KINDS, [nod choices, shake choices, series]."""
        nod = self.moments["nod"][series].T[:, None]
        shake = self.moments["shake"][series].T[None, :]
        answered = np.where(nod <= shake, 0, 1)
        return np.where(np.isinf(np.minimum(nod, shake)), 2, answered)


def rows() -> Iterator[Figure]:
    """Accuracy, F1 and confusions on recordings that the limits were not chosen on.

    Some recordings show another movement than their label says. The same figures without those
    follow, and with their labels corrected.
    """
    recordings = read_recordings()
    told = tell(recordings, answer_patterns())
    yield from _figures(NAME, confusion(told, np.ones(len(recordings), bool)))
    plain = np.array([not is_contradicted(recording) for recording in recordings])
    doubtful = [recordings[number].name for number in np.flatnonzero(~plain)]
    name = f"{NAME}, without {len(doubtful)} doubtful labels"
    for figure in _figures(name, confusion(told, plain)):
        yield figure | {"left_out": doubtful}
    kinds = np.array([KINDS.index(corrected(recordings[n])) for n in told.recordings])
    name = f"{NAME}, with {len(doubtful)} corrected labels"
    mended = replace(told, kinds=kinds)
    yield from _figures(name, confusion(mended, np.ones(len(recordings), bool)))


def _figures(name: str, counts: Confusion) -> Iterator[Figure]:
    yield share(f"{name}: accuracy", int(np.trace(counts)), int(counts.sum()), at_least(ACCURACY))
    for index, kind in enumerate(ANSWERS):
        f1 = 2 * counts[index, index] / (counts[index].sum() + counts[:, index].sum())
        yield amount(f"{name}: F1 of {kind}", float(f1), "1", at_least(F1))
    nods, shakes = int(counts[0].sum()), int(counts[1].sum())
    as_nod, as_shake = int(counts[1, 0]), int(counts[0, 1])
    yield share(f"{name}: shake read as nod", as_nod, shakes, at_most(SHAKE_AS_NOD))
    yield share(f"{name}: nod read as shake", as_shake, nods, at_most(NOD_AS_SHAKE))


def is_contradicted(recording: Recording) -> bool:
    """Whether a nod moves farther by that in yaw than in pitch, or a shake in pitch than in yaw."""
    pitch, yaw, _ = np.ptp(recording.angles, axis=0)
    if recording.kind == "nod":
        return bool(yaw > CONTRADICTION * pitch)
    return bool(recording.kind == "shake" and pitch > CONTRADICTION * yaw)


def corrected(recording: Recording) -> str:
    """The label of a recording, or the other one where the movement contradicts it."""
    if not is_contradicted(recording):
        return recording.kind
    return next(kind for kind in ANSWERS if kind != recording.kind)


def confusion(told: Told, counted: NDArray[np.bool_]) -> Confusion:
    """What the held-out series are taken for, summed over all folds and divisions.

    Of the recordings that are `counted`; the limits are chosen on all.
    """
    counts = np.zeros((len(KINDS), len(KINDS)), int)
    for division in range(DIVISIONS):
        fold = _folds(told, division)
        for part in range(FOLDS):
            trained = fold != part
            held_out = (fold == part) & counted[told.recordings]
            right = (told.judged(trained) == told.kinds[trained]).mean(axis=2)
            nod, shake = _middle_of_best(right)
            judged = told.judged(held_out)[nod, shake]
            np.add.at(counts, (told.kinds[held_out], judged), 1)
    return counts


def tell(recordings: Sequence[Recording], patterns: Sequence[Pattern]) -> Told:
    """Follow all recordings with several draws of noise, and try all choices on each."""
    nod, shake = patterns
    rows = {
        "nod": (nod.axis, _longer(nod), _nod_choices(_single(nod))),
        "shake": (shake.axis, _longer(shake), _shake_choices(_single(shake))),
    }
    moments: dict[str, list[NDArray[np.float64]]] = {kind: [] for kind in rows}
    numbers = [number for number in range(len(recordings)) for _ in range(SEEDS)]
    for series, number in enumerate(numbers):
        poses = recordings[number].poses(RATE, 1.0, 1000 * number + 500 + series % SEEDS)
        first = {kind: np.full(len(choices), np.inf) for kind, (_, _, choices) in rows.items()}
        movement = Movement(Noise())
        for index, pose in enumerate(poses):
            movement.add(pose.time, (pose.pitch, pose.yaw, pose.roll))
            for kind, (axis, always, choices) in rows.items():
                if any(movement.makes(row, axis) for row in always):
                    first[kind] = np.minimum(first[kind], index)
                for choice in np.flatnonzero(np.isinf(first[kind])).tolist():
                    if movement.makes(choices[choice], axis):
                        first[kind][choice] = index
        for kind, found in first.items():
            moments[kind].append(found)
    kinds = np.array([KINDS.index(recordings[number].kind) for number in numbers])
    return Told(kinds, np.array(numbers), {kind: np.array(m) for kind, m in moments.items()})


def _longer(pattern: Pattern) -> list[PatternRow]:
    return [row for row in pattern.rows if row.swings > 2 and True in row.prompted]


def _single(pattern: Pattern) -> PatternRow:
    return next(row for row in pattern.rows if row.swings == 2)


def _nod_choices(row: PatternRow) -> list[PatternRow]:
    return [
        replace(row, rest=rest, dominance={**row.dominance, "yaw": yaw})
        for rest, yaw in NOD_CHOICES
    ]


def _shake_choices(row: PatternRow) -> list[PatternRow]:
    return [
        replace(row, duration=duration, rest=rest, slowing=slowing)
        for duration, rest, slowing in SHAKE_CHOICES
    ]


def _folds(told: Told, division: int) -> NDArray[np.int_]:
    """The fold of each series: recordings of each kind are dealt out by themselves."""
    dice = np.random.default_rng(division)
    fold = np.zeros(told.recordings.max() + 1, int)
    for kind in range(len(KINDS)):
        own = np.unique(told.recordings[told.kinds == kind])
        fold[dice.permutation(own)] = np.arange(len(own)) % FOLDS
    return np.asarray(fold[told.recordings])


def _middle_of_best(right: NDArray[np.float64]) -> tuple[int, int]:
    """Of the choices that are right most often, the one nearest to their middle."""
    best = np.argwhere(right >= right.max() - 1e-9)
    places = np.array(
        [[*_place(NOD_CHOICES, nod), *_place(SHAKE_CHOICES, shake)] for nod, shake in best]
    )
    middle = np.abs(places - places.mean(axis=0)).sum(axis=1).argmin()
    nod, shake = best[middle].tolist()
    return nod, shake


def _place(choices: Sequence[tuple[float, ...]], index: int) -> list[int]:
    """Where each limit of a choice stands among the values it may have."""
    columns = [sorted(set(column)) for column in zip(*choices, strict=True)]
    return [column.index(value) for column, value in zip(columns, choices[index], strict=True)]
