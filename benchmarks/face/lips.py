"""How well the lips keep time with the voice, and show what matters, at the frames drawn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from benchmarks.face.sentences import SENTENCES
from hri.bench.table import Row, amount, at_least, at_most, share
from hri.core.clock import RealClock
from hri.core.signals import Prosody, Speech
from hri.face.animator import Animator
from hri.face.lips.lipsync import ROUND_LEAD, PhonemeTrack
from hri.face.lips.spans import CLOSED, ROUNDED, VisemeSpan, spoken
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
VOICES: tuple[tuple[type[Synthesizer], str, tuple[float, ...]], ...] = (
    (EspeakVoice, "espeak", (0.8, 1.0, 1.3)),
    (NaturalVoice, "natural voice", (1.0, 1.25)),
)
"""Each with its name, and the paces that it is measured at, 1 is the usual one."""
RATES = (30.0, 25.0)
"""Frames a second."""

CLOSURES, ROUNDINGS = "closures (p b m f v)", "rounded lips (sh ch j oo w)"
SEEN = {CLOSURES: 1.0, ROUNDINGS: 0.9}
"""The share of the sounds of each kind whose shape a frame must show."""
SHUT, SHUT_WITHIN = 0.9, 0.07
"""How near a mouth is to the shape that is shut, of the way from rest; and the seconds before its
end within which a short sound may be seen."""
ROUND = 0.8
"""How round lips are, of the shape of the sound."""
ROUNDING = ("mouthFunnel", "mouthPucker")
"""Channels of lips that are round, which every shape of ROUNDED has."""


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
    """Milliseconds between a sound and its shape, and how many of the shapes that matter are seen.

    Raises NotAvailable without the voice.
    """
    for kind, name, paces in VOICES:
        with ResourceManager((), RealClock()) as resources:
            voice = kind(Description("voice", kind.__name__), resources)
            resources.substitute("voice", voice)
            voice.activate()
            for pace in paces:
                prosody = Prosody(rate=pace)
                speeches = [voice.synthesize(sentence, prosody) for sentence in SENTENCES]
                said = f", {name}" + f" at pace {pace:g}" * (pace != 1)
                yield _timing(model, speeches, said)
                yield from _seen(model, speeches, said)


def _timing(model: FaceModel, speeches: Sequence[Speech], said: str) -> Row:
    timings = [lip_timing(model, speech) for speech in speeches]
    shapes = [error for timing in timings for error in timing.shapes]
    changes = [error for timing in timings for error in timing.changes]
    late = float(np.percentile(1e3 * np.abs(shapes), 95))
    told = {
        "sounds": len(shapes),
        "change_median_ms": round(1e3 * float(np.median(changes)), 1),
        "change_p95_ms": round(1e3 * float(np.percentile(np.abs(changes), 95)), 1),
    }
    return amount(WHAT + said, late, "ms", at_most(LATE_MS), **told)


def _seen(model: FaceModel, speeches: Sequence[Speech], said: str) -> Iterator[Row]:
    for rate in RATES:
        seen = [lips_seen(model, speech, rate, n % 4 / 4) for n, speech in enumerate(speeches)]
        for what, least in SEEN.items():
            all_seen = [each for one in seen for each in one[what]]
            yield share(
                f"{what} that a frame shows at {rate:g} Hz{said}",
                sum(all_seen),
                len(all_seen),
                at_least(least),
            )


def lips_seen(
    model: FaceModel, speech: Speech, rate: float = 30.0, phase: float = 0.0
) -> dict[str, list[bool]]:
    """Whether each closure and each rounding is seen in a frame, by the names in SEEN.

    All sounds of the voice count, those that the lips leave out as well. `phase` is when the first
    frame is drawn, of the time between two.
    """
    times, frames = _animated(model, speech, rate, phase=phase)
    seen: dict[str, list[bool]] = {what: [] for what in SEEN}
    for sound in spoken(speech.phonemes):
        shape = model.vector(model.viseme(sound.viseme)).astype(float)
        if sound.viseme in CLOSED:
            near = _between(times, min(sound.start, sound.end - SHUT_WITHIN), sound.end)
            lips = _channels(model, ("mouth", "jaw"))
            away = np.linalg.norm((frames[near] - shape)[:, lips], axis=1)
            nearness = 1 - away / np.linalg.norm(shape[lips])
            seen[CLOSURES].append(bool(nearness.max(initial=0.0) >= SHUT))
        elif sound.viseme in ROUNDED:
            near = _between(times, sound.start - ROUND_LEAD, sound.end)
            lips = _channels(model, ROUNDING)
            rounded = frames[near][:, lips].sum(axis=1) / shape[lips].sum()
            seen[ROUNDINGS].append(bool(rounded.max(initial=0.0) >= ROUND))
    return seen


def _between(times: Values, start: float, end: float) -> NDArray[np.bool_]:
    within: NDArray[np.bool_] = (start - 1e-9 <= times) & (times <= end + 1e-9)
    return within


def _channels(model: FaceModel, beginnings: tuple[str, ...]) -> NDArray[np.bool_]:
    return np.array([channel.startswith(beginnings) for channel in model.channels])


def _animated(
    model: FaceModel, speech: Speech, rate: float, ahead: float = 0.0, phase: float = 0.0
) -> tuple[Values, Values]:
    """The times of the frames, seconds, and their weights; `phase` is as in `lips_seen`."""
    animator = Animator(model, latency=ahead)
    animator.speak(speech)
    numbers = np.arange(-1 if phase else 0, round(speech.duration * rate))
    times = np.asarray((numbers + phase) / rate, np.float64)
    return times, np.array([animator.vector(time, 1 / rate, time) for time in times], float)


def lip_timing(
    model: FaceModel, speech: Speech, rate: float = 30.0, ahead: float = 0.0
) -> LipTiming:
    """Animate a face that says something at `rate` frames a second, and compare it with the sounds.

    A frame counts as seen when its time is heard. `ahead` is how many seconds the lips are read
    ahead for a display that is late; without such a display they are early by as much.
    """
    times, frames = _animated(model, speech, rate, ahead)
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
