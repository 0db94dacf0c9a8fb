"""The quality of the natural voice: breath, tension, tremble, smile and onset, in its spectra.

What each does to the sound of a voice: C. Gobl and A. Ni Chasaide, "The role of voice quality in
communicating emotion, mood and attitude", Speech Communication 40 (2003); for the smile V. C.
Tartter, "Happy talk", Perception & Psychophysics 27 (1980): the lips drawn apart shorten the tract,
so that its resonances rise.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import VoiceQuality
from hri.speech.synthesizers.natural_melody import FRAME_S, LOUD_DB, VOICED_HZ, Curve, Phrase

Spectrum = NDArray[np.float32]
"""Logarithms of magnitudes, bins by frames."""

BREATH_DB = -4.0
"""Noise of full breath, of the harmonics at BREATH_HZ."""
HISS_FROM_HZ = 2000.0
"""Voices have nearly all of their energy below it, hisses above."""
BREATH_HZ, BREATH_FROM_HZ = 2000.0, 900.0
"""Around and above which the noise of breath lies."""
BREATH_RISE_DB = 3.5
"""An octave: the noise of the glottis is flatter than its pulses."""
BREATH_MOST_DB = 3.0
"""Above the harmonics, at most."""
SHARP_DB, SOFT_DB = 3.5, 4.5
"""An octave above TILT_HZ: the gain of full tension, and the loss of a lax voice."""
TILT_HZ = 500.0
TILT_OCTAVES = 3.0
"""Above TILT_HZ, after which the tilt goes no further."""
SMILE = 0.06
"""Share by which a full smile raises the resonances."""
TREMBLE_HZ = (5.7, 8.3)
"""Two shakes, whose sum does not sound like singing."""
TREMBLE_SEMITONES, TREMBLE_DB = 0.7, 1.5
ONSET_S = {-1: 0.16, 1: 0.08}
"""Seconds after which a soft, and a hard, onset is over."""
ONSET_DB = {-1: -12.0, 1: 3.5}
DECIBELS = 20.0 / np.log(10.0)
"""Decibels of a factor e."""


def voicing(harmonic: Spectrum, rest: Spectrum, bin_hz: float) -> Curve:
    """How much each frame is voice, 0 (a hiss) to 1: the share of its energy below HISS_FROM_HZ."""
    split = round(HISS_FROM_HZ / bin_hz)
    low, high = (
        sum(np.exp(2.0 * np.minimum(part[bins], 7.0)).sum(axis=0) for part in (harmonic, rest))
        for bins in (slice(0, split), slice(split, None))
    )
    share: Curve = (low / np.maximum(low + high, 1e-12)).astype(np.float32)
    return share


def tilted(tension: float, voicing: Curve, bins: int, bin_hz: float) -> Spectrum:
    """What tension, -1 to 1, adds to the logarithm of each bin of each frame."""
    octaves = np.clip(np.log2(_hertz(bins, bin_hz) / TILT_HZ), 0.0, TILT_OCTAVES)
    slope = tension * (SHARP_DB if tension > 0 else SOFT_DB)
    return np.outer(slope * octaves / DECIBELS, voicing).astype(np.float32)


def smiling(harmonic: Spectrum, smile: float) -> Spectrum:
    """An envelope, drawn through all frequencies, with its resonances moved by a smile, -1 to 1."""
    bins = len(harmonic)
    places = np.minimum(np.arange(bins) / (1.0 + SMILE * smile), bins - 1.001)
    below = places.astype(np.int64)
    share = (places - below).astype(np.float32)[:, None]
    moved: Spectrum = (1 - share) * harmonic[below] + share * harmonic[below + 1]
    return moved


def breathed(
    noise: Spectrum, envelope: Spectrum, voicing: Curve, breath: float, bin_hz: float
) -> Spectrum:
    """Noise with the breath, 0 to 1, of a voice of this envelope added."""
    hertz = _hertz(len(noise), bin_hz)
    level = np.minimum(BREATH_DB + BREATH_RISE_DB * np.log2(hertz / BREATH_HZ), BREATH_MOST_DB)
    level -= 12.0 * np.maximum(np.log2(BREATH_FROM_HZ / hertz), 0.0)
    air = np.exp(2.0 * np.minimum(envelope + (level / DECIBELS)[:, None], 7.0))
    louder = np.exp(2.0 * np.minimum(noise, 7.0)) + (breath * voicing) ** 2 * air
    breathy: Spectrum = (0.5 * np.log(louder)).astype(np.float32)
    return breathy


def _hertz(bins: int, bin_hz: float) -> NDArray[np.float64]:
    """The frequency of each bin."""
    hertz: NDArray[np.float64] = np.maximum(np.arange(bins) * bin_hz, 1.0)
    return hertz


def trembling(pitch: Curve, tremble: float) -> Curve:
    """A curve of the pitch that shakes, 0 to 1."""
    shaken = pitch * np.exp2(TREMBLE_SEMITONES * tremble * _shake(len(pitch)) / 12.0)
    return np.where(pitch > VOICED_HZ, np.maximum(shaken, VOICED_HZ + 1), pitch).astype(np.float32)


def loudened(
    loudness: NDArray[np.float64], phrases: Sequence[Phrase], quality: VoiceQuality
) -> NDArray[np.float64]:
    """Decibels to add to each frame for the tremble and for the onsets of the phrases."""
    gain = TREMBLE_DB * quality.tremble * np.roll(_shake(len(loudness)), 2)
    sign = 1 if quality.onset > 0 else -1
    if quality.onset:
        for begin, end, _ in phrases:
            heard = np.flatnonzero(loudness[begin:end] > loudness.max() - LOUD_DB)
            if len(heard):
                after = np.arange(begin + heard[0], end)
                share = np.maximum(1 - (after - after[0]) * FRAME_S / ONSET_S[sign], 0.0)
                gain[after] += ONSET_DB[sign] * abs(quality.onset) * share
    return gain


def _shake(frames: int) -> NDArray[np.float64]:
    """Between -1 and 1, always the same."""
    time = np.arange(frames) * FRAME_S
    slow, quick = (np.sin(2 * np.pi * hertz * time) for hertz in TREMBLE_HZ)
    shake: NDArray[np.float64] = 0.65 * slow + 0.35 * quick
    return shake
