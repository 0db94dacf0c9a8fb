"""Posteriors while the sound comes, for partial results.

The network looks at a whole utterance: every frame attends to every other, and by its convolutions
a frame depends on 1.2 s around it. Cut into chunks that keep what they know of the past, it gives
rougher frames: where either says a phone, both say the same one in 86 % of the frames of clean
commands and in 73 % under babble at 6 dB (90 and 80 % when it looks 0.5 s ahead, 94 and 88 % with
1 s). Of 260 commands the right words were found in them 258 times clean, 237 times under babble at
12 dB and 174 times at 6 dB, 259, 242 and 194 times by the network as a whole. So chunks are for
words on a display, and the finished piece goes through `Conformer.posteriors` once more, best as
soon as the voice falls silent.

A second of sound costs 9 ms of one core in chunks, 4 ms as a whole.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.conformer import STRIDE, Conformer
from hri.speech.recognizers.ctc.features import HOP, WIDTH, Sound

CHUNK = 25
"""Frames (0.5 s) that are settled at once."""
AHEAD = 15
"""Frames (0.3 s) that a chunk looks ahead."""


class PosteriorStream:
    """The posteriors of one piece of speech, chunk by chunk.

    Memory stays bounded however long it goes on. Chunks of other sizes are for measuring.
    """

    def __init__(self, network: Conformer, chunk: int = CHUNK, ahead: int = AHEAD) -> None:
        self._network = network
        self._chunk = chunk
        self._needed = STRIDE * (chunk + ahead) * HOP + WIDTH
        self._past = network.past()
        self._sound = np.zeros(0, np.float32)
        """From the window of the last log-mel frame before the next chunk on."""
        self._is_begun = False
        self._is_first = True

    def push(self, samples: Sound) -> NDArray[np.float32]:
        """Take 16 kHz sound; the posteriors [frames, 40] that are settled by it, often none."""
        self._sound = np.concatenate([self._sound, samples.astype(np.float32)])
        if not self._begin():
            return _joined([])
        ready = []
        while len(self._sound) >= self._needed:
            mel = self._log_mel(self._sound[: self._needed])
            ready.append(self._network.run(mel, self._past, self._chunk)[: self._chunk])
            self._sound = self._sound[STRIDE * self._chunk * HOP :]
        return _joined(ready)

    def finish(self) -> NDArray[np.float32]:
        """The posteriors of the rest, at the end of the sound. The stream is used up."""
        if not self._is_begun:
            return _joined([])
        mel = self._log_mel(np.pad(self._sound, (0, WIDTH // 2), mode="reflect"))
        mel = np.pad(mel, ((0, 1), (0, 0)))
        return self._network.run(mel, self._past, 0) if len(mel) > STRIDE else _joined([])

    def _begin(self) -> bool:
        """Mirror the start, once there is a window of sound; True when that is done."""
        if not self._is_begun and len(self._sound) >= WIDTH:
            mirrored = np.pad(self._sound, (WIDTH // 2, 0), mode="reflect")
            self._sound = np.pad(mirrored, (HOP, 0))
            self._is_begun = True
        return self._is_begun

    def _log_mel(self, sound: NDArray[np.float32]) -> NDArray[np.float32]:
        mel = self._network.log_mel(sound)
        if self._is_first:
            mel[0] = 0.0  # What the network was trained to see before the first frame.
            self._is_first = False
        return mel


def _joined(chunks: list[NDArray[np.float32]]) -> NDArray[np.float32]:
    return np.concatenate([np.zeros((0, len(CLASSES)), np.float32), *chunks])
