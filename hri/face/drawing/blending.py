"""The morph itself: neutral + weights @ rows, in blocks that leave out what is zero anyway.

Of the matrix of a face about a twentieth is not zero: a brow does not move the mouth. It is cut
into runs of columns with only the rows that reach them, so that it stays in the caches of the
processor. The sums are the same.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float32]

CHUNK = 64
"""Columns that stay together."""
OVERHEAD = 10_000
"""Overhead of a block, as a number of its elements (measured; half to twice it gives the same
speed).
"""


class Blend:
    """A fixed neutral vector and rows; call it with weights."""

    def __init__(self, neutral: Vector, rows: Vector) -> None:
        """`neutral` [n] and `rows` [channels, n]."""
        self._length = len(neutral)
        whole = np.concatenate([neutral[None], rows])
        self._blocks = [
            (start, stop, reached, np.ascontiguousarray(whole[reached, start:stop]))
            for start, stop, reached in _cut(whole)
        ]

    def __call__(self, weights: Vector) -> Vector:
        """The blended vector [n] for weights [channels]."""
        blended = np.empty(self._length, np.float32)
        extended = np.concatenate([_ONE, weights])
        for start, stop, reached, block in self._blocks:
            np.dot(extended[reached], block, out=blended[start:stop])
        return blended


_ONE = np.ones(1, np.float32)
"""The weight of the neutral vector, the first row of each block."""


def _cut(whole: Vector) -> list[tuple[int, int, NDArray[np.intp]]]:
    """Runs of columns and the rows that reach them: neighbors join while that costs less."""
    starts = list(range(0, whole.shape[1], CHUNK))
    masks = [_reaching(whole[:, start : start + CHUNK]) for start in starts]
    ends = [*starts[1:], whole.shape[1]]
    while len(starts) > 1:
        gains = [
            _cost(starts[k], ends[k], masks[k])
            + _cost(starts[k + 1], ends[k + 1], masks[k + 1])
            - _cost(starts[k], ends[k + 1], masks[k] | masks[k + 1])
            for k in range(len(starts) - 1)
        ]
        best = int(np.argmax(gains))
        if gains[best] <= 0:
            break
        masks[best] |= masks.pop(best + 1)
        ends[best] = ends.pop(best + 1)
        starts.pop(best + 1)
    return [
        (start, stop, np.flatnonzero(mask))
        for start, stop, mask in zip(starts, ends, masks, strict=True)
    ]


def _reaching(columns: Vector) -> NDArray[np.bool_]:
    mask = np.asarray(columns.any(axis=1), np.bool_)
    mask[0] = True
    return mask


def _cost(start: int, stop: int, mask: NDArray[np.bool_]) -> int:
    return OVERHEAD + (stop - start) * int(np.count_nonzero(mask))
