"""How far a decoded path can be trusted, from figures that any HMM decoder gives.

PocketSphinx scores a path against the best sound model of each frame, so the score of a path is
its distance from "any sounds at all", and the grammar's own words come close to it. The score of
a path grows with the square root of its length; it does not show how much of the speech the path
left unexplained as silence, the trace of foreign talk behind a short command.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

ACCEPTED_COST = 0.053
"""-ln(score) / sqrt(frames of words) that is just accepted.

The score is against the sounds of the grammar's own states, so a larger grammar has better ones to
compare with: with the 42 commands that the companion had at first, 0.043 let through 417 of 455
commands by seven synthetic voices and 15 of 294 foreign sentences of these. With its 53 commands
of today, 0.053 lets through the same of four sentences that 0.043 did, and of foreign speech none
of 50 coffee orders and none of 5 read lines, whose confidence is 0.47 at most.
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
