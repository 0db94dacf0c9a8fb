"""The talk of other people at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from benchmarks.speech.levels import Sound, active_power, trimmed
from hri.core.signals import Samples

TALKERS = 6
"""Voices of the babble: single words of it can hardly be made out."""


def babble(talkers: Sequence[Samples], length: int, chance: np.random.Generator) -> Sound:
    """`length` samples of `TALKERS` of them at once, equally loud, each from anywhere."""
    mixture = np.zeros(length)
    for index in chance.choice(len(talkers), min(TALKERS, len(talkers)), replace=False):
        voice = trimmed(talkers[index].astype(np.float64))
        start = int(chance.integers(len(voice)))
        mixture += np.resize(np.roll(voice, -start), length) / np.sqrt(active_power(voice))
    return mixture
