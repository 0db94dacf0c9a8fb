"""How far a decoded path can be trusted, from figures that any HMM decoder gives.

PocketSphinx scores a path against the best sound model of each frame, so the score of a path is
its distance from "any sounds at all", and the grammar's own words come close to it. The score of
a path grows with the square root of its length; what it does not tell is how much of the speech
the path left unexplained as silence, which is what foreign talk leaves behind a short command.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

ACCEPTED_COST = 0.043
"""-ln(score) / sqrt(frames of words) that is just accepted.

Measured on endpointed speech with the companion's grammar. Let through: 417 of 455 commands by
seven synthetic voices (12 more as another sentence); of foreign speech none of 50 coffee orders,
none of 5 read lines, and 15 of 294 short synthetic sentences. Right pieces of real people's
speech (118: digits, cards, read lines, each with its own grammar) had at most 0.047.
"""
FREE_SILENCE = 1.05
"""Seconds outside of the words that cost nothing: what the endpointer adds at both ends."""
SILENCE_SCALE = 0.3
"""Seconds outside of the words, beyond the free ones, that cost as much as a bad score."""
FRAME = 0.01
"""Seconds."""


@dataclass(frozen=True, slots=True)
class PathFigures:
    """What the decoder says of its best path."""

    score: float
    """Likelihood of the path against the best sounds, 0 to 1."""
    word_frames: int
    """Frames of 10 ms within words."""
    frames: int
    """Frames of the whole piece of speech."""


def confidence(figures: PathFigures) -> float:
    """0 to 1; 0.5 is the calibrated point of acceptance, and it halves with each unit of cost."""
    if figures.word_frames <= 0 or not 0.0 < figures.score <= 1.0:
        return 0.0
    cost = -math.log(figures.score) / math.sqrt(figures.word_frames) / ACCEPTED_COST
    silence = (figures.frames - figures.word_frames) * FRAME
    cost += max(0.0, silence - FREE_SILENCE) / SILENCE_SCALE
    return float(0.5**cost)
