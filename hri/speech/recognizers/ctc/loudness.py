"""How loud the parts of a piece of speech are: the noise under it, and the silence around it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Samples
from hri.speech.recognizers.ctc.features import Sound

_RATE = 16000
_FRAME = _RATE // 100
"""Samples of 10 ms."""
QUIET_DB, LOUD_DB = 30.0, 20.0
"""From the softest to the loudest tenth of a piece: no noise to speak of, and much of it."""
ABOVE_DB, BELOW_DB = 12.0, 35.0
"""Sound is what is as far above the softest tenth, and not farther below the loudest."""
KEPT = _RATE // 10
"""Samples of silence that stay before and after."""
USUAL_DB = -32.0
"""Level against full scale to which quieter speech is amplified. Nobody in the recordings that the
network was measured with speaks more quietly, so all of them stay as they are.
"""
MOST_GAIN_DB = 60.0
ACTIVE_DB = 25.0
"""Speech is what is not farther below the loudest 10 ms of a piece."""
_FULL_SCALE_DB = 20.0 * np.log10(32768.0)


def speech_level(samples: Samples) -> float:
    """How loud someone speaks in a piece: dB against full scale, without the pauses; -120 for
    silence, and what is too short.
    """
    powers = _powers(samples)
    if not powers.any():
        return -120.0
    active = powers[powers >= powers.max() * 10.0 ** (-ACTIVE_DB / 10.0)]
    return float(10.0 * np.log10(active.mean()) - _FULL_SCALE_DB)


def leveled(samples: Samples) -> NDArray[np.float32]:
    """A piece of speech that is as loud as the network knows it: what is quieter is amplified."""
    gain_db = min(MOST_GAIN_DB, max(0.0, USUAL_DB - speech_level(samples)))
    return samples.astype(np.float32) * np.float32(10.0 ** (gain_db / 20.0))


def noise_of(sound: Sound) -> float:
    """How noisy a piece of speech is: 0 in a quiet room, 1 where others talk as well.

    By how far its soft parts lie below its loud ones. `sound` is 16 kHz, `leveled`.
    """
    levels = _levels(sound)
    if not len(levels):
        return 0.0
    soft, loud = np.quantile(levels, (0.1, 0.9))
    return float(np.clip((QUIET_DB - (loud - soft)) / (QUIET_DB - LOUD_DB), 0.0, 1.0))


def sounding(sound: Sound) -> slice:
    """Where someone speaks in a piece, with a little silence around it; all of it in noise.

    The network was taught on little silence: with more, it hears the words less clearly (of 45
    commands in three synthetic voices 40 were accepted with 0.4 s of it, 45 with 0.1 s).
    """
    levels = _levels(sound)
    everything = slice(0, len(sound))
    if not len(levels):
        return everything
    soft, loud = np.quantile(levels, (0.1, 0.9))
    if loud - soft < LOUD_DB:
        return everything
    heard = np.flatnonzero(levels > max(soft + ABOVE_DB, loud - BELOW_DB))
    first, last = int(heard[0]), int(heard[-1])
    start = max(first * _FRAME - KEPT, 0)
    return slice(start, min((last + 1) * _FRAME + KEPT, len(sound)))


def _levels(sound: Sound) -> NDArray[np.float32]:
    """Of each 10 ms, decibels above one step of 16 bits."""
    return np.asarray(10.0 * np.log10(_powers(sound) + 1.0), np.float32)


def _powers(sound: Sound) -> NDArray[np.float32]:
    """Mean square of each 10 ms."""
    frames = sound[: len(sound) // _FRAME * _FRAME].reshape(-1, _FRAME).astype(np.float32)
    powers: NDArray[np.float32] = (frames**2).mean(axis=1)
    return powers
