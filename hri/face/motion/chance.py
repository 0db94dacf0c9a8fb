"""Numbers that look random, and are always the same for the same seed, kind and number.

Each kind draws for itself, so that one more does not shift the others.
"""

from __future__ import annotations

import math
from functools import lru_cache
from hashlib import blake2b
from statistics import NormalDist

_NORMAL = NormalDist()
_KNOT = 1.8
"""Makes the drift's usual size .7, that of a sine: four knots from -1 to 1, weighted by the spline,
have .4."""


@lru_cache(maxsize=8192)
def chance(seed: int, kind: str, number: int) -> float:
    """Evenly distributed between 0 and 1, both left out.

    A checksum does not do: it is linear in its text, so neighbors depend on each other.
    """
    digest = blake2b(f"{seed}/{kind}/{number}".encode(), digest_size=8).digest()
    return ((int.from_bytes(digest, "little") >> 12) + 0.5) / 2**52


def normal(seed: int, kind: str, number: int) -> float:
    """Normally distributed around 0, with a deviation of 1."""
    return _NORMAL.inv_cdf(chance(seed, kind, number))


def log_normal(seed: int, kind: str, number: int, spread: float) -> float:
    """Log-normally distributed with a mean of 1; `spread` is the deviation."""
    variance = math.log1p(spread * spread)
    return math.exp(math.sqrt(variance) * normal(seed, kind, number) - variance / 2)


def drift(seed: int, kind: str, t: float) -> float:
    """A curve that wanders around 0 and never repeats, mostly within -1 to 1.

    A cubic B-spline over random knots one unit of `t` apart: neither its speed nor its
    acceleration jumps.
    """
    number = math.floor(t)
    a, b, c, d = _piece(seed, kind, number)
    t -= number
    return a + t * (b + t * (c + t * d))


@lru_cache(maxsize=2048)
def _piece(seed: int, kind: str, number: int) -> tuple[float, float, float, float]:
    """The polynomial of the curve between two knots."""
    p, q, r, s = (_KNOT * (2 * chance(seed, kind, number + n) - 1) for n in (-1, 0, 1, 2))
    return (p + 4 * q + r) / 6, (r - p) / 2, (p - 2 * q + r) / 2, (s - 3 * r + 3 * q - p) / 6
