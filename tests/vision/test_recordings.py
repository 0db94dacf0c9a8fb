"""The recognizer on recordings of real heads, which are not part of the project."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from hri.core.signals import HeadPose
from hri.vision.gesture import GestureRecognizer

FOLDER = Path(__file__).resolve().parents[2].parent / "shared" / "vision" / "heads"
RATE = 30.0
NOISE = (0.6, 0.3)
"""Degrees, pitch and yaw: what a camera adds."""
KINDS = ("nod", "shake", "other")

pytestmark = pytest.mark.skipif(not FOLDER.is_dir(), reason="the recordings are not here")


def poses(path: Path, dice: np.random.Generator) -> Iterator[HeadPose]:
    recorded = np.loadtxt(path, delimiter=",", skiprows=1)
    times = np.arange(recorded[0, 0], recorded[-1, 0], 1 / RATE)
    for i in (1, 2):
        recorded[:, i] = np.unwrap(np.radians(recorded[:, i]))
    angles = [
        np.interp(times, recorded[:, 0], recorded[:, i + 1])
        + np.radians(dice.normal(0, NOISE[i], len(times)))
        for i in (0, 1)
    ]
    yield from (HeadPose(*row) for row in zip(times.tolist(), *map(list, angles), strict=True))


def confusion(prompted: bool) -> np.ndarray:
    """How many of each kind (row) were taken for each kind (column)."""
    counts, dice = np.zeros((3, 3)), np.random.default_rng(0)
    for path in sorted(FOLDER.glob("*.csv")):
        recognizer = GestureRecognizer()
        found = (recognizer.update(pose, prompted) for pose in poses(path, dice))
        first = next((gesture.kind for gesture in found if gesture is not None), "other")
        counts[KINDS.index(path.name.split("_")[0]), KINDS.index(first)] += 1
    return counts


def f1(counts: np.ndarray, kind: int) -> float:
    return float(2 * counts[kind, kind] / (counts[kind].sum() + counts[:, kind].sum()))


def test_answers_of_real_people() -> None:
    counts = confusion(prompted=True)
    assert np.trace(counts) / counts.sum() >= 0.89
    assert f1(counts, 0) >= 0.91
    assert f1(counts, 1) >= 0.87
    assert counts[0, 1] <= 1, "a nod taken for a shake is the worst error"


def test_real_people_whom_nobody_asked() -> None:
    counts = confusion(prompted=False)
    assert np.trace(counts) / counts.sum() >= 0.85
    assert counts[2, 2] >= 47
