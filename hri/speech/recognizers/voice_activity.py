"""WebRTC's voice activity detector."""

from __future__ import annotations

from webrtcvad import Vad

from hri.core.signals import Samples
from hri.speech.endpoint import IsVoice

MODE = 1
"""How sure it must be, 0 to 3: of 150 recorded digits this misses 1, the next stricter one 15.
Steady noise that it takes for a voice does not stand out of the noise."""


def voice_detector(rate: int) -> IsVoice:
    """A detector for sound of 8, 16, 32 or 48 kHz. It learns the noise, so each stream has one."""
    detector = Vad(MODE)

    def is_voice(frame: Samples) -> bool:
        return bool(detector.is_speech(frame.tobytes(), rate))

    return is_voice
