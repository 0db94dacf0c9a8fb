"""How loud it is at a microphone."""

from __future__ import annotations

import math

import numpy as np

from hri.core.signals import Samples
from hri.hal.audio_level import AudioLevel
from hri.hal.drivers.partner import use_partner
from hri.hal.microphone import Microphone

WINDOW = 0.1
"""Seconds of sound that count."""
STALE = 0.5
"""Seconds without any sound after which it is silent: the microphone is gone."""
FLOOR = -120.0
"""dBFS of digital silence."""


class MicrophoneLevel(AudioLevel):
    """Listens to any microphone, beside who else does."""

    parameters = ("microphone",)

    def _open(self) -> None:
        self._ear = use_partner(self, "microphone", Microphone).listen()
        self._window: Samples = np.zeros(round(WINDOW * self._ear.rate), np.int16)
        self._heard = -math.inf

    def level_dbfs(self, now: float) -> float:
        size = len(self._window)
        new = self._ear.read(now)
        if len(new):
            self._heard = now
        elif now - self._heard > STALE:
            new = np.zeros(size, np.int16)
        self._window = np.concatenate([self._window, new])[-size:]
        power = float(np.mean(self._window.astype(np.float64) ** 2)) / 32768**2
        return max(FLOOR, 10 * math.log10(power)) if power else FLOOR

    def _close(self) -> None:
        self._ear.close()
