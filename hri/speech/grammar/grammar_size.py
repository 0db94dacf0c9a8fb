"""How large a grammar is when its rules are written out, counted without writing them.

`automaton.build` writes a rule out in each place where it is used, except that rules at the end of
others are written once for all of these. Twenty rules that each use the next one twice are a
million; the count takes a moment, where the writing took seconds before it was given up.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from hri.speech.grammar import analysis
from hri.speech.grammar.expressions import (
    Alternative,
    Repeat,
    RuleReference,
    Sequence,
    Tagged,
    Token,
)
from hri.speech.grammar.fold import Fold
from hri.speech.grammar.framing import unframed
from hri.speech.grammar.rules import Rules


@dataclass(frozen=True, slots=True)
class _Part:
    """What a part of a rule holds by itself."""

    steps: int = 0
    """Its words and references."""
    inside: tuple[str, ...] = ()
    """Rules that something follows: written out for each use."""
    last: tuple[str, ...] = ()
    """Rules at the end: written once for all that end in the same place."""


_WORD = _Part(1)


def too_large(grammar: Rules, most: int) -> str | None:
    """The public rule with which the arcs of a grammar are more than `most`; None for fewer.

    It counts the least that is written: a rule inside itself counts as nothing, and so does
    what may be said around many rules.
    """
    counted = _Counted(may_defer=bool(grammar.made(analysis.recursive_of)))
    rules = {
        key: counted(unframed(rule.expression).body if rule.is_public else rule.expression)
        for key, rule in grammar.rules.items()
    }
    reached = set(analysis.reachable(grammar.rules, grammar.public_rules))
    used = {name for key in reached for name in rules[key].inside}
    sizes: dict[str, int] = {}
    looked_at = 0
    for key in grammar.made(analysis.order_of):
        if key in used and key in reached and key not in grammar.made(analysis.recursive_of):
            ending = list(_ending(rules, key, set()))
            looked_at += len(ending)  # each of them is an arc at least
            sizes[key] = most + 1 if looked_at > most else _size(rules, ending, sizes)
    total = 0
    written: set[str] = set()
    for key in grammar.public_rules:
        total += _size(rules, list(_ending(rules, key, written)), sizes)
        if total > most:
            return key
    return None


def _size(rules: Mapping[str, _Part], ending: list[str], sizes: Mapping[str, int]) -> int:
    inside = sum(sizes.get(name, 0) for key in ending for name in rules[key].inside)
    return inside + sum(rules[key].steps for key in ending)


def _ending(rules: Mapping[str, _Part], key: str, found: set[str]) -> Iterator[str]:
    """A rule, and those that follow each other at its end, without those found before."""
    pending = [key]
    while pending:
        key = pending.pop()
        if key not in found:
            found.add(key)
            yield key
            pending += [name for name in rules[key].last if name in rules and name not in found]


class _Counted(Fold[_Part]):
    """What a node holds; in a grammar with recursion the tags behind a rule may be deferred, so
    that it is at the end all the same.
    """

    def __init__(self, *, may_defer: bool) -> None:
        self._may_defer = may_defer

    def word(self, node: Token) -> _Part:
        return _WORD

    def reference(self, node: RuleReference) -> _Part:
        return _Part(1, last=(node.name,))

    def row(self, node: Sequence, parts: Iterator[_Part]) -> _Part:
        *others, last = [*parts] or [_Part()]
        return _together([*map(_followed, others), last])

    def choice(self, node: Alternative, parts: Iterator[_Part]) -> _Part:
        return _together(list(parts))

    def repeated(self, node: Repeat, part: _Part) -> _Part:
        return _followed(part)

    def tagged(self, node: Tagged, part: _Part) -> _Part:
        return part if self._may_defer else _followed(part)


def _followed(part: _Part) -> _Part:
    """A part behind which something follows."""
    return _Part(part.steps, part.inside + part.last) if part.last else part


def _together(parts: list[_Part]) -> _Part:
    return _Part(
        sum(part.steps for part in parts),
        tuple(name for part in parts for name in part.inside),
        tuple(name for part in parts for name in part.last),
    )
