"""How well the lips keep time with the voice, at the frames that are drawn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hri.bench.face.live import SENTENCES
from hri.bench.table import Row, amount, at_most
from hri.core.clock import RealClock
from hri.core.signals import Speech
from hri.face.animator import Animator
from hri.face.lips.lipsync import PhonemeTrack, VisemeSpan, spoken
from hri.face.model import FaceModel
from hri.face.regions import region_of
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import Synthesizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice

Values = NDArray[np.float64]
WHAT = "viseme track against phoneme times, p95"
LATE_MS = 20.0


@dataclass(frozen=True, slots=True)
class LipTiming:
    """Seconds, one for each shape that there is time for; above 0 is late, below 0 early."""

    shapes: list[float]
    """From the sound to the frame at which the mouth is nearest to its shape; 0 within the sound.
    This is the error: the shape is not there while its sound is heard."""
    changes: list[float]
    """From the time at which one sound turns into the next to the time at which the mouth is nearer
    to the next shape. Lips that close or round do so before the sound, on purpose."""


def rows(model: FaceModel) -> Iterator[Row]:
    """Milliseconds between a sound and its shape, and between changes of both.

    Raises NotAvailable without the voice.
    """
    yield from _rows_of(model, EspeakVoice, WHAT)
    yield from _rows_of(model, NaturalVoice, f"{WHAT}, natural voice")


def _rows_of(model: FaceModel, kind: type[Synthesizer], what: str) -> Iterator[Row]:
    shapes: list[float] = []
    changes: list[float] = []
    with ResourceManager((), RealClock()) as resources:
        voice = kind(Description("voice", kind.__name__), resources)
        resources.substitute("voice", voice)
        voice.activate()
        for sentence in SENTENCES:
            timing = lip_timing(model, voice.synthesize(sentence))
            shapes += timing.shapes
            changes += timing.changes
    late = float(np.percentile(1e3 * np.abs(shapes), 95))
    told = {
        "sounds": len(shapes),
        "change_median_ms": round(1e3 * float(np.median(changes)), 1),
        "change_p95_ms": round(1e3 * float(np.percentile(np.abs(changes), 95)), 1),
    }
    yield amount(what, late, "ms", at_most(LATE_MS), **told)


def lip_timing(
    model: FaceModel, speech: Speech, rate: float = 30.0, ahead: float = 0.0
) -> LipTiming:
    """Animate a face that says something at `rate` frames a second, and compare it with the sounds.

    A frame counts as seen when its time is heard. `ahead` is how many seconds the lips are read
    ahead for a display that is late; without such a display they are early by as much.
    """
    animator = Animator(model, latency=ahead)
    animator.speak(speech)
    times = np.arange(round(speech.duration * rate)) / rate
    frames = np.array([animator.vector(time, 1 / rate, time) for time in times], float)
    mouth = np.array([region_of(channel) == "mouth" for channel in model.channels])
    segments = PhonemeTrack(speech.phonemes).segments
    away = [_distances(model, segment, frames)[..., mouth].sum(axis=1) for segment in segments]
    sounds = list(spoken(speech.phonemes))
    return LipTiming(_shapes(segments, sounds, times, away), _changes(segments, times, away))


def _distances(model: FaceModel, segment: VisemeSpan, frames: Values) -> Values:
    """How far each channel of each frame is from a shape, squared."""
    shape = segment.strength * model.vector(model.viseme(segment.viseme)).astype(float)
    squares: Values = (frames - shape) ** 2
    return squares


def _shapes(
    segments: Sequence[VisemeSpan],
    sounds: Sequence[VisemeSpan],
    times: Values,
    away: Sequence[Values],
) -> list[float]:
    """Looked for no farther than the shapes before and after: beyond, it may come again."""
    errors = []
    for number, segment in enumerate(segments):
        begin = segments[max(number - 1, 0)].start
        end = segments[min(number + 1, len(segments) - 1)].end
        near = np.flatnonzero((begin <= times) & (times <= end))
        if segment.viseme == "sil" or not len(near):
            continue
        start, stop = _heard(segment, sounds)
        at = times[near[away[number][near] <= away[number][near].min() + 1e-9]]
        late = np.where(at > stop, at - stop, np.minimum(at - start, 0.0))
        errors.append(float(late[np.argmin(np.abs(late))]))
    return errors


def _heard(segment: VisemeSpan, sounds: Sequence[VisemeSpan]) -> tuple[float, float]:
    """From when to when the sounds of a shape are heard, as the voice gave the times.

    The shape itself may have been given time of neighbors that are too short to be seen.
    """
    own = [
        sound
        for sound in sounds
        if sound.viseme == segment.viseme
        and segment.start - 1e-9 <= (sound.start + sound.end) / 2 <= segment.end + 1e-9
    ]
    return own[0].start, own[-1].end


def _changes(segments: Sequence[VisemeSpan], times: Values, away: Sequence[Values]) -> list[float]:
    """Between the middles of two sounds, at the straight line through two frames."""
    changes = []
    for number, (one, other) in enumerate(pairwise(segments)):
        if "sil" in (one.viseme, other.viseme) or len(times) < 2:
            continue
        nearer = away[number] - away[number + 1]
        step = times[1] - times[0]
        begin, end = (one.start + one.end) / 2 - step, (other.start + other.end) / 2 + step
        turns = np.flatnonzero((nearer[:-1] < 0) & (nearer[1:] >= 0))
        turns = turns[(begin <= times[turns]) & (times[turns] <= end)]
        if len(turns):
            k = turns[0]
            at = times[k] + step * nearer[k] / (nearer[k] - nearer[k + 1])
            changes.append(float(at - other.start))
    return changes
