"""How much a run of swings looks like a gesture: a score learned from recordings of real heads.

A logistic regression on a handful of features. A row of `config/gestures.toml` holds its weights
beside its limits; `benchmarks/vision/swing_training.py` finds them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

FEATURES = ("width", "duration", "rest", "dominance")
"""The features by name, in the order of their values; see `features`."""
UNIT = math.radians(8)
"""A swing of this width has the width 0."""
BLUR = math.radians(1.5)
"""Added to what an angle covers, so that the noise of one at rest counts little."""
STRONGEST = 2.5
"""Most of the dominance either way."""

Features = tuple[float, float, float, float]
Cover = tuple[float, float]
"""What the angle of the gesture and the crossing one cover during a swing, radians."""


def features(
    widths: Sequence[float], seconds: Sequence[float], covers: Sequence[Cover]
) -> Features:
    """The features of a run of two swings or more, from width (radians, with its sign), duration
    and cover of each:

    - width: of the narrowest, the natural logarithm of its ratio to 8 degrees
    - duration: seconds of the longest
    - rest: most that a pair of swings misses its beginning by, as a part of its wider one
    - dominance: mean logarithm of how many times as far the head moves on this angle as on the
      crossing one; pitch and yaw cross each other
    """
    ratios = [math.log((along + BLUR) / (across + BLUR)) for along, across in covers]
    dominance = sum(ratios) / len(ratios)
    return (
        math.log(min(map(abs, widths)) / UNIT),
        max(seconds),
        max(abs(out + back) / max(abs(out), abs(back)) for out, back in pairwise(widths)),
        min(STRONGEST, max(-STRONGEST, dominance)),
    )


@dataclass(frozen=True, slots=True)
class SwingScore:
    """The weights of the features."""

    bias: float
    weights: Features

    def __call__(self, features: Features) -> float:
        """Above 0 for what looks like the gesture."""
        pairs = zip(self.weights, features, strict=True)
        return self.bias + sum(weight * value for weight, value in pairs)
