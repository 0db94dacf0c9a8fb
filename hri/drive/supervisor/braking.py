"""From which speed a base can still stop in time: pure arithmetic."""

from __future__ import annotations

import math


def stopping_speed(
    gap: float, reaction: float, deceleration: float, approach: float = 0.0
) -> float:
    """The speed, m/s, from which a base stands before what comes has crossed the gap, meters.

    `reaction` is in seconds, `approach` is how fast it comes: 0 for what stands. Solves
    u (r + v / a) + v r + v² / 2a = gap for v, with approach u, reaction r, and deceleration a.
    """
    left = gap - approach * reaction
    if left == math.inf:
        return math.inf
    if not left > 0:
        return 0.0
    half = approach + deceleration * reaction
    return math.sqrt(half * half + 2 * deceleration * left) - half
