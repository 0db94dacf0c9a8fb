"""A small formant synthesizer for sounds that are not words.

A source of harmonics and of breath goes through the resonances of a vocal tract (D. Klatt,
"Software for a cascade/parallel formant synthesizer", JASA 67, 1980). The harmonics are drawn one
by one, so that pitch and shape may move as fast as in a laugh.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Sound = NDArray[np.float32]
Curve = NDArray[np.float64]

RATE = 24000
"""Samples a second."""
STEP_S = 0.005
"""Seconds from one frame of the tracks to the next."""
BANDWIDTHS = (80.0, 100.0, 150.0, 220.0, 300.0)
"""Hertz, of the five resonances."""
NASAL_POLE, NASAL_ZERO = (1050.0, 250.0), (750.0, 220.0)
"""Hertz and bandwidth of the resonance that an open nose adds, and of what the shut mouth takes."""
FOLD_HZ = 5500.0
"""Half of the rate at which five resonances fill a tract."""
FALLS = 1.5
"""Exponent by which its response falls above."""
HIGHEST_HZ = 8000.0
"""Above it no harmonic is drawn."""
AIR = 0.12
"""Of a breath of amplitude 1, against a voice of amplitude 1."""
AIR_FALLS_HZ, AIR_FALLS = 2000.0, 0.6
"""Above which, and by which exponent, the breath of a throat falls."""
TILT = {-1: 2.3, 0: 1.75, 1: 1.3}
"""Exponent by which the harmonics of a lax, a usual and a tense voice fall."""
JITTER, SHIMMER = 0.006, 0.05
"""Share by which pitch and loudness of a voice wander."""
WANDERS_S = 0.02
"""Seconds in which they do."""
PULSES = 0.5
"""By how much breath is louder while the glottis is open."""
HISS, HISS_OCTAVES = 5.0, 0.45
"""Amplitude of a hiss at its loudest, and half of its width."""
EDGE_S = 0.008
"""Seconds in which the sound comes and goes at its ends."""
_FFT, _HOP = 480, 120


@dataclass(frozen=True, slots=True)
class Tracks:
    """A sound by frames of STEP_S."""

    pitch: Curve
    """Hertz."""
    voice: Curve
    """Amplitude of the harmonics, 0 to 1."""
    air: Curve
    """Amplitude of the breath, 0 to 1."""
    formants: NDArray[np.float64]
    """Hertz of five resonances, by frames."""
    nose: Curve
    """How far the sound goes through the nose, 0 to 1."""
    hiss: Curve
    """How far the breath is a hiss between the teeth, 0 to 1."""
    hiss_hz: Curve
    """Where that is loudest."""
    tension: Curve
    """-1 (lax) to 1 (pressed)."""


def sounded(tracks: Tracks, seed: int) -> Sound:
    """The sound of tracks, as loud as they say; the same seed gives the same sound."""
    chance = np.random.default_rng(seed)
    count = round(len(tracks.pitch) * STEP_S * RATE)
    sound = _voiced(tracks, count, chance) + _breathed(tracks, count, chance)
    edge = min(round(EDGE_S * RATE), count // 2)
    ramp = np.linspace(0.0, 1.0, edge, endpoint=False)
    sound[:edge] *= ramp
    sound[count - edge :] *= ramp[::-1]
    return sound.astype(np.float32)


def _voiced(tracks: Tracks, count: int, chance: np.random.Generator) -> Curve:
    """The harmonics."""
    frames = len(tracks.pitch)
    pitch = tracks.pitch * (1.0 + JITTER * _wandering(frames, chance))
    level = tracks.voice * (1.0 + SHIMMER * _wandering(frames, chance))
    phase = 2.0 * np.pi * np.cumsum(_drawn(pitch, count)) / RATE
    tilt = np.interp(tracks.tension, list(TILT), list(TILT.values()))
    sound = np.zeros(count)
    for number in range(1, int(HIGHEST_HZ / max(float(pitch.min()), 40.0)) + 1):
        hertz = number * pitch
        if not (is_drawn := (hertz < HIGHEST_HZ) & (level > 0)).any():
            break
        response = _response(hertz[None], tracks)[0]
        amplitude = np.where(is_drawn, level * number**-tilt * np.abs(response), 0.0)
        turned = np.unwrap(np.angle(response))
        sound += _drawn(amplitude, count) * np.sin(number * phase + _drawn(turned, count))
    return sound


def _breathed(tracks: Tracks, count: int, chance: np.random.Generator) -> Curve:
    """Noise through the same tract."""
    if not tracks.air.any():
        return np.zeros(count)
    phase = 2.0 * np.pi * np.cumsum(_drawn(tracks.pitch, count)) / RATE
    pulsing = 1.0 + PULSES * _drawn(np.minimum(tracks.voice, 1.0), count) * np.cos(phase)
    noise = AIR * chance.standard_normal(count) * pulsing * _drawn(tracks.air, count)
    padded = np.pad(noise, (_FFT, 2 * _FFT))
    window = np.hanning(_FFT + 1)[:-1]
    starts = np.arange(0, len(padded) - _FFT, _HOP)
    pieces = np.fft.rfft(np.lib.stride_tricks.sliding_window_view(padded, _FFT)[starts] * window)
    hertz: Curve = np.fft.rfftfreq(_FFT, 1.0 / RATE).astype(np.float64)
    at = np.clip((starts + _FFT / 2 - _FFT) / RATE / STEP_S, 0, len(tracks.pitch) - 1)
    here = _at(tracks, at.round().astype(np.int64))
    tract = np.abs(_response(hertz[:, None], here))
    tract *= np.minimum(AIR_FALLS_HZ / np.maximum(hertz[:, None], 1.0), 1.0) ** AIR_FALLS
    response = ((1.0 - here.hiss) * tract + here.hiss * _hissing(hertz, here)).T
    shaped = np.fft.irfft(pieces * response, _FFT) * window
    sound = np.zeros(len(padded))
    for start, piece in zip(starts, shaped, strict=True):
        sound[start : start + _FFT] += piece
    overlapping = float((window**2).sum()) / _HOP
    heard: Curve = sound[_FFT : _FFT + count] / overlapping
    return heard


def _at(tracks: Tracks, frames: NDArray[np.int64]) -> Tracks:
    """Some of the frames."""
    return Tracks(
        tracks.pitch[frames],
        tracks.voice[frames],
        tracks.air[frames],
        tracks.formants[:, frames],
        tracks.nose[frames],
        tracks.hiss[frames],
        tracks.hiss_hz[frames],
        tracks.tension[frames],
    )


def _response(hertz: NDArray[np.float64], tracks: Tracks) -> NDArray[np.complex128]:
    """What the tract makes of a frequency; rows of frequencies by frames."""
    response = np.ones(np.broadcast_shapes(hertz.shape, tracks.pitch.shape), np.complex128)
    for center, width in zip(tracks.formants, BANDWIDTHS, strict=True):
        response *= _resonance(hertz, center, width)
    nasal = _resonance(hertz, *NASAL_POLE) / _resonance(hertz, *NASAL_ZERO)
    above = (np.maximum(hertz, FOLD_HZ) / FOLD_HZ) ** -FALLS
    shaped: NDArray[np.complex128] = response * above * (1.0 - tracks.nose + tracks.nose * nasal)
    return shaped


def _resonance(
    hertz: NDArray[np.float64], center: Curve | float, width: float
) -> NDArray[np.complex128]:
    """Klatt's digital resonator, with a gain of 1 at 0 Hz."""
    radius = np.exp(-np.pi * width / (2.0 * FOLD_HZ))
    b = 2.0 * radius * np.cos(np.pi * np.minimum(center, FOLD_HZ) / FOLD_HZ)
    c = -(radius**2)
    z = np.exp(-1j * np.pi * np.minimum(hertz, FOLD_HZ) / FOLD_HZ)
    gain: NDArray[np.complex128] = (1.0 - b - c) / (1.0 - b * z - c * z**2)
    return gain


def _hissing(hertz: NDArray[np.float64], tracks: Tracks) -> NDArray[np.float64]:
    """The spectrum of a hiss: HISS_OCTAVES wide, rows of frequencies by frames."""
    octaves = np.log2(np.maximum(hertz[:, None], 1.0) / np.maximum(tracks.hiss_hz, 1.0))
    shape: NDArray[np.float64] = HISS * np.exp(-0.5 * (octaves / HISS_OCTAVES) ** 2)
    return shape


def _drawn(track: Curve, count: int) -> Curve:
    """A track at each sample."""
    return np.interp(np.arange(count) / RATE / STEP_S, np.arange(len(track)) + 0.5, track)


def _wandering(frames: int, chance: np.random.Generator) -> Curve:
    """A slow noise of unit variance."""
    width = max(round(WANDERS_S / STEP_S), 1)
    noise = chance.standard_normal(frames + width)
    smooth: Curve = np.convolve(noise, np.ones(width) / np.sqrt(width), "valid")[:frames]
    return smooth
