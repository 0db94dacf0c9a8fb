"""The short things that parts of a grammar can say, all of them: sets, bounded in size."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from hri.speech.grammar.expressions import (
    Alternative,
    Repeat,
    RuleReference,
    Sequence,
    Token,
)
from hri.speech.grammar.fold import Fold

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
    phrases = PhrasesOf(known, most_words)
    for key in grammar.used_first:
        known[key] = phrases(grammar.rules[key].expression)
    return known


class PhrasesOf(Fold[Phrases]):
    """The phrases of a node up to a number of words, with those of its rules."""

    def __init__(self, rules: Mapping[str, Phrases], most_words: int) -> None:
        self._rules, self._most_words = rules, most_words

    def word(self, node: Token) -> Phrases:
        return Phrases(frozenset({(node.text,)}), is_all=True)

    def reference(self, node: RuleReference) -> Phrases:
        return self._rules.get(node.name, _UNKNOWN)

    def row(self, node: Sequence, parts: Iterator[Phrases]) -> Phrases:
        found = _NOTHING
        for part in parts:
            found = _joined(found, part, self._most_words)
        return found

    def choice(self, node: Alternative, parts: Iterator[Phrases]) -> Phrases:
        return _union(parts)

    def repeated(self, node: Repeat, part: Phrases) -> Phrases:
        return Phrases(part.said, is_all=False)


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
