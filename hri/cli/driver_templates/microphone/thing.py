"""Your own microphone."""

import numpy as np

from hri.core.signals import Samples
from hri.hal import Microphone

PITCH = 440.0  # hertz
LOUDNESS = 3000.0


class Thing(Microphone):
    """Hears a tone; read the samples of your hardware instead."""

    parameters = ("rate",)

    def _open(self) -> None:
        # Open the hardware here; raise self.not_available(why, remedy) where it is missing.
        self.rate = self.description.count("rate", 16000, 8000, 48000)
        self._start, self._given = self.manager.clock.now(), 0

    def read(self, now: float) -> Samples:
        until = max(self._given, round((now - self._start) * self.rate))
        times = np.arange(self._given, until) / self.rate
        self._given = until
        return (LOUDNESS * np.sin(2 * np.pi * PITCH * times)).astype(np.int16)

    def _close(self) -> None:
        """Release the hardware here."""
