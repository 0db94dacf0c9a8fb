"""Lips for a voice that gives no phoneme times: they follow its loudness and its brightness."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Samples

STEP = 0.02
"""Seconds between two values of the envelope."""
QUIET = 0.06
"""Of the loudest: below this the mouth stays shut."""
HISS_HZ = 2500.0
"""A sound that crosses zero as often as this tone is an s, with the teeth together."""


class EnvelopeTrack:
    """A mouth as open as the voice is loud."""

    def __init__(self, samples: Samples, rate: int) -> None:
        size = max(1, round(rate * STEP))
        count = len(samples) // size
        frames = samples[: count * size].reshape(count, size).astype(np.float64)
        loudness = np.sqrt((frames**2).mean(axis=1)) if count else np.zeros(0)
        full = np.percentile(loudness, 95) if count else 0.0
        level = np.clip(loudness / max(full, 1.0), 0, 1)
        level = np.where(level < QUIET, 0.0, level)
        crossings = (np.diff(np.signbit(frames), axis=1)).mean(axis=1) * rate / 2
        hiss = np.clip(crossings / HISS_HZ, 0, 1) if count else np.zeros(0)
        self._open = _calmed(level * (1 - 0.7 * hiss))
        self._hiss = _calmed(level * hiss)

    def weights(self, position: float) -> dict[str, float]:
        opening, hiss = self._at(self._open, position), self._at(self._hiss, position)
        shape = {"aa": 0.75 * opening**1.5, "E": 0.5 * opening, "SS": 0.6 * hiss}
        return {viseme: weight for viseme, weight in shape.items() if weight > 1e-3}

    def _at(self, values: NDArray[np.float64], position: float) -> float:
        """The value at a time, shut before the begin and after the end."""
        if not len(values):
            return 0.0
        times = (np.arange(-1, len(values) + 1) + 0.5) * STEP
        return float(np.interp(position, times, [0.0, *values, 0.0]))


def _calmed(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Smoothed over three steps, since lips are slower than a voice."""
    return np.convolve(values, [0.25, 0.5, 0.25], mode="same") if len(values) >= 3 else values
