"""Pink noise: as much power in each octave, like wind, traffic far off, and many fans."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from benchmarks.speech.levels import Sound
from hri.bench.speech.flite_voices import RATE
from hri.core.signals import Samples

LOWEST = 50.0
"""Hz: below it there is no more than at it."""


def pink(talkers: Sequence[Samples], length: int, chance: np.random.Generator) -> Sound:
    """`length` samples; nobody talks in it."""
    frequencies = np.maximum(np.fft.rfftfreq(length, 1 / RATE), LOWEST)
    spectrum = np.fft.rfft(chance.normal(size=length)) / np.sqrt(frequencies)
    return np.asarray(np.fft.irfft(spectrum, length), np.float64)
