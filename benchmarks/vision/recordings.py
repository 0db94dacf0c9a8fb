"""Nods, shakes and looks around of real heads: what is recognized while an answer is expected.

The recordings lie beside the project, `../shared/vision/heads`; they were made with head trackers.
What a camera adds is added: 30 poses a second, noise of 0.6 degrees in pitch and 0.3 in yaw.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.bench.table import Row, amount, at_most
from hri.core import paths
from hri.core.errors import NotAvailable
from hri.core.signals import HeadGesture, HeadPose
from hri.vision.gestures.gesture_patterns import Pattern, answer_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer

RATE = 30.0
NOISE = np.radians([0.6, 0.3, 0.3])
"""Pitch, yaw, roll."""
SEEDS = 5
"""Draws of the noise that are averaged."""
OTHER = "other"
KINDS = ("nod", "shake", OTHER)
ACCURACY, F1, SHAKE_AS_NOD, NOD_AS_SHAKE, ALARMS_A_MINUTE = 0.92, 0.92, 0.03, 0.01, 3.0
LATENCY_S = {50: ("median", 0.45), 90: ("p90", 0.9)}
"""Seconds, by percentile."""
HARSHER = {
    "10 a second": (10.0, 1.0),
    "15 a second": (15.0, 1.0),
    "noise of 1.5 degrees": (30, 2.5),
}
"""Poses a second, and times the noise."""


@dataclass(frozen=True, eq=False)
class Recording:
    """One movement of a real head."""

    name: str
    kind: str
    """One of KINDS."""
    times: NDArray[np.float64]
    """Seconds."""
    angles: NDArray[np.float64]
    """Pitch, yaw and roll, radians, shape [n, 3]."""

    def poses(self, rate: float, noise: float, seed: int) -> Iterator[HeadPose]:
        """As a camera would see it: at a rate, with a multiple of `NOISE`."""
        times = np.arange(self.times[0], self.times[-1], 1 / rate)
        drawn = np.random.default_rng(seed).normal(0, 1, (len(times), 3)) * NOISE * noise
        columns = [np.interp(times, self.times, column) for column in self.angles.T]
        for time, row in zip(times.tolist(), np.stack(columns, 1) + drawn, strict=True):
            yield HeadPose(time, *row.tolist())

    @property
    def seconds(self) -> float:
        return float(self.times[-1] - self.times[0])


def folder() -> Path:
    """Where the recordings are. Raises NotAvailable when they are not."""
    found = paths.house().parent / "shared" / "vision" / "heads"
    if not found.is_dir():
        raise NotAvailable(f"no recordings at {found} - they are not part of the project")
    return found


def read_recordings() -> list[Recording]:
    """All of them. Raises NotAvailable."""
    return [_read(path) for path in sorted(folder().glob("*.csv"))]


def _read(path: Path) -> Recording:
    with path.open(encoding="utf-8", newline="") as file:
        table = [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]
    times, *angles = np.array(table).T
    unwrapped = np.unwrap(np.radians(np.array(angles)), axis=1)
    return Recording(path.stem, path.stem.partition("_")[0], times, unwrapped.T)


def rows() -> Iterator[Row]:
    """Prompted and unprompted, and the same in harsher conditions."""
    recordings, patterns = read_recordings(), answer_patterns()
    found = _all(recordings, patterns, RATE, 1.0, is_prompted=True)
    yield from _prompted(found)
    yield from _unprompted(recordings, patterns)
    for name, (rate, noise) in HARSHER.items():
        harsh = _all(recordings, patterns, rate, noise, is_prompted=True)
        right = sum(kind == told for kind, told, _ in harsh)
        yield {"what": f"prompted, {name}: accuracy", "rate": round(right / len(harsh), 4)}


Told = tuple[str, str, float]
"""What was done, what was told first, and seconds from its onset."""


def _all(
    recordings: Sequence[Recording],
    patterns: Sequence[Pattern],
    rate: float,
    noise: float,
    is_prompted: bool,
) -> list[Told]:
    told = []
    for number, recording in enumerate(recordings):
        for seed in range(SEEDS):
            poses = recording.poses(rate, noise, 1000 * number + seed)
            gestures = list(_gestures(poses, patterns, is_prompted))
            first = gestures[0] if gestures else HeadGesture(OTHER, math.nan)
            told.append((recording.kind, first.kind, first.latency))
    return told


def _gestures(
    poses: Iterator[HeadPose], patterns: Sequence[Pattern], is_prompted: bool
) -> Iterator[HeadGesture]:
    recognizer = GestureRecognizer(patterns)
    for pose in poses:
        if (gesture := recognizer.update(pose, is_prompted)) is not None:
            yield gesture


def _prompted(found: Sequence[Told]) -> Iterator[Row]:
    """What `cross_validation` judges, with the limits as they are, and the latency."""
    right = sum(kind == told for kind, told, _ in found)
    what = "prompted, real heads, limits fitted to these: accuracy"
    yield {"what": what, "rate": round(right / len(found), 4)}
    latencies = [latency for kind, told, latency in found if kind == told != OTHER]
    for percentile, (name, limit) in LATENCY_S.items():
        what = f"prompted, real heads: latency from movement onset, {name}"
        yield amount(what, float(np.percentile(latencies, percentile)), "s", at_most(limit))


def _unprompted(recordings: Sequence[Recording], patterns: Sequence[Pattern]) -> Iterator[Row]:
    others = [recording for recording in recordings if recording.kind == OTHER]
    alarms = sum(
        len(list(_gestures(recording.poses(RATE, 1.0, 1000 * number + seed), patterns, False)))
        for number, recording in enumerate(others)
        for seed in range(SEEDS)
    )
    minutes = SEEDS * sum(recording.seconds for recording in others) / 60
    what = "unprompted, fast looks around: false alarms"
    yield amount(what, alarms / minutes, "1/min", at_most(ALARMS_A_MINUTE))
