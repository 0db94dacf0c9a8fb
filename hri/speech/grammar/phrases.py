"""The short things that parts of a grammar can say, all of them: sets, bounded in size."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    Tagged,
    Token,
    heard_choices,
)

if TYPE_CHECKING:
    from hri.speech.grammar.grammar import Grammar

Words = tuple[str, ...]

MOST_PHRASES = 2000
"""Of one part of a grammar; what is beyond is left out."""


@dataclass(frozen=True, slots=True)
class Phrases:
    """What a part of a grammar can say."""

    said: frozenset[Words]
    is_all: bool
    """False when it can say more than this."""


_NOTHING = Phrases(frozenset({()}), is_all=True)
_UNKNOWN = Phrases(frozenset(), is_all=False)


def phrases_of_rules(grammar: Grammar, most_words: int) -> dict[str, Phrases]:
    """The phrases of each rule up to a number of words, without recursion."""
    known: dict[str, Phrases] = {}
    for key in grammar.used_first:
        known[key] = phrases(grammar.rules[key].expression, known, most_words)
    return known


def phrases(node: Expression, rules: Mapping[str, Phrases], most_words: int) -> Phrases:
    """The phrases of a node up to a number of words, with those of its rules."""
    match node:
        case Token(text=text):
            return Phrases(frozenset({(text,)}), is_all=True)
        case RuleReference(name=name):
            return rules.get(name, _UNKNOWN)
        case Sequence(items=items):
            found = _NOTHING
            for item in items:
                found = _joined(found, phrases(item, rules, most_words), most_words)
            return found
        case Alternative():
            return _union(phrases(choice, rules, most_words) for choice in heard_choices(node))
        case Optional(item=item):
            return _union((_NOTHING, phrases(item, rules, most_words)))
        case Repeat(item=item, minimum=minimum):
            once = phrases(item, rules, most_words)
            found = once if minimum else _union((_NOTHING, once))
            return Phrases(found.said, is_all=False)
        case Tagged(item=item):
            return phrases(item, rules, most_words)


def _joined(first: Phrases, second: Phrases, most_words: int) -> Phrases:
    if first is _NOTHING:
        return second
    said = set(first.said & second.said & _NOTHING.said)  # Silence is never what is left out.
    is_all = first.is_all and second.is_all
    shortest = sorted(second.said, key=len)
    for before in first.said:
        for after in shortest:
            if len(before) + len(after) > most_words:
                is_all = False
                break
            if len(said) >= MOST_PHRASES:
                return Phrases(frozenset(said), is_all=False)
            said.add(before + after)
    return Phrases(frozenset(said), is_all)


def _union(parts: Iterable[Phrases]) -> Phrases:
    listed = list(parts)
    said: set[Words] = set()
    for part in listed:
        said |= part.said
    return Phrases(frozenset(said), all(part.is_all for part in listed))
