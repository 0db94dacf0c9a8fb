"""Sound of several channels as one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Samples
from hri.hal.resource import Description

CHOICES = ("mix", "left", "right", "loudest")
"""What may be heard of a stereo sound."""
REMEMBERED = 0.99
"""Share of what was known of the channels that counts FRAMES later."""
FRAMES = 320
INVERTED, UPRIGHT = -0.5, 0.5
"""Correlation of a channel with the loudest one from which it is turned round, and back."""

Levels = NDArray[np.float64]


def channel_of(description: Description) -> str:
    """The parameter `channel` of a device, "mix" without one. Raises AuthoringError."""
    choice = description.text("channel", CHOICES[0])
    if choice not in CHOICES:
        remedy = f"write one of {', '.join(CHOICES)}"
        raise description.error("channel", f'channel is "{choice}"', remedy)
    return choice


class OneChannel:
    """Makes one channel of many, block by block.

    "mix" is their mean. A channel that is the opposite of the loudest one (a balanced cable in a
    stereo socket, a wire the wrong way round) is turned round first, since both would be silence.
    "loudest" is the channel that has been so for a while: an array of microphones has one that
    points at the speaker, and half of a stereo cable may carry nothing.
    """

    def __init__(self, choice: str = CHOICES[0]) -> None:
        self._choice = choice
        self._products: Levels | None = None
        """Mean product of each two channels, of what has been heard lately."""
        self._signs: Levels = np.ones(1)

    @property
    def is_any_inverted(self) -> bool:
        """Whether a channel is turned round now."""
        return bool((self._signs < 0).any())

    def take(self, block: NDArray[np.int16]) -> Samples:
        """The sound of a block, shape [frames, channels]."""
        if block.shape[1] == 1 or self._choice == "left":
            return block[:, 0].copy()
        if self._choice == "right":
            return block[:, -1].copy()
        products = self._learned(block)
        if self._choice == "loudest":
            return block[:, int(np.argmax(products.diagonal()))].copy()
        self._judge_signs(products)
        mixed: Samples = (block @ self._signs / block.shape[1]).astype(np.int16)
        return mixed

    def _learned(self, block: NDArray[np.int16]) -> Levels:
        sound = block.astype(np.float32)
        products = (sound.T @ sound).astype(np.float64) / max(1, len(block))
        if self._products is None:
            self._products = products
            self._signs = np.ones(block.shape[1])
        kept = REMEMBERED ** (len(block) / FRAMES)
        self._products = kept * self._products + (1.0 - kept) * products
        return self._products

    def _judge_signs(self, products: Levels) -> None:
        """Turn channels round that are the opposite of the loudest, and back."""
        powers = products.diagonal()
        loudest = int(np.argmax(powers))
        correlation = products[loudest] / np.sqrt(np.maximum(powers * powers[loudest], 1e-9))
        sign = self._signs[loudest]
        self._signs = np.where(correlation < INVERTED, -sign, self._signs)
        self._signs = np.where(correlation > UPRIGHT, sign, self._signs)
