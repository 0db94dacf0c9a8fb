"""Automatic gain for quiet sound, such as of a microphone that is turned down.

The loudest of late goes up to the level of a quiet voice, but never the noise above that of a quiet
room: in a room with noise, and after a voice of usual loudness, nothing is changed. The gain falls
at once where a sound would become too loud, and rises slowly: within an utterance it hardly
changes. While the robot speaks it only falls, and nothing is learned: what is left of its voice
does not say how loud others are, and must not become as loud as they are. A recording, all of which
is known, is amplified before (`hri.hal.drivers.recording_level`).
"""

from __future__ import annotations

import math

import numpy as np

from hri.core.signals import Samples

LOUD_DB = -40.0
"""dB against full scale up to which a stream is amplified: the loudest frames of a quiet voice.
With more, the talk of others before a voice would count as near.
"""
QUIET_ROOM_DB = -65.0
"""dB up to which noise is amplified: the least that counts as noise (`hri.speech.endpoint`)."""
MOST_DB = 40.0
"""Gain beyond which there is little but the steps of 16 bits."""
FALL, RISE = 0.04, 0.06
"""dB a frame by which the loudest of late is forgotten (2 dB/s), and by which noise may rise."""
SMOOTHING = 0.3
"""Share of a frame in the level of the noise."""
ZEROS_DB = -110.0
"""dB below which there is no sound at all: it says nothing of the noise."""
VERY_QUIET_DB = -60.0
"""dB against full scale below which a voice may be too quiet to be understood."""


def too_quiet(level_db: float | None) -> str:
    """What to tell of a voice that was not understood, by its level; "" for one loud enough."""
    if level_db is None or level_db >= VERY_QUIET_DB:
        return ""
    if level_db <= ZEROS_DB:
        return "no sound at all - unmute the microphone, or choose another"
    return f"very quiet ({level_db:.0f} dBFS) - speak up, or raise the input level"


class AutomaticLevel:
    """Amplifies a stream, frame by frame of 20 ms."""

    is_held = False
    """Whether the robot's own voice is in the sound."""

    def __init__(self) -> None:
        self._loudest = LOUD_DB
        self._level = self._floor = QUIET_ROOM_DB
        self._gain = 1.0

    @property
    def gain_db(self) -> float:
        """By how much the last frame was amplified, 0 to MOST_DB."""
        return 20.0 * math.log10(self._gain)

    def take(self, frame: Samples, level: float) -> Samples:
        """The next frame, whose level is in dB against full scale, as loud as it counts."""
        gain_db = self._held(level) if self.is_held else self._learned(level)
        before, self._gain = self._gain, 10.0 ** (gain_db / 20.0)
        if before == self._gain == 1.0:
            return frame
        gains = np.linspace(min(before, self._gain), self._gain, len(frame))
        louder: Samples = np.rint(frame * gains).clip(-32768, 32767).astype(np.int16)
        return louder

    def rest(self, samples: Samples) -> Samples:
        """What is less than a frame, at the end, with the last gain."""
        louder: Samples = np.rint(samples * self._gain).clip(-32768, 32767).astype(np.int16)
        return louder

    def _held(self, level: float) -> float:
        return min(self.gain_db, max(0.0, LOUD_DB - level))

    def _learned(self, level: float) -> float:
        self._loudest = max(level, self._loudest - FALL, LOUD_DB - MOST_DB)
        if level > ZEROS_DB:
            self._level += SMOOTHING * (level - self._level)
            self._floor = min(self._level, self._floor + RISE)
        return min(MOST_DB, max(0.0, min(LOUD_DB - self._loudest, QUIET_ROOM_DB - self._floor)))
