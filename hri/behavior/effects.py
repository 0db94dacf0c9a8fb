"""What values that come into a behavior may do beyond its outputs."""

from __future__ import annotations

from enum import Enum


class Effect(Enum):
    """What needs someone's leave when it comes from outside; the value says it in a sentence."""

    MOVES = "moves the robot"
    SPEAKS = "lets it speak"
    RELEASES = "releases it after a stop"


NOTHING: frozenset[Effect] = frozenset()
ANYTHING = frozenset(Effect)
