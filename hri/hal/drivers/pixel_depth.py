"""Pixels of more than 8 bits as bytes, by a rule for each kind of number.

Cameras store 10, 12 or 14 bits in files of 16, and seldom say so: what is white is then judged by
the largest number that is used.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

DEPTHS = (8, 10, 12, 14, 16, 24)
"""Bits that are used in files of 16 and 32."""
WITHIN = 0.99
"""Part of the numbers with a point that a range must hold; the rest are highlights."""
BRIGHTEST = 16.0
"""Up to this brightness, where 1 is white, numbers with a point are light as it was measured."""
SAMPLED = 1_000_000
"""Numbers that are looked at for that."""
STRIP = 256
"""Rows that are converted at once, so that a large picture is not in the memory again."""


def white_of(samples: NDArray[Any], bits: int) -> float:
    """The number that is white: the largest of the fewest bits that hold all samples.

    These are one of DEPTHS, or `bits`, which is what a sample has without its sign. Of numbers with
    a point it is 1 where nearly all are within it, and the brightest where that is up to BRIGHTEST.
    """
    brightest = _brightest(samples)
    if samples.dtype.kind == "f" and brightest <= BRIGHTEST:
        return max(1.0, brightest)
    depths = [*(depth for depth in DEPTHS if depth < bits), bits]
    return next((2.0**depth - 1 for depth in depths if brightest < 2.0**depth), brightest)


def _brightest(samples: NDArray[Any]) -> float:
    """The largest number; of those with a point the largest but for a few, 0 when there is none."""
    if samples.dtype.kind != "f":
        return float(samples.max())
    some = samples.ravel()[:: max(1, samples.size // SAMPLED)]
    some = some[np.isfinite(some)]
    return float(np.quantile(some, WITHIN)) if some.size else 0.0


def as_bytes(samples: NDArray[Any], white: float, is_negative: bool = False) -> NDArray[np.uint8]:
    """The samples with 0 as black and `white` as 255, rounded; what is beyond is cut off.

    What is not a number is black. `is_negative` is for files in which 0 is white.
    """
    if samples.dtype == np.uint16:
        table = _scaled(np.arange(65536), white, is_negative)
        return np.asarray(table[samples], np.uint8)
    pixels = np.empty(samples.shape, np.uint8)
    for top in range(0, len(samples), STRIP):
        pixels[top : top + STRIP] = _scaled(samples[top : top + STRIP], white, is_negative)
    return pixels


def _scaled(samples: NDArray[Any], white: float, is_negative: bool) -> NDArray[np.uint8]:
    scaled = samples.astype(np.float64) * (255 / white)
    seen = np.nan_to_num(scaled, posinf=255.0).clip(0, 255)
    return np.asarray(np.rint(255 - seen if is_negative else seen), np.uint8)
