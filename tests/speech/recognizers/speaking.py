"""Speech to recognize, without recordings."""

from __future__ import annotations

import numpy as np

from hri.core.signals import Samples
from hri.hal.drivers.resampling import resample
from hri.speech.synthesizers.espeak_library import Mark, Setting, load_espeak


def spoken(text: str, voice: str = "en-us") -> Samples:
    """A text in a synthetic voice, 16 kHz."""
    blocks: list[bytes] = []

    def take(sound: bytes, marks: list[Mark]) -> bool:
        blocks.append(sound)
        return True

    espeak = load_espeak()
    espeak.speak(text, Setting(voice=voice), take)
    return resample(np.frombuffer(b"".join(blocks), np.int16), espeak.rate, 16000)
