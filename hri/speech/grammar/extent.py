"""How large a grammar is when its rules are written out, counted without writing them.

`automaton.build` writes a rule out in each place where it is used, except that rules at the end of
others are written once for all of these. Twenty rules that each use the next one twice are a
million; the count takes a moment, where the writing took seconds before it was given up.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from hri.speech.grammar import analysis
from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    RuleReference,
    Sequence,
    Token,
    children,
    heard_choices,
)

if TYPE_CHECKING:
    from hri.speech.grammar.rules import Grammar


@dataclass(slots=True)
class _Rule:
    """What one rule holds by itself."""

    words: int = 0
    inside: list[str] = field(default_factory=list)
    """Rules that something follows: written out for each use."""
    last: list[str] = field(default_factory=list)
    """Rules at the end: written once for all that end in the same place."""


def too_large(grammar: Grammar, most: int) -> str | None:
    """The public rule with which the arcs of a grammar are more than `most`; None for fewer.

    It counts the least that is written: a rule inside itself counts as nothing.
    """
    rules = {key: _counted(rule.expression) for key, rule in grammar.rules.items()}
    reached = set(analysis.reachable(grammar.rules, grammar.public_rules))
    used = {name for key in reached for name in rules[key].inside}
    sizes: dict[str, int] = {}
    looked_at = 0
    for key in grammar.used_first:
        if key in used and key in reached and key not in grammar.recursive_rules:
            ending = list(_ending(rules, key))
            looked_at += len(ending)  # each of them is an arc at least
            sizes[key] = most + 1 if looked_at > most else _size(rules, ending, sizes)
    total = 0
    for key in grammar.public_rules:
        total += _size(rules, list(_ending(rules, key)), sizes)
        if total > most:
            return key
    return None


def _size(rules: Mapping[str, _Rule], ending: list[str], sizes: Mapping[str, int]) -> int:
    inside = sum(sizes.get(name, 0) for key in ending for name in rules[key].inside)
    return inside + sum(rules[key].words for key in ending)


def _ending(rules: Mapping[str, _Rule], key: str) -> Iterator[str]:
    """A rule, and those that follow each other at its end, each once."""
    found, pending = {key}, [key]
    while pending:
        key = pending.pop()
        yield key
        new = [name for name in rules[key].last if name in rules and name not in found]
        pending += dict.fromkeys(new)
        found.update(new)


def _counted(expression: Expression) -> _Rule:
    rule = _Rule()
    _count(expression, rule, is_last=True)
    return rule


def _count(node: Expression, rule: _Rule, is_last: bool) -> None:
    match node:
        case Token():
            rule.words += 1
        case RuleReference(name=name):
            (rule.last if is_last else rule.inside).append(name)
        case Sequence(items=(*others, last)):
            for item in others:
                _count(item, rule, is_last=False)
            _count(last, rule, is_last)
        case Alternative():
            for choice in heard_choices(node):
                _count(choice, rule, is_last)
        case _:
            for child in children(node):
                _count(child, rule, is_last)
