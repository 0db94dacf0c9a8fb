"""Everyday words for feelings: "angry" stands for anger and for all that is like it."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from hri.emotion.emotions import NAMES
from hri.emotion.label import MOODS

# fmt: off
FEELINGS: Mapping[str, frozenset[str]] = {
    "happy": frozenset((
        "joy", "hope", "satisfaction", "relief", "happy_for", "gloating", "pride", "admiration",
        "gratification", "gratitude", "love", "exuberant", "relaxed", "trusting",
    )),
    "sad": frozenset((
        "sadness", "disappointment", "fears_confirmed", "pity", "shame", "remorse", "bored",
    )),
    "angry": frozenset((
        "anger", "resentment", "reproach", "hate", "hostile", "disdainful",
    )),
    "scared": frozenset(("fear", "anxious")),
    "disgusted": frozenset(("disgust",)),
    "surprised": frozenset(("surprise",)),
    "calm": frozenset(("calm", "peaceful")),
}
# fmt: on
"""The labels of feelings, emotions and moods, that each word stands for; no label is in two."""

KNOWN_FEELINGS = (*FEELINGS, *NAMES, *(mood for mood in MOODS if mood not in FEELINGS))
"""All words and labels."""


def fitting(label: str, given: Collection[str]) -> str:
    """Which of the given words and labels names a feeling best; empty when none does.

    `label` is that of an emotion or a mood. It comes before the word that stands for it.
    """
    if label in given:
        return label
    words = (word for word, labels in FEELINGS.items() if label in labels and word in given)
    return next(words, "")
