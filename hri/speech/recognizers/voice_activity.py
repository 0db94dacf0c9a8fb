"""Cuts sound into pieces of speech with WebRTC's voice activity detector, from PocketSphinx."""

from __future__ import annotations

import numpy as np
from pocketsphinx import Endpointer as SphinxEndpointer

from hri.core.signals import Samples
from hri.hal.recognizer import Segment

WINDOW = 0.3
"""Seconds that are judged together: the pause that ends a piece, and the pre-roll before it."""
RATIO = 0.9
"""Share of a window that must be voice to begin a piece, or quiet to end it."""
LONGEST = 15.0
"""Seconds; a longer piece is cut, so that no babble grows for ever."""


class VoiceActivityEndpointer:
    """`hri.speech.endpoint.Endpointer` for 16-bit sound of one rate."""

    def __init__(self, rate: int) -> None:
        self.rate = rate
        self._begin_stream()

    def _begin_stream(self) -> None:
        self._endpointer = SphinxEndpointer(window=WINDOW, ratio=RATIO, sample_rate=self.rate)
        self._frame = self._endpointer.frame_bytes // 2
        self._rest = np.zeros(0, np.int16)
        self._voice: list[bytes] = []
        self._taken = 0
        self._origin = 0.0

    @property
    def is_hearing(self) -> bool:
        return bool(self._endpointer.in_speech)

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        sound = np.concatenate([self._rest, samples])
        # Time of the stream's first sample, by the robot's clock.
        self._origin = end - (self._taken + len(sound)) / self.rate
        segments: list[Segment] = []
        whole = len(sound) - len(sound) % self._frame
        for start in range(0, whole, self._frame):
            segments += self._take(sound[start : start + self._frame].tobytes())
        self._rest = sound[whole:].copy()
        return segments

    def flush(self) -> list[Segment]:
        segments: list[Segment] = []
        if self._endpointer.in_speech:
            voice = self._endpointer.end_stream(self._rest.tobytes())
            self._voice.append(voice or b"")
            segments.append(self._segment())
        self._begin_stream()
        return segments

    def _take(self, frame: bytes) -> list[Segment]:
        voice = self._endpointer.process(frame)
        self._taken += self._frame
        if voice is None:
            return []
        self._voice.append(voice)
        is_long = len(self._voice) * self._frame > LONGEST * self.rate
        return [self._segment()] if is_long or not self._endpointer.in_speech else []

    def _segment(self) -> Segment:
        samples = np.frombuffer(b"".join(self._voice), np.int16)
        self._voice = []
        end = self._origin + float(self._endpointer.speech_end)
        if self._endpointer.in_speech:
            # Cut short: what it gives back while speech goes on lags by one window.
            end = self._origin + self._taken / self.rate - WINDOW
        return Segment(end - len(samples) / self.rate, end, samples)
