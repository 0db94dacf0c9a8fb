"""How far a mouth opens for how loud the voice is: soft speech opens it less, a shout more."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Samples

Values = NDArray[np.float64]

STEP = 0.02
"""Seconds between two values."""
AROUND = 0.3
"""Seconds of sound that each value is read from: about a syllable and its neighbors, so that the
jaw follows how loud one speaks, not each consonant."""
USUAL_DB = -20.5
"""Of full scale: the median of vowels in the natural voice and in espeak-ng, within 1 dB."""
PER_DB = 0.03
"""How much farther the mouth opens: half the amplitude makes 0.82, twice the amplitude 1.18."""
LEAST, MOST = 0.7, 1.25
"""Factors on the opening."""
SILENCE = 30.0
"""Of 32767, root mean square: what is never louder has no loudness to follow."""


class Loudness:
    """Factors on the opening of the mouth over a speech."""

    def __init__(self, samples: Samples, rate: int) -> None:
        """`rate` is in samples a second. Without any sound the factor is 1."""
        self._factors = _factors(samples, rate)

    def at(self, times: Values) -> Values:
        """The factors at some times, seconds; smooth, LEAST to MOST."""
        if not len(self._factors):
            return np.ones(len(times))
        middles = (np.arange(len(self._factors)) + 0.5) * STEP
        return np.interp(times, middles, self._factors)


def _factors(samples: Samples, rate: int) -> Values:
    size = max(1, round(STEP * rate))
    count = len(samples) // size
    blocks = samples[: count * size].reshape(count, size)
    power = np.einsum("ij,ij->i", blocks, blocks, dtype=np.float64) / size
    if power.max(initial=0.0) < SILENCE**2:
        return np.zeros(0)
    window = np.hanning(round(AROUND / STEP) + 2)[1:-1]
    around = np.convolve(power, window / window.sum())[len(window) // 2 :][:count]
    decibels = 10 * np.log10(np.maximum(around, 1.0) / 32768**2)
    factors: Values = np.clip(1 + PER_DB * (decibels - USUAL_DB), LEAST, MOST)
    return factors
