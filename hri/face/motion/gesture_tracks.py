"""Gestures: nod, wink, yawn and the like as tracks of keyframes, read from `gestures.toml`.

`faces/gestures.toml` holds those that every face can make; a face may have its own beside its
`face.toml`, which win. Channels that a face lacks are left out. Between keyframes the weights
follow a monotone cubic (Fritsch & Carlson 1980): smooth, and never beyond a keyframe.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core import paths
from hri.core.errors import did_you_mean
from hri.core.toml import Table, load_toml
from hri.face.model import FaceModel
from hri.face.motion.spring import Values
from hri.face.regions import NAMES, by_region
from hri.face.vocabulary import ARKIT, MOTIONS, PAIRED, TURNS, sides_of

FILE = "gestures.toml"
Numbers = NDArray[np.floating[Any]]
"""Of any precision: a long recording is kept in half the memory."""
MOST_GESTURES = 200
MOST_KEYS = 500
LONGEST = 60.0
"""Seconds of a gesture."""
SHORTEST = 0.05
STRONGEST = 1.5
LARGEST = 2.0
"""Of a weight; motions of the head may go beyond 1."""
GAZE = ("gazeX", "gazeY")
"""Names of a gesture for where the eyes look, as `Gaze` has it: whatever it takes on a face."""
EXTRAS = (
    "antennaDroop", "antennaGlow", "antennaPerk", "blush", "bodyShrink", "bodyTall", "bodyWide",
    "earGlow", "eyeDroop", "leafFlat", "leafFoldRight", "leafOut", "mouthWavy", "pupilWide", "tear",
    "tongueUp",
)  # fmt: skip
"""What a drawn face may have beside ARKit's targets."""
KNOWN = frozenset((*ARKIT, *PAIRED, *MOTIONS, *TURNS, *GAZE, *EXTRAS))
FADE = 0.25
"""Seconds in which a gesture takes over the regions it owns, and gives them back."""


@dataclass(frozen=True, slots=True)
class Gesture:
    """Keyframes of some weights, at rest before the first and after the last."""

    name: str
    duration: float
    """Seconds, when nothing else is asked for."""
    times: tuple[float, ...]
    """Seconds of the keyframes."""
    weights: Mapping[str, tuple[float, ...]]
    """One for each keyframe, by channel or whole target."""
    owns: tuple[str, ...] = ()
    """Regions in which the gesture replaces the expression."""
    about: str = ""


def load_gestures(model: FaceModel) -> Mapping[str, Gesture]:
    """The gestures a face can make, by name. Raises AuthoringError with the place of a mistake."""
    files = [paths.find("faces", FILE)] if FILE in paths.names("faces") else []
    if (model.folder / FILE).is_file():
        files.append(model.folder / FILE)
    found: dict[str, Gesture] = {}
    for file in files:
        found |= _read(file, file.stat().st_mtime_ns, frozenset(model.names))
    return found


@lru_cache(maxsize=16)
def _read(path: Path, stamp: int, names: frozenset[str]) -> Mapping[str, Gesture]:
    """Read a file; `stamp` makes a changed file a new one."""
    return read_gestures(path, names)


def read_gestures(path: Path, names: Collection[str] = ()) -> dict[str, Gesture]:
    """The gestures of one file; `names` may be weighted beside those that all faces know.

    Raises AuthoringError with the place of a mistake.
    """
    table = load_toml(path, "file of gestures")
    if len(table.data) > MOST_GESTURES:
        raise table.error(None, f"{len(table.data)} gestures", f"keep to {MOST_GESTURES}")
    known = KNOWN | set(names)
    found = {name: _gesture(name, table.table(name), known) for name in table.data}
    table.finish()
    return found


def _gesture(name: str, table: Table, known: Collection[str]) -> Gesture:
    duration = table.number("duration_s", minimum=SHORTEST, maximum=LONGEST)
    times = table.numbers("at")
    _check_times(table, times, duration)
    owns = table.strings("owns", ())
    for region in owns:
        if region not in NAMES:
            raise table.error("owns", f'no region "{region}"', did_you_mean(region, NAMES))
    about = table.string("about", "")
    keys = table.table("weights")
    weights = {}
    for channel in keys.data:
        if channel not in known:
            what = f'no face has a target "{channel}"'
            raise keys.error(channel, what, did_you_mean(channel, known))
        row = keys.numbers(channel, count=len(times))
        if any(abs(weight) > LARGEST for weight in row):
            what = f"{channel} goes beyond {LARGEST:g}"
            raise keys.error(channel, what, f"write weights from -{LARGEST:g} to {LARGEST:g}")
        weights[channel] = tuple(row)
    table.finish()
    return Gesture(name, duration, tuple(times), weights, tuple(owns), about)


def _check_times(table: Table, times: Sequence[float], duration: float) -> None:
    if not 1 <= len(times) <= MOST_KEYS:
        raise table.error("at", f"{len(times)} keyframes", f"write 1 to {MOST_KEYS}")
    if not all(a < b for a, b in zip((0.0, *times), (*times, duration), strict=True)):
        what = f"keyframes at {', '.join(f'{time:g}' for time in times)} s"
        raise table.error("at", what, f"let them rise, above 0 and below duration_s, {duration:g}")


class Track:
    """Weights over time for one face: a gesture or a recording, ready to be played."""

    def __init__(
        self, times: Values, values: Numbers, gaze: Numbers, owned: Values, fade: float = FADE
    ) -> None:
        """`times` [n] in seconds from 0; `values` [n, channels]; `gaze` [n, 2]; `owned` [channels],
        0 to 1, is how much of each channel it replaces, after `fade` seconds."""
        self.duration = float(times[-1])
        self.owned = owned
        self._fade = min(fade, self.duration / 3)
        self._times = times
        self._values = np.hstack([values, gaze])
        self._slopes = _monotone_slopes(times, self._values)

    def at(self, time: float) -> tuple[Values, Values]:
        """The weights of all channels and the gaze [2] at a time in seconds."""
        time = min(max(time, 0.0), self.duration)
        last = len(self._times) - 2
        number = min(max(int(np.searchsorted(self._times, time, side="right")) - 1, 0), last)
        length = self._times[number + 1] - self._times[number]
        u = (time - self._times[number]) / length
        rise = u * u * (3 - 2 * u)
        value = (
            (1 - rise) * self._values[number]
            + rise * self._values[number + 1]
            + length * u * (1 - u) ** 2 * self._slopes[number]
            - length * u * u * (1 - u) * self._slopes[number + 1]
        )
        return value[:-2], value[-2:]

    def presence(self, time: float) -> float:
        """How much it owns what it owns: nothing at both ends, all in between, 0 to 1."""
        share = min(time, self.duration - time) / self._fade if self._fade else 1.0
        share = min(max(share, 0.0), 1.0)
        return share * share * (3 - 2 * share)


def track_of(gesture: Gesture, model: FaceModel) -> Track:
    """A gesture for a face: what the face lacks is left out."""
    times = np.array([0.0, *gesture.times, gesture.duration])
    values = np.zeros((len(times), len(model.channels)))
    gaze = np.zeros((len(times), 2))
    for name, row in gesture.weights.items():
        if name in GAZE:
            gaze[1:-1, GAZE.index(name)] = row
        elif name in model.names:
            values[1:-1] += np.outer(row, model.vector({name: 1.0}))
        elif any(side in model.names for side in sides_of(name)):
            there = {side: 1.0 for side in sides_of(name) if side in model.names}
            values[1:-1] += np.outer(row, model.vector(there))
    owned = by_region(model.channels, dict.fromkeys(gesture.owns, 1.0))
    return Track(times, values, gaze, owned)


def _monotone_slopes(times: Values, values: Numbers) -> Numbers:
    """The slope at each keyframe: none at ends and turning points, else the harmonic mean."""
    slopes = np.zeros_like(values)
    lengths = np.diff(times)
    for column in range(values.shape[1]):
        # One by one: an hour of a face would fill the memory several times over.
        steps = np.diff(values[:, column]) / lengths
        before, after = steps[:-1], steps[1:]
        turns = before * after <= 0
        total = np.where(turns, 1.0, before + after)
        slopes[1:-1, column] = np.where(turns, 0.0, 2 * before * after / total)
    return slopes
