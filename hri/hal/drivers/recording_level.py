"""The level of a whole recording, and a quiet one as loud as a usual voice."""

from __future__ import annotations

import math

import numpy as np

from hri.core.signals import Samples

QUIET_DB = -40.0
"""Level of the loudest tenth of a second, dB against full scale, below which one is amplified."""
USUAL_DB = -25.0
"""The same of a voice of usual loudness."""
MOST_DB = 60.0
SILENCE_DB = -120.0
TENTH = 0.1
"""Seconds."""


def loudest(samples: Samples, rate: int) -> float:
    """The level of the loudest tenth of a second: dB against full scale, -120 for silence."""
    size = max(1, round(TENTH * rate))
    whole = samples if len(samples) < size else samples[: len(samples) // size * size]
    if not len(whole):
        return SILENCE_DB
    moments = whole.reshape(-1, min(size, len(whole)))
    power = float(np.var(moments, axis=1, dtype=np.float64).max()) / 32768.0**2
    return max(SILENCE_DB, 10.0 * math.log10(power)) if power else SILENCE_DB


def audible(samples: Samples, rate: int) -> tuple[Samples, float]:
    """A recording as loud as a usual voice if it is quiet, else as it is; and the gain, dB."""
    level = loudest(samples, rate)
    if not SILENCE_DB < level < QUIET_DB:
        return samples, 0.0
    peak = int(np.abs(samples.astype(np.int32)).max())
    gain = min(10.0 ** (min(USUAL_DB - level, MOST_DB) / 20.0), 32767.0 / peak)
    return np.rint(samples * gain).astype(np.int16), 20.0 * math.log10(gain)
