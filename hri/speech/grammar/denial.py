"""Sentences that say not to: "don't tell me what time it is" does not ask for the time."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import dropwhile

FILLERS = frozenset(
    ("ah", "and", "but", "hey", "just", "no", "now", "oh", "ok", "okay", "please", "so", "well")
)
"""What may stand before the "don't"; beside them a name."""
SUBJECTS = frozenset(("i", "you", "we", "they", "it", "he", "she", "people"))
"""Whoever does not do something: "i don't know", which forbids nothing."""
OTHERWISE = frozenset(("care", "forget", "have", "know", "mind", "need", "remember", "worry"))
"""What follows a "don't" that forbids nothing: "don't know what time it is"."""


def is_denied(words: Sequence[str], free: Collection[int]) -> bool:
    """Whether the free words of a sentence begin with "don't", "do not" or "never".

    `free` are the numbers of the words that no rule lists. A name or "please" may come first.
    """
    unlisted = [word if place in free else "" for place, word in enumerate(words)]
    rest = list(dropwhile(lambda word: not word or word in FILLERS, unlisted))
    is_named = SUBJECTS.isdisjoint(rest[:1])
    return _forbids(rest) or (is_named and _forbids(rest[1:]))


def _forbids(words: Sequence[str]) -> bool:
    """Whether it begins with an order not to do something."""
    if list(words[:2]) == ["do", "not"]:
        words = ["don't", *words[2:]]
    if len(words) < 2 or words[0] not in ("don't", "never") or words[1] in OTHERWISE:
        return False
    return words[1] != "you" or list(words[2:3]) == ["dare"]
