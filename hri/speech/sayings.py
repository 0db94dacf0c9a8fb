"""A free slot that was said twice: both sayings count together, and what was refused does not."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from hri.core.signals import HeardSlot

UNHEARD = 2.0
"""Natural log: how much worse than the worst that was considered the rest fits a saying."""
SHARPNESS = 0.5
"""By which differences of the scores count for how sure it is."""


class _Reading(NamedTuple):
    text: str
    phones: tuple[str, ...]
    score: float
    """Natural log."""


def both_sayings(first: HeardSlot, again: HeardSlot) -> HeardSlot:
    """What was most likely said, if it was the same both times."""
    sayings = [{one.phones: one.score for one in _readings(slot)} for slot in (first, again)]
    least = [min(scores.values()) - UNHEARD for scores in sayings]
    texts = {one.phones: one.text for slot in (again, first) for one in _readings(slot)}
    together = [
        _Reading(text, phones, sayings[0].get(phones, least[0]) + sayings[1].get(phones, least[1]))
        for phones, text in texts.items()
    ]
    return _slot(first.name, sorted(together, key=lambda one: -one.score))


def without(heard: HeardSlot, refused: Iterable[HeardSlot]) -> HeardSlot | None:
    """The slot without these texts and sounds, which it was not; None where no other is left."""
    gone = [*refused]
    texts, sounds = {one.text for one in gone}, {one.phones for one in gone}
    rest = [one for one in _readings(heard) if one.text not in texts and one.phones not in sounds]
    return _slot(heard.name, rest) if rest else None


def _readings(slot: HeardSlot) -> list[_Reading]:
    """The likeliest first; without scores of a recognizer all fit as well."""
    texts, sounds = (slot.text, *slot.others), (slot.phones, *slot.others_phones)
    scores = slot.scores or (0.0,) * len(texts)
    return [_Reading(*one) for one in zip(texts, sounds, scores, strict=False)]


def _slot(name: str, readings: Sequence[_Reading]) -> HeardSlot:
    texts, sounds, scores = zip(*readings, strict=True)
    return HeardSlot(name, texts[0], sounds[0], chance(scores), texts[1:], sounds[1:], scores)


def chance(scores: Sequence[float]) -> float:
    """0 to 1: that the first of these is right."""
    odds = np.exp(SHARPNESS * (np.array(scores) - scores[0]))
    return round(float(1.0 / odds.sum()), 3)
