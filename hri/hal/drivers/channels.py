"""Sound of several channels as one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Samples
from hri.hal.resource import Description

CHOICES = ("mix", "left", "right", "loudest")
"""What may be heard of a stereo sound."""
REMEMBERED = 0.99
"""Share of a channel's old loudness in its new one, block by block."""


def channel_of(description: Description) -> str:
    """The parameter `channel` of a device, "mix" without one. Raises AuthoringError."""
    choice = description.text("channel", CHOICES[0])
    if choice not in CHOICES:
        remedy = f"write one of {', '.join(CHOICES)}"
        raise description.error("channel", f'channel is "{choice}"', remedy)
    return choice


class OneChannel:
    """Makes one channel of many, block by block.

    "loudest" is the channel that has been so for a while: an array of microphones has one that
    points at the speaker, and half of a stereo cable may carry nothing.
    """

    def __init__(self, choice: str = CHOICES[0]) -> None:
        self._choice = choice
        self._loudness: NDArray[np.float64] | None = None

    def take(self, block: NDArray[np.int16]) -> Samples:
        """The sound of a block, shape [frames, channels]."""
        match self._choice:
            case "left":
                return block[:, 0].copy()
            case "right":
                return block[:, -1].copy()
            case "loudest":
                return block[:, self._loudest(block)].copy()
        mixed: Samples = block.astype(np.int32).mean(axis=1).astype(np.int16)
        return mixed

    def _loudest(self, block: NDArray[np.int16]) -> int:
        power = np.mean(np.square(block, dtype=np.float64), axis=0)
        if self._loudness is None:
            self._loudness = power
        self._loudness = REMEMBERED * self._loudness + (1.0 - REMEMBERED) * power
        return int(np.argmax(self._loudness))
