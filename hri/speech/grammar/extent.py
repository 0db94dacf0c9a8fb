"""How large a grammar is when its rules are written out, counted without writing them.

`automaton.build` writes a rule out in each place where it is used, except that rules at the end of
others are written once for all of these. Twenty rules that each use the next one twice are a
million; the count takes a moment, where the writing took seconds before it was given up.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from hri.speech.grammar import analysis
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
from hri.speech.grammar.rules import Rules


@dataclass(slots=True)
class _Rule:
    """What one rule holds by itself."""

    steps: int = 0
    """Its words and references."""
    inside: list[str] = field(default_factory=list)
    """Rules that something follows: written out for each use."""
    last: list[str] = field(default_factory=list)
    """Rules at the end: written once for all that end in the same place."""


def too_large(grammar: Rules, most: int) -> str | None:
    """The public rule with which the arcs of a grammar are more than `most`; None for fewer.

    It counts the least that is written: a rule inside itself counts as nothing.
    """
    may_defer = bool(grammar.made(analysis.recursive_of))
    rules = {key: _counted(rule.expression, may_defer) for key, rule in grammar.rules.items()}
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


def _size(rules: Mapping[str, _Rule], ending: list[str], sizes: Mapping[str, int]) -> int:
    inside = sum(sizes.get(name, 0) for key in ending for name in rules[key].inside)
    return inside + sum(rules[key].steps for key in ending)


def _ending(rules: Mapping[str, _Rule], key: str, found: set[str]) -> Iterator[str]:
    """A rule, and those that follow each other at its end, without those found before."""
    pending = [key]
    while pending:
        key = pending.pop()
        if key not in found:
            found.add(key)
            yield key
            pending += [name for name in rules[key].last if name in rules and name not in found]


def _counted(expression: Expression, may_defer: bool) -> _Rule:
    rule = _Rule()
    _count(expression, rule, True, may_defer)
    return rule


def _count(node: Expression, rule: _Rule, is_last: bool, may_defer: bool) -> None:
    """Add what a node holds; in a grammar with recursion the tags behind a rule may be deferred,
    so that it is at the end all the same.
    """
    match node:
        case Token():
            rule.steps += 1
        case RuleReference(name=name):
            rule.steps += 1
            (rule.last if is_last else rule.inside).append(name)
        case Sequence(items=(*others, last)):
            for item in others:
                _count(item, rule, False, may_defer)
            _count(last, rule, is_last, may_defer)
        case Alternative():
            for choice in heard_choices(node):
                _count(choice, rule, is_last, may_defer)
        case Tagged(item=item):
            _count(item, rule, is_last and may_defer, may_defer)
        case Repeat(item=item):
            _count(item, rule, False, may_defer)
        case Optional(item=item):
            _count(item, rule, is_last, may_defer)
