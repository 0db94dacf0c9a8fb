"""Learns the score of a single shake, once to a side and back, from runs of swings of real heads.

`python -m benchmarks.vision.learn_score` prints the learned line of `config/gestures.toml`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.vision.gestures.gesture_patterns import PatternRow
from hri.vision.gestures.gesture_recognizer import Movement
from hri.vision.gestures.swing_score import FEATURES, Features, SwingScore

RIDGE = 10.0
"""Weight of the squared weights, of standardized features, against one series of poses."""
STEPS = 25
"""Of Newton's method; it needs some eight."""

LOOSE: dict[str, Any] = {
    "width": math.radians(2.5),
    "duration": 1.0,
    "quickest": 0.08,
    "rest": 0.95,
    "unevenness": math.inf,
    "slowing": 1.0,
    "dominance": {},
}
"""Limits of what is learned from; what keeps narrower ones has too few looks about in it."""

Values = NDArray[np.float64]
Chosen = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Runs:
    """Pairs of swings in the latest poses, one for each pose that has one."""

    features: Values
    """[runs, features]."""
    series: NDArray[np.int_]
    """Of which series of poses, by run."""
    poses: NDArray[np.int_]
    """Number of the pose."""
    fits: Chosen
    """Whether they keep the limits of a single shake; all are learned from."""

    def of(self, series: Chosen) -> Chosen:
        """Which runs are of some series."""
        return np.asarray(series[self.series])

    def moments(self, scores: Values, count: int) -> Values:
        """Number of the first pose that fits and scores above 0, infinity for none, by series."""
        first = np.full(count, np.inf)
        told = self.fits & (scores > 0)
        np.minimum.at(first, self.series[told], self.poses[told])
        return first


def pair(movement: Movement, row: PatternRow, axis: int) -> tuple[Features, bool] | None:
    """The features of the latest two swings of an angle, and whether all but the score of a row
    fits; None where they do not go out and back.
    """
    loose = replace(row, score=None, **LOOSE)
    if not movement.makes(loose, axis):
        return None
    fits = movement.makes(replace(row, score=None), axis)
    return movement.features(movement.swings(axis)[-row.swings :], axis), fits


def fit(runs: Runs, is_shake: Chosen, learned: Chosen) -> SwingScore:
    """Logistic regression on the runs of some series, all series with the same weight.

    `is_shake` and `learned` are by series. Features are standardized, and their weights drawn to 0.
    """
    own = runs.of(learned)
    features, series = runs.features[own], runs.series[own]
    weights = 1 / np.bincount(series)[series]
    mean = np.average(features, axis=0, weights=weights)
    spread = np.sqrt(np.average((features - mean) ** 2, axis=0, weights=weights))
    inputs = np.column_stack([(features - mean) / spread, np.ones(len(features))])
    ridge = np.diag([RIDGE] * len(FEATURES) + [0.0])
    found = np.zeros(len(FEATURES) + 1)
    for _ in range(STEPS):
        likely = 1 / (1 + np.exp(-inputs @ found))
        slope = inputs.T @ (weights * (likely - is_shake[series])) + ridge @ found
        bend = (inputs * (weights * likely * (1 - likely))[:, None]).T @ inputs + ridge
        found -= np.linalg.solve(bend, slope)
    width, duration, rest, dominance = (found[:-1] / spread).tolist()
    bias = float(found[-1] - (found[:-1] / spread) @ mean)
    return SwingScore(bias, (width, duration, rest, dominance))


def scores(runs: Runs, score: SwingScore) -> Values:
    """Of each run."""
    return np.asarray(runs.features @ np.array(score.weights) + score.bias)


def scores_by_others(
    runs: Runs, is_shake: Chosen, learned: Chosen, parts: Sequence[Chosen]
) -> Values:
    """What the runs of each part score by what is learned from those of the other parts.

    All but `runs` are by series; the parts cover all series, only `learned` ones are learned from.
    """
    found = np.full(len(runs.series), -np.inf)
    for part in parts:
        score = fit(runs, is_shake, learned & ~part)
        found[runs.of(part)] = scores(runs, score)[runs.of(part)]
    return found


def line(score: SwingScore) -> str:
    """A score as the row of a pattern has it."""
    named = zip(("bias", *FEATURES), (score.bias, *score.weights), strict=True)
    words = ", ".join(f"{name} = {value:.2f}" for name, value in named)
    return f"score = {{ {words} }}"
