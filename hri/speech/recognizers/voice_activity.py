"""WebRTC's voice activity detector, as PocketSphinx carries it."""

from __future__ import annotations

from pocketsphinx import Vad

from hri.core.signals import Samples
from hri.speech.endpoint import FRAME, IsVoice

MODE = Vad.MEDIUM_LOOSE
"""How sure it must be: of 150 recorded digits this misses 1, the next stricter one 15. Steady noise
that it takes for a voice does not stand out of the noise."""


def voice_detector(rate: int) -> IsVoice:
    """A detector for sound of 8, 16, 32 or 48 kHz. It learns the noise, so each stream has one."""
    detector = Vad(MODE, rate, FRAME)

    def is_voice(frame: Samples) -> bool:
        return bool(detector.is_speech(frame.tobytes()))

    return is_voice
