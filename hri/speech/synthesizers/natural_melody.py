"""The pitch of the natural voice, bent at the ends of phrases: a question rises.

The network ends questions as statements. A tone replaces the last part of its curve by a line to
where the phrase should end, of which the curve's own small ups and downs are kept.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hri.speech.notation.intonation import Tone

Curve = NDArray[np.float32]
"""Hertz, by frames."""

FRAME_S = 0.0125
REACH_S = 0.35
"""Seconds of a phrase's last voice that a tone bends."""
KEPT = 0.3
"""Share of the curve's own ups and downs around the line."""
GRIP = 0.35
"""Share of the reach after which the curve follows the line alone."""
SEMITONE = np.log(2.0) / 12.0
LOUD_DB = 22.0
"""Below the loudest frame, up to which a frame carries the melody."""
LIFTED_DB, MOST_LIFT_DB = 8.0, 10.0
"""Below the loudest frame, where the end of a question is lifted to, and by how much at most."""
RELEASE = 8
"""Frames in which a phrase that follows without a pause comes back to its own pitch."""
LATEST_PEAK = 0.6
"""Share of the reach up to which an accent leaves the fall after it enough time to be heard."""
ACCENT_SEMITONES, ACCENT_DB, ACCENT_SLOWER = 4.0, 3.0, 0.25
"""By how much what has all the weight is higher, louder, and longer."""
ABOVE, MOST_RAISED = 1.0, 8.0
"""Semitones above the highest of the phrase that it reaches, if it takes no more than so many."""
ACCENT_EDGE = 8
"""Frames in which an accent comes and goes."""
AFTER_ACCENT, LOWERED = 0.7, 1.5
"""How flat a phrase is after its accent, 0 to 1, and how many semitones below its middle."""
EDGE = 2
"""Frames at each end of a voice."""
LEAST = 0.5
"""Of the middle of the pitch: what is lower has hardly any voice."""
SINKS = 5.0
"""Semitones a second by which a fall goes on where the curve would rise."""
SMOOTH = 5
"""Frames over which that changes."""
VOICED_HZ = 40.0
"""Frames with a lower pitch have no voice."""


class Phrase(NamedTuple):
    """A phrase in frames."""

    begin: int
    end: int
    tone: Tone


class _Bend(NamedTuple):
    """Where a tone leads, in semitones."""

    start: float
    """From the middle of the phrase: it sets out from there, or from the curve if that is lower."""
    by: float
    """From the start."""
    low: float = inf
    """From the middle of the phrase: it ends no higher."""


_BENDS = {
    Tone.RISE: _Bend(1.0, 6.5),
    Tone.CONTINUE: _Bend(0.5, 2.5),
    Tone.LEVEL: _Bend(0.0, 0.0),
    Tone.FALL: _Bend(inf, -3.0, -4.0),
    Tone.STRONG_FALL: _Bend(inf, -5.0, -5.0),
}
WIDER = 1.25
"""Of the range of a phrase that is exclaimed."""


def bent(pitch: Curve, is_loud: NDArray[np.bool_], phrases: Sequence[Phrase]) -> Curve:
    """The curve with the tones of its phrases; frames without voice stay as they are.

    `is_loud` says which frames are loud enough to carry a tone: it must not end in what dies away.
    """
    has_voice = pitch > VOICED_HZ
    is_sure = _inner(has_voice)
    if is_sure.any():
        is_sure &= pitch > LEAST * np.median(pitch[is_sure])
    semitones = np.log(np.maximum(pitch, 1.0).astype(np.float64)) / SEMITONE
    changed = np.zeros(len(pitch), bool)
    for begin, end, tone in phrases:
        loud = begin + np.flatnonzero((is_loud & is_sure)[begin:end])
        frames = begin + np.flatnonzero(is_sure[begin : loud[-1] + 1]) if len(loud) else loud
        if len(frames) > 2:
            tail = np.arange(max(begin, frames[-1] - round(REACH_S / FRAME_S)), end)
            curve = _bent(semitones[frames], frames, tone)
            last = semitones[end - 1]
            semitones[tail] = np.interp(tail, frames, curve)
            semitones[frames] = curve
            after = np.arange(end, min(end + RELEASE, len(pitch)))
            semitones[after] += (semitones[end - 1] - last) * (
                1 - (after - end + 1) / (RELEASE + 1)
            )
            changed[tail] = changed[frames] = changed[after] = True
    bent = np.maximum(np.exp(semitones * SEMITONE), VOICED_HZ + 1)
    return np.where(changed & has_voice, bent, pitch).astype(np.float32)


def weighted(
    starts: NDArray[np.float64], accents: Sequence[tuple[int, int, float]], frames: int
) -> NDArray[np.float64]:
    """The weight of each frame, -1 to 1, that comes and goes softly with the accents.

    `starts` are the frames in which the symbols begin; an accent has its first symbol, its last +
    1, and its weight.
    """
    weights = np.zeros(frames)
    for begin, end, weight in accents:
        first, last = round(float(starts[begin])), round(float(starts[end]))
        weights[max(first, 0) : max(last, 0)] = weight
    if not accents:
        return weights
    window = np.hanning(ACCENT_EDGE + 2)[1:-1]
    padded = np.pad(weights, ACCENT_EDGE // 2, mode="edge")
    return np.convolve(padded, window / window.sum(), "valid")[:frames]


def accented(pitch: Curve, weights: NDArray[np.float64], phrases: Sequence[Phrase]) -> Curve:
    """The curve with accents on what has weight, and flatter behind them, to the end of the phrase.

    What follows the focus of a sentence has no accents (D. R. Ladd, "Intonational
    Phonology", 2008, chapter 6): else the one would not stand out.
    """
    if not weights.any():
        return pitch
    semitones = np.log(np.maximum(pitch, 1.0).astype(np.float64)) / SEMITONE
    has_voice = pitch > VOICED_HZ
    for begin, end, _ in phrases:
        voiced = begin + np.flatnonzero(has_voice[begin:end])
        if not len(voiced):
            continue
        curve, weight = semitones[voiced], weights[voiced]
        middle = float(np.median(curve))
        strongest = max(float(weight.max()), 0.0)
        heavy = np.flatnonzero(weight > 0.5 * strongest) if strongest else voiced[:0]
        own = float(curve[heavy].max()) if len(heavy) else middle
        missing = float(np.percentile(curve, 95)) + ABOVE - own
        lift = min(max(ACCENT_SEMITONES, missing), MOST_RAISED)
        raised = curve + lift * np.maximum(weight, 0.0)
        flat = np.maximum(-weight, 0.0)
        if len(heavy):
            after = np.clip((np.arange(len(curve)) - heavy[-1]) / ACCENT_EDGE, 0.0, 1.0)
            flat = np.maximum(flat, AFTER_ACCENT * strongest * after)
        low = np.minimum(curve, middle - LOWERED)
        semitones[voiced] = raised + flat * (low - raised)
    changed = np.maximum(np.exp(semitones * SEMITONE), VOICED_HZ + 1)
    return np.where(has_voice, changed, pitch).astype(np.float32)


def _inner(has_voice: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The voice without its edges, where the curve comes from 0 and goes there."""
    padded = np.pad(has_voice, EDGE, mode="edge")
    inner = has_voice.copy()
    for shift in range(2 * EDGE + 1):
        inner &= padded[shift : shift + len(has_voice)]
    return inner


def falling(is_loud: NDArray[np.bool_], phrases: Sequence[Phrase]) -> NDArray[np.float64]:
    """1 for the frames in which a phrase falls to its end, else 0."""
    falls = np.zeros(len(is_loud))
    for begin, end, tone in phrases:
        loud = begin + np.flatnonzero(is_loud[begin:end])
        if tone in (Tone.FALL, Tone.STRONG_FALL) and len(loud):
            falls[max(begin, loud[-1] - round(REACH_S / FRAME_S)) : end] = 1.0
    return falls


def lifted(loudness: NDArray[np.float64], phrases: Sequence[Phrase]) -> NDArray[np.float64]:
    """Decibels to add to each frame: the last syllable of a question must not die away."""
    gain = np.zeros(len(loudness))
    for begin, end, tone in phrases:
        if tone is Tone.RISE and end > begin:
            level = loudness[begin:end]
            heard = np.flatnonzero(level > level.max() - LOUD_DB)
            first = max(heard[-1] + 1 - round(REACH_S / FRAME_S), 0)
            window = slice(begin + first, begin + heard[-1] + 1)
            missing = np.clip(level.max() - LIFTED_DB - loudness[window], 0.0, MOST_LIFT_DB)
            around = np.pad(missing, SMOOTH // 2, mode="edge")
            gain[window] = np.convolve(around, np.ones(SMOOTH) / SMOOTH, "valid")
    return gain


def _bent(curve: NDArray[np.float64], frames: NDArray[np.int64], tone: Tone) -> NDArray[np.float64]:
    """The voice of a phrase, in semitones."""
    middle, bend = float(np.median(curve)), _BENDS[tone]
    if tone is Tone.STRONG_FALL:
        curve = middle + WIDER * (curve - middle)
    last = frames > frames[-1] - REACH_S / FRAME_S
    own, time = curve[last], frames[last] - frames[last][0]
    if len(own) < 3:
        return curve
    share = time / time[-1]
    start = min(own[0], middle + bend.start)
    end = min(start + bend.by, middle + bend.low)
    slope, base = np.polyfit(share, own, 1)
    line = start + (end - start) * share + KEPT * (own - base - slope * share)
    is_falling = tone in (Tone.FALL, Tone.STRONG_FALL)
    peak = int(own.argmax())
    if is_falling and share[peak] < LATEST_PEAK and own[peak:].min() <= end + 1.0:
        line = own  # It falls by itself.
    grip = np.minimum(share / GRIP, 1.0)
    changed = curve.copy()
    changed[last] = (1.0 - grip) * own + grip * line
    return _settled(changed, last) if is_falling else changed


def _settled(curve: NDArray[np.float64], last: NDArray[np.bool_]) -> NDArray[np.float64]:
    """A curve of which the last part does not rise again: the network's often does, a little."""
    settled = curve.copy()
    part = settled[last]
    peak = int(part.argmax())
    lowest = np.minimum.accumulate(part[peak:])
    part[peak:] = lowest - SINKS * np.arange(len(lowest)) * FRAME_S * (part[peak:] > lowest)
    settled[last] = np.concatenate([part[:peak], np.minimum.accumulate(part[peak:])])
    return settled
