"""What can be heard in the room: voices that start at a time, over quiet noise.

Sound is a function of the absolute index of the sample, so it is the same however it is sliced,
and any number of microphones hear the same.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import soxr
from numpy.typing import NDArray

from hri.core.signals import Samples

RATE = 16000
"""Samples a second."""
FULL_SCALE = 32767.0
MEMORY = 60.0
"""Seconds after its end that a voice can still be asked for."""

_BLOCK = 1600


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """Something that sounds."""

    first: int
    """Index of its first sample."""
    samples: NDArray[np.float32]

    @property
    def end(self) -> int:
        return self.first + len(self.samples)


class Sound:
    """All that sounds in the room, 16 kHz mono; full scale is +-32767."""

    def __init__(self, seed: int = 0, noise_db: float = -math.inf) -> None:
        """`noise_db`: level of the noise against full scale."""
        self._sources: list[Source] = []
        self._seed = seed
        self._noise = FULL_SCALE * 10 ** (noise_db / 20)

    def add(self, samples: Samples, rate: int, at: float, gain: float = 1.0) -> Source:
        """Let a sound begin at a time in seconds; what came before is never changed by it."""
        voice = soxr.resample(samples.astype(np.float32) * np.float32(gain), rate, RATE)
        self._sources.append(Source(round(at * RATE), voice))
        return self._sources[-1]

    def cut(self, source: Source, at: float) -> None:
        """Let a sound end at a time in seconds, if it has not ended by then."""
        if source in self._sources:
            kept = max(0, round(at * RATE) - source.first)
            place = self._sources.index(source)
            self._sources[place] = Source(source.first, source.samples[:kept])

    def between(self, first: int, end: int) -> Samples:
        """The samples with index `first` up to, not including, `end`; may be empty."""
        if end <= first:
            return np.zeros(0, np.int16)
        self._sources = [s for s in self._sources if s.end > first - MEMORY * RATE]
        mixed = self._noise_between(first, end)
        for source in self._sources:
            start, stop = max(first, source.first), min(end, source.end)
            if start < stop:
                part = source.samples[start - source.first : stop - source.first]
                mixed[start - first : stop - first] += part
        return np.clip(np.rint(mixed), -FULL_SCALE, FULL_SCALE).astype(np.int16)

    def _noise_between(self, first: int, end: int) -> NDArray[np.float32]:
        if not self._noise:
            return np.zeros(end - first, np.float32)
        blocks = range(first // _BLOCK, (end - 1) // _BLOCK + 1)
        noise = np.concatenate([noise_block(self._seed, block) for block in blocks])
        offset = blocks[0] * _BLOCK
        return np.asarray(noise[first - offset : end - offset] * np.float32(self._noise))


@lru_cache(maxsize=8)
def noise_block(seed: int, block: int) -> NDArray[np.float32]:
    """The noise of a tenth of a second, of level 1; a function of its number alone."""
    generator = np.random.default_rng((seed, block))
    return generator.standard_normal(_BLOCK, dtype=np.float32)
