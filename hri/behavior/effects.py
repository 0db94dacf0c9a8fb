"""What values that come into a behavior may do beyond its outputs."""

from __future__ import annotations

from enum import Enum


class Effect(Enum):
    """An effect that needs permission when it comes from outside; the value describes it."""

    MOVES = "moves the robot"
    SPEAKS = "lets it speak"
    RELEASES = "releases it after a stop"


NOTHING: frozenset[Effect] = frozenset()
ANYTHING = frozenset(Effect)
