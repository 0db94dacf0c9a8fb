"""A microphone that is fed by a network, with the sound of another robot for example."""

from __future__ import annotations

import threading

import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Samples, SoundWindow
from hri.hal.microphone import LONGEST_BACKLOG, Microphone

LONGEST_GAP = 1.0
"""Seconds that were missed and are heard as silence; after more it begins again."""


class FedMicrophone(Microphone):
    """Hears windows of sound in the order of their ends, each sample once."""

    parameters = ("rate",)

    def _open(self) -> None:
        self.rate = self.description.count("rate", 16000, 1000, 400_000)
        self._guard = threading.Lock()
        self._sound: Samples = np.zeros(0, np.int16)
        self._end: int | None = None

    def feed(self, window: SoundWindow) -> None:
        """Take what is new in a window. Raises HriError for one that is not sound of its rate."""
        samples = window.samples
        if window.rate != self.rate or samples.ndim != 1 or samples.dtype != np.int16:
            what = f"{samples.dtype} of {window.rate} Hz with {samples.ndim} dimensions"
            raise HriError(f"{self.id} hears int16 of {self.rate} Hz with one, not {what}")
        with self._guard:
            new = len(samples) if self._end is None else window.end - self._end
            self._end = window.end
            if not 0 <= new <= len(samples) + LONGEST_GAP * self.rate:
                new = len(samples)
            missed = np.zeros(max(new - len(samples), 0), np.int16)
            heard = samples[len(samples) - min(new, len(samples)) :]
            most = round(LONGEST_BACKLOG * self.rate)
            self._sound = np.concatenate([self._sound, missed, heard])[-most:]

    def read(self, now: float) -> Samples:
        with self._guard:
            heard, self._sound = self._sound, np.zeros(0, np.int16)
        return heard
