"""Sound as a value of a port: windows of the latest samples, each overlapping the one before."""

from __future__ import annotations

import numpy as np

from hri.core.signals import Samples, SoundWindow

WINDOW = 0.2
"""Seconds of a window."""


class SoundTrail:
    """Makes windows of sound that comes piece by piece."""

    def __init__(self, rate: int) -> None:
        """`rate` is in samples a second."""
        self._rate = rate
        self._samples: Samples = np.zeros(0, np.int16)
        self._end = 0

    def after(self, samples: Samples) -> SoundWindow:
        """The window that ends with these samples."""
        most = round(WINDOW * self._rate)
        self._samples = np.concatenate([self._samples, samples])[-most:]
        self._end += len(samples)
        return SoundWindow(self._samples, self._rate, self._end)
