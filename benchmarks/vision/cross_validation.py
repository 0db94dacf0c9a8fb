"""The same recordings, judged by limits that were chosen without them.

The limits of `config/gestures.toml` were fitted to these recordings, so they are right more often
on them than on others. Here the limits of a single nod and the score of a single shake, which
matter most, are found again on four fifths of the recordings and judged on the last fifth, for each
fifth in turn. How much a shake must score is chosen by what each of the four fifths scores by the
other three. The form of the rows and the limits that are not chosen were made with all recordings
in view.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
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
from benchmarks.vision.swing_training import (
    Runs,
    Values,
    fit,
    pair,
    scores_by_others,
)
from hri.bench.table import Row as Figure, amount, at_least, at_most, share
from hri.vision.gestures.angle_noise import Noise
from hri.vision.gestures.gesture_patterns import ANSWERS, Pattern, PatternRow, answer_patterns
from hri.vision.gestures.gesture_recognizer import Movement
from hri.vision.gestures.swing_score import Features, SwingScore

FOLDS, DIVISIONS, SEEDS = 5, 3, 3
"""Parts, ways to divide, and draws of the noise."""
NOD_CHOICES = tuple(itertools.product((0.5, 0.6, 0.7), (1.5, 2.0, 2.5)))
"""Rest, dominance over yaw."""
SHAKE_CHOICES = tuple(np.arange(0.0, 3.25, 0.25).tolist())
"""Least scores."""
TIED = 0.004
"""Choices that are right less often than the best by this are as good: two of 480 series."""
CONTRADICTION = 2.5
"""Ratio; a head must move farther by it on the other axis for its label to be doubted."""

NAME = f"prompted, real heads, {FOLDS}-fold cross-validated"

Confusion = NDArray[np.int_]
"""How many of each kind were taken for each kind: [done, told]."""


@dataclass(frozen=True, eq=False)
class Told:
    """What is made of each series of poses.

    A moment is the number of the pose at which a gesture is recognized, infinity for never.
    """

    kinds: NDArray[np.int_]
    """What was done: index in KINDS, by series."""
    recordings: NDArray[np.int_]
    """Of which recording a series was made."""
    nods: Values
    """Moments by each choice of limits, [series, choices]."""
    shakes: Values
    """Moments by the rows of three swings and more, [series]."""
    runs: Runs
    """What may be a single shake."""
    is_doubtful: NDArray[np.bool_]
    """Whether the label is, by series; no score is learned from these."""

    @property
    def is_shake(self) -> NDArray[np.bool_]:
        """By series."""
        return np.asarray(self.kinds == KINDS.index("shake"))

    def scores(self, learned: NDArray[np.bool_], parts: Sequence[NDArray[np.bool_]]) -> Values:
        """What each run scores by some series that are of other parts than its own."""
        return scores_by_others(self.runs, self.is_shake, learned & ~self.is_doubtful, parts)

    def shake_moments(self, found: Values) -> Values:
        """Moments by each choice of the least score, [series, choices]; scores are by run."""
        count = len(self.kinds)
        moments = [self.runs.moments(found - least, count) for least in SHAKE_CHOICES]
        return np.minimum(np.stack(moments, 1), self.shakes[:, None])

    def judged(self, shakes: Values, series: NDArray[np.bool_]) -> NDArray[np.int_]:
        """What some series are taken for: index in KINDS, [nod choices, shake choices, series]."""
        nod, shake = self.nods[series].T[:, None], shakes[series].T[None, :]
        answered = np.where(nod <= shake, 0, 1)
        return np.where(np.isinf(np.minimum(nod, shake)), 2, answered)

    def choose(self, found: Values, trained: NDArray[np.bool_]) -> tuple[int, int]:
        """The choices that are right most often, by scores that were not learned on each."""
        judged = self.judged(self.shake_moments(found), trained)
        return _middle_of_best((judged == self.kinds[trained]).mean(axis=2))


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
        parts = _parts(told, division)
        for part in parts:
            held_out = part & counted[told.recordings]
            found = told.scores(~part, parts)
            nod, shake = told.choose(found, ~part)
            judged = told.judged(told.shake_moments(found), held_out)[nod, shake]
            np.add.at(counts, (told.kinds[held_out], judged), 1)
    return counts


def learned_score(told: Told) -> SwingScore:
    """The score of a single shake by all recordings, 0 at the median of the least scores chosen."""
    everything = np.ones(len(told.kinds), bool)
    chosen = []
    for division in range(DIVISIONS):
        found = told.scores(everything, _parts(told, division))
        chosen.append(SHAKE_CHOICES[told.choose(found, everything)[1]])
    score = fit(told.runs, told.is_shake, ~told.is_doubtful)
    return replace(score, bias=score.bias - float(np.median(chosen)))


def tell(recordings: Sequence[Recording], patterns: Sequence[Pattern]) -> Told:
    """Follow all recordings with several draws of noise, and try all choices of a nod on each."""
    nod, shake = patterns
    choices = _nod_choices(_single(nod))
    numbers = [number for number in range(len(recordings)) for _ in range(SEEDS)]
    nods = np.full((len(numbers), len(choices)), np.inf)
    shakes = np.full(len(numbers), np.inf)
    runs: list[tuple[Features, int, int, bool]] = []
    for series, number in enumerate(numbers):
        poses = recordings[number].poses(RATE, 1.0, 1000 * number + 500 + series % SEEDS)
        movement = Movement(Noise())
        for index, pose in enumerate(poses):
            movement.add(pose.time, (pose.pitch, pose.yaw, pose.roll))
            if any(movement.makes(row, nod.axis) for row in _longer(nod)):
                nods[series] = np.minimum(nods[series], index)
            if any(movement.makes(row, shake.axis) for row in _longer(shake)):
                shakes[series] = min(shakes[series], index)
            for choice in np.flatnonzero(np.isinf(nods[series])).tolist():
                if movement.makes(choices[choice], nod.axis):
                    nods[series, choice] = index
            if (found := pair(movement, _single(shake), shake.axis)) is not None:
                runs.append((found[0], series, index, found[1]))
    return Told(
        kinds=np.array([KINDS.index(recordings[number].kind) for number in numbers]),
        recordings=np.array(numbers),
        nods=nods,
        shakes=shakes,
        runs=Runs(*map(np.array, zip(*runs, strict=True))),
        is_doubtful=np.array([is_contradicted(recordings[number]) for number in numbers]),
    )


def _longer(pattern: Pattern) -> list[PatternRow]:
    return [row for row in pattern.rows if row.swings > 2 and True in row.prompted]


def _single(pattern: Pattern) -> PatternRow:
    return next(row for row in pattern.rows if row.swings == 2)


def _nod_choices(row: PatternRow) -> list[PatternRow]:
    return [
        replace(row, rest=rest, dominance={**row.dominance, "yaw": yaw})
        for rest, yaw in NOD_CHOICES
    ]


def _parts(told: Told, division: int) -> list[NDArray[np.bool_]]:
    """Which series each fold has: recordings of each kind are dealt out by themselves."""
    dice = np.random.default_rng(division)
    fold = np.zeros(told.recordings.max() + 1, int)
    for kind in range(len(KINDS)):
        own = np.unique(told.recordings[told.kinds == kind])
        fold[dice.permutation(own)] = np.arange(len(own)) % FOLDS
    return [fold[told.recordings] == part for part in range(FOLDS)]


def _middle_of_best(right: NDArray[np.float64]) -> tuple[int, int]:
    """Of the choices that are right most often, the one nearest to their middle."""
    best = np.argwhere(right >= right.max() - TIED)
    places = np.array([[*_place(NOD_CHOICES, nod), shake] for nod, shake in best])
    middle = np.abs(places - places.mean(axis=0)).sum(axis=1).argmin()
    nod, shake = best[middle].tolist()
    return nod, shake


def _place(choices: Sequence[tuple[float, ...]], index: int) -> list[int]:
    """Where each limit of a choice stands among the values it may have."""
    columns = [sorted(set(column)) for column in zip(*choices, strict=True)]
    return [column.index(value) for column, value in zip(columns, choices[index], strict=True)]
