"""The emotions the robot can have: what they feel like and how long they last.

The words are those of everyday life; "sadness" is the distress of Ortony, Clore and Collins (OCC).
Coordinates of the six basic emotions: Russell and Mehrabian 1977, "Evidence for a three-factor
theory of emotions", J. Research in Personality 11:273-294, scaled to -1..1. The other four:
Gebhard 2005, "ALMA: a layered model of affect", AAMAS, table 2. The time constants are ours, set by
eye for a visit of a few minutes (ALMA fades an emotion linearly within 20 s).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import did_you_mean
from hri.core.toml import Table

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Emotion:
    """A row of the table."""

    name: str
    pleasure: float
    """-1 to 1; its sign makes the emotion a positive or a negative one."""
    arousal: float
    """-1 to 1."""
    dominance: float
    """-1 to 1."""
    tau_s: float
    """Seconds in which its charge falls to 1/e."""


EMOTIONS = (
    Emotion("joy", 0.76, 0.48, 0.35, 12.0),
    Emotion("sadness", -0.63, -0.27, -0.33, 13.0),
    Emotion("anger", -0.51, 0.59, 0.25, 12.0),
    Emotion("fear", -0.64, 0.60, -0.43, 5.0),
    Emotion("disgust", -0.60, 0.35, 0.11, 8.0),
    Emotion("surprise", 0.40, 0.67, -0.13, 1.5),
    Emotion("pride", 0.40, 0.30, 0.30, 12.0),
    Emotion("shame", -0.30, 0.10, -0.60, 12.0),
    Emotion("gratitude", 0.40, 0.20, -0.30, 12.0),
    Emotion("love", 0.30, 0.10, 0.20, 15.0),
)

NAMES = tuple(emotion.name for emotion in EMOTIONS)
INDEX = {name: index for index, name in enumerate(NAMES)}

PAD: Vector = np.array([(e.pleasure, e.arousal, e.dominance) for e in EMOTIONS])
"""Shape [emotions, 3]."""

OPPOSITES = (
    ("joy", "sadness"),
    ("joy", "anger"),
    ("joy", "fear"),
    ("gratitude", "anger"),
    ("love", "anger"),
    ("love", "disgust"),
    ("pride", "shame"),
)
"""Pairs of which a new one drives out the old one; always a positive and a negative emotion, so
that what pleases more can never leave the robot less pleased."""


def _opposition() -> Vector:
    matrix = np.zeros((len(NAMES), len(NAMES)))
    for one, other in OPPOSITES:
        matrix[INDEX[one], INDEX[other]] = matrix[INDEX[other], INDEX[one]] = 1.0
    return matrix


OPPOSITION: Vector = _opposition()
"""1 where two emotions are opposites, shape [emotions, emotions]."""


def emotions_in(table: Table) -> list[str]:
    """The keys of a table of an authored file that is keyed by emotion.

    Raises AuthoringError for a name that is no emotion.
    """
    for name in table.data:
        if name not in INDEX:
            raise table.error(name, f'no emotion "{name}"', did_you_mean(name, NAMES))
    return list(table.data)
