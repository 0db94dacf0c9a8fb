"""What a base did between two times, in words: the legs of its way, from its odometry."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from hri.core.geometry import wrapped
from hri.core.signals import Pose2D

STILL = 0.002
"""Meters or radians between two samples below which the base stands."""
GAP = 1.0
"""Seconds of standing after which a motion is another one."""
LEAST = {"m": 0.02, "degrees": 3.0}
"""Shorter legs are not worth a word."""

Sample = tuple[float, Pose2D]
"""Seconds, and where the base believed to be then."""


@dataclass(slots=True)
class Leg:
    """A motion ahead and back, or to the left and right."""

    begun: float
    """Seconds."""
    ended: float
    amount: float
    """Meters or degrees; positive is ahead or to the left."""
    unit: str

    def __str__(self) -> str:
        if self.unit == "m":
            return f"drove {'forward' if self.amount > 0 else 'back'} {abs(self.amount):.2f} m"
        return f"turned {'left' if self.amount > 0 else 'right'} {abs(self.amount):.0f} degrees"


def legs(samples: Sequence[Sample]) -> list[Leg]:
    """The legs in the order in which they began; a curve is one leg ahead and one turn."""
    driven, turned = [], []
    for (_, before), (time, after) in pairwise(samples):
        heading = (before.heading + after.heading) / 2
        x, y = after.x - before.x, after.y - before.y
        driven.append((time, x * math.cos(heading) + y * math.sin(heading)))
        turned.append((time, wrapped(after.heading - before.heading)))
    found = [*_runs(driven, "m", 1.0), *_runs(turned, "degrees", math.degrees(1.0))]
    found = [leg for leg in found if abs(leg.amount) >= LEAST[leg.unit]]
    return sorted(found, key=lambda leg: leg.begun)


def _runs(steps: Iterable[tuple[float, float]], unit: str, factor: float) -> list[Leg]:
    """Steps of one direction, together; those in between in which the base stands are left out."""
    runs: list[Leg] = []
    for time, step in steps:
        if abs(step) < STILL:
            continue
        if runs and runs[-1].amount * step > 0 and time - runs[-1].ended <= GAP:
            runs[-1].ended = time
            runs[-1].amount += step * factor
        else:
            runs.append(Leg(time, time, step * factor, unit))
    return runs
