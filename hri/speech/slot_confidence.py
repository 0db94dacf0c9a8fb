"""How sure each tag of a sentence is: by the sound of the words that give it, and by its rivals.

The evidence of a whole sentence carries a wrong word in it, so every value is judged by itself. Two
things speak against one: that its words are unlike their own stretch of sound, and that a sentence
which is nearly as likely has another value.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from hri.core.signals import HeardWord
from hri.speech.grammar.matching import Parse

WEIGHTS = (-3.15, 0.89, 0.78)
"""Weights of 1, of the log of how much likelier the value is than another one, and of the log odds
that the least sure of its words was said, in the log odds that the value was meant.

Logistic regression over 4,000 sentences of a cafe by three voices, a half of them outside of its
grammar, and over 50 orders by people, clean and in babble, in a kitchen, and over pink noise at 12
and 6 dB. The first weight is 1.2 less than its result: a question costs less than a wrong deed.
"""
LEAST_APART, MOST_APART = -2.0, 4.0
"""Natural logs between which a rival counts for more or less."""
LEAST_CHANCE = 1e-4
"""Of a word."""
REST = ""
"""Stands for what gives no tag its value, where there are tags."""


def slot_confidences(
    found: Parse, words: Sequence[HeardWord], rivals: Sequence[tuple[Parse | None, float]]
) -> dict[str, float]:
    """0 to 1 by tag: the chance that its value was meant; 0.5 is the point of acceptance.

    `rivals` are the meanings of the other sentences that may have been said, None without one, with
    their shares of the likelihood. A tag that only they have is judged, too. Empty for a sentence
    without tags, and for words from an engine that does not judge them one by one.
    """
    chances = _chances(found, words)
    if not (found.tags and chances):
        return {}
    own = 1.0 - sum(share for _, share in rivals)
    others = _others(found, rivals)
    return {
        name: _confidence(own, others.get(name, 0.0), chances.get(name, 1.0))
        for name in dict.fromkeys((*found.tags, *others, *chances))
    }


def _confidence(own: float, other: float, chance: float) -> float:
    """Of a value with its share of the likelihood, that of the best other one, and the chance of
    its words.
    """
    apart = MOST_APART
    if other > 0.0:
        apart = math.log(max(own, LEAST_CHANCE) / other)
        apart = min(max(apart, LEAST_APART), MOST_APART)
    chance = min(max(chance, LEAST_CHANCE), 1.0 - LEAST_CHANCE)
    bias, of_rival, of_words = WEIGHTS
    odds = bias + of_rival * apart + of_words * math.log(chance / (1.0 - chance))
    return 1.0 / (1.0 + math.exp(-odds))


def _others(found: Parse, rivals: Sequence[tuple[Parse | None, float]]) -> dict[str, float]:
    """By tag the share of the likeliest rival with another value; REST is of another rule."""
    best: dict[str, float] = {}
    for rival, share in rivals:
        for name in _apart(found, rival):
            best[name] = max(best.get(name, 0.0), share)
    return best


def _apart(found: Parse, rival: Parse | None) -> list[str]:
    if rival is None or rival.rule != found.rule:
        return [REST]
    names = dict.fromkeys((*found.tags, *rival.tags))
    return [name for name in names if _value(found.tags, name) != _value(rival.tags, name)]


def _value(tags: Mapping[str, object], name: str) -> tuple[object, ...]:
    """What a tag has; a value that happens to be None is not the same as no tag."""
    return (tags[name],) if name in tags else ()


def _chances(found: Parse, words: Sequence[HeardWord]) -> dict[str, float]:
    """By tag the chance of the least sure of the words that give it its value.

    Empty where the words are not those of the sentence, or not judged.
    """
    listed = [
        (place, word) for place, word in enumerate(found.text.split()) if place not in found.free
    ]
    if [word for _, word in listed] != [word.text for word in words]:
        return {}
    least: dict[str, float] = {}
    for (place, _), heard in zip(listed, words, strict=True):
        if heard.confidence is None:
            return {}
        name = found.tag_of(place)
        least[name] = min(least.get(name, 1.0), heard.confidence)
    return least
