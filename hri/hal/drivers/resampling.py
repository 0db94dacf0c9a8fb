"""Sound at another rate, at once or while it comes in."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
import soxr

from hri.core.signals import Samples


def resample(samples: Samples, rate: int, wanted: int) -> Samples:
    """The same sound at another rate."""
    if rate == wanted:
        return samples
    converted: Samples = soxr.resample(samples, rate, wanted)
    return converted


def resample_blocks(blocks: Iterable[Samples], rate: int, wanted: int) -> Iterator[Samples]:
    """The same sound at another rate, block by block without a seam."""
    if rate == wanted:
        yield from blocks
        return
    resampler = Resampler(rate, wanted)
    for block in blocks:
        yield resampler.convert(block)
    yield resampler.finish()


class Resampler:
    """Converts sound while it comes in; what goes out lags by 10 to 30 ms."""

    def __init__(self, rate: int, wanted: int) -> None:
        self._stream = soxr.ResampleStream(rate, wanted, 1, dtype="int16")

    def convert(self, samples: Samples) -> Samples:
        """The next block, as far as it is known by now."""
        converted: Samples = self._stream.resample_chunk(samples)
        return converted

    def finish(self) -> Samples:
        """What is still inside, at the end of all sound."""
        rest: Samples = self._stream.resample_chunk(np.zeros(0, np.int16), last=True)
        return rest
