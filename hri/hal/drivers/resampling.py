"""Sound at another rate, at once or while it comes in."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np
import soxr

from hri.core.signals import Samples

REACH = 160
"""Samples of the lower rate that the end of a sound has an influence on; measured are 52."""


def resample(samples: Samples, rate: int, wanted: int) -> Samples:
    """The same sound at another rate."""
    if rate == wanted:
        return samples
    converted: Samples = soxr.resample(samples, rate, wanted)
    return converted


def resample_blocks(blocks: Iterable[Samples], rate: int, wanted: int) -> Iterator[Samples]:
    """The same sound at another rate, block by block without a seam."""
    resampler = Resampler(rate, wanted)
    for block in blocks:
        yield resampler.convert(block)
    yield resampler.finish()


class Resampler:
    """Converts sound while it comes in; what goes out lags by 10 to 30 ms.

    Not a sample is lost or gained over time. Sound of the wanted rate passes as it is.
    """

    def __init__(self, rate: int, wanted: int) -> None:
        self._stream = (
            None if rate == wanted else soxr.ResampleStream(rate, wanted, 1, dtype="int16")
        )

    def convert(self, samples: Samples) -> Samples:
        """The next block, as far as it is known by now."""
        if self._stream is None:
            return samples
        converted: Samples = self._stream.resample_chunk(samples)
        return converted

    def finish(self) -> Samples:
        """What is still inside, at the end of all sound."""
        if self._stream is None:
            return np.zeros(0, np.int16)
        rest: Samples = self._stream.resample_chunk(np.zeros(0, np.int16), last=True)
        return rest


class GrowingSound:
    """A sound at another rate that is whole at any time, and grows at its end.

    It is what converting all of it at once would give. What is appended is converted with as much
    of the sound before it as the filter reaches back over.
    """

    def __init__(self, samples: Samples, rate: int, wanted: int) -> None:
        common = math.gcd(rate, wanted)
        # After this many samples of the source, and of the result, both begin at one time again.
        self._step, self._made = rate // common, wanted // common
        self._rate, self._wanted = rate, wanted
        self._tail: Samples = np.zeros(0, np.int16)
        self._tail_start = 0
        """Place of the tail in the source, a multiple of the step."""
        self.samples: Samples = np.zeros(0, np.int16)
        """At the wanted rate."""
        self.extend(samples)

    @property
    def seconds(self) -> float:
        """How long it is."""
        return (self._tail_start + len(self._tail)) / self._rate

    def extend(self, samples: Samples) -> None:
        """Append to it, at the rate of the source."""
        self._tail = np.concatenate([self._tail, samples])
        start = self._tail_start // self._step * self._made
        reach = REACH / min(self._rate, self._wanted)
        seam = start + (round(reach * self._wanted) if start else 0)
        converted = resample(self._tail, self._rate, self._wanted)
        self.samples = np.concatenate([self.samples[:seam], converted[seam - start :]])
        needed = round(2 * reach * self._rate)
        passed = max(0, len(self._tail) - needed) // self._step * self._step
        self._tail = self._tail[passed:]
        self._tail_start += passed
