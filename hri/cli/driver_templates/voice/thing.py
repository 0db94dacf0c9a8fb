"""Your own voice."""

import numpy as np

from hri.core import Prosody, Speech
from hri.hal import Synthesizer
from hri.hal.synthesizer import PLAIN

LETTER = 0.08  # seconds
LOUDNESS = 6000.0


class Thing(Synthesizer):
    """Hums for each letter; let your engine speak instead.

    With the times of phonemes in the Speech the lips follow them, else the loudness.
    """

    parameters = ("pitch",)
    rate = 22050

    def _open(self) -> None:
        # Open the engine here; raise self.not_available(why, remedy) where it is missing.
        self._pitch = self.description.number_within("pitch", 200.0, 50.0, 1000.0)

    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        # It runs aside, and may be called from several threads.
        seconds = LETTER * len(text) / prosody.rate
        times = np.arange(round(seconds * self.rate)) / self.rate
        hum = LOUDNESS * np.sin(2 * np.pi * self._pitch * prosody.pitch * times)
        return Speech(text, hum.astype(np.int16), self.rate)

    def _close(self) -> None:
        """Release the engine here."""
