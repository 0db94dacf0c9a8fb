"""The level of speech above noise.

The ratio counts the power of the speech while it is active, so that pauses around a sentence do not
make it louder than it is: frames within `ACTIVE_DB` of the loudest one are active.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.bench.speech.flite_voices import RATE
from hri.core.signals import Samples

Sound = NDArray[np.float64]

FRAME = RATE // 100
ACTIVE_DB = 25.0
LOUDEST = 32000.0
"""A mixture that would be louder is made quieter as a whole."""


def frame_powers(sound: Sound) -> Sound:
    """Mean square of each 10 ms."""
    frames = sound[: len(sound) // FRAME * FRAME].reshape(-1, FRAME)
    return np.asarray(np.mean(frames**2, axis=1))


def active_power(sound: Sound) -> float:
    """Mean square of the active frames; 0 for silence."""
    powers = frame_powers(sound)
    if not len(powers) or powers.max() <= 0:
        return 0.0
    return float(powers[powers >= powers.max() * 10 ** (-ACTIVE_DB / 10)].mean())


def trimmed(sound: Sound) -> Sound:
    """From the first active frame to the last."""
    powers = frame_powers(sound)
    active = np.flatnonzero(powers >= powers.max() * 10 ** (-ACTIVE_DB / 10))
    return sound[active[0] * FRAME : (active[-1] + 1) * FRAME]


def above(speech: Samples, noise: Sound, ratio_db: float) -> Samples:
    """The speech over the noise, its active power `ratio_db` above the noise's mean power."""
    clean = speech.astype(np.float64)
    wanted = active_power(clean) / 10 ** (ratio_db / 10)
    mixture = clean + noise * np.sqrt(wanted / np.mean(noise**2))
    mixture *= min(1.0, LOUDEST / np.max(np.abs(mixture)))
    return np.asarray(mixture.astype(np.int16))
