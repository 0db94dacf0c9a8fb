"""Values that are lost: a rule that is said twice in a sentence, and its second value stays."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from hri.speech.grammar import analysis
from hri.speech.grammar.expressions import (
    Expression,
    Repeat,
    RuleReference,
    Sequence,
    Tagged,
    walk,
)
from hri.speech.grammar.finding import Finding, warning
from hri.speech.grammar.rules import Grammar, Rule

Spot = tuple[int, int]
"""A line and a column."""
_NOWHERE: Spot = (0, 0)


class _Again(NamedTuple):
    """A reference to a rule that was said before."""

    reference: RuleReference
    since: Spot
    """The end of the reference before it."""
    taken: Mapping[str, Spot]
    """The tags whose values were taken so far, and where that was last."""


def overwritten(grammar: Grammar, rules: Iterable[Rule]) -> Iterator[Finding]:
    """The rules that are said twice in one of these though only the tags of the second remain."""
    kept: dict[str, frozenset[str]] = {}
    for rule in rules:
        told: set[str] = set()
        for again in _said_again(rule):
            name = again.reference.name
            if name not in kept:
                kept[name] = _left_behind(grammar, name)
            left = (tag for tag in kept[name] if again.taken.get(tag, _NOWHERE) <= again.since)
            lost = min(left, default="")
            if lost and name not in told:
                told.add(name)
                what = f'<{name}> may be said twice, and the second "{lost}" replaces the first'
                remedy = f"give each a name of its own: <{name}> {{first=${lost}}}"
                yield warning(rule.place(again.reference.span), what, remedy)


def _said_again(rule: Rule) -> Iterator[_Again]:
    names = {node.name for node in rule.references}
    if len(names) == len(rule.references) and not any(isinstance(n, Repeat) for n in rule.nodes):
        return
    for node in rule.nodes:
        if isinstance(node, Sequence):
            yield from _in_a_row(node)
        elif isinstance(node, Repeat):
            taken = {name: end for end, name in _takings(node.item)}
            references = (below for below in walk(node.item) if isinstance(below, RuleReference))
            yield from (_Again(reference, _NOWHERE, taken) for reference in references)


def _in_a_row(row: Sequence) -> Iterator[_Again]:
    """References in one item to a rule that is said in an item before it."""
    said: dict[str, Spot] = {}
    taken: dict[str, Spot] = {}
    for item in row.items:
        takings = sorted(_takings(item), reverse=True)
        references = [below for below in walk(item) if isinstance(below, RuleReference)]
        for reference in references:
            while takings and takings[-1][0] <= reference.span[:2]:
                end, name = takings.pop()
                taken[name] = end
            if reference.name in said:
                yield _Again(reference, said[reference.name], taken)
        taken |= {name: end for end, name in reversed(takings)}
        said |= {reference.name: reference.span[2:] for reference in references}


def _takings(node: Expression) -> Iterator[tuple[Spot, str]]:
    """The tags whose values are taken in a node, and where the tags end that do so."""
    for below in walk(node):
        if isinstance(below, Tagged):
            for entry in below.entries:
                yield from ((below.span[2:], name) for name in entry.takes)


def _left_behind(grammar: Grammar, key: str) -> frozenset[str]:
    """The tags that a rule sets anew, so that what they held before is lost; none that add up."""
    entries = [
        entry
        for below in analysis.reachable(grammar.rules, (key,))
        for node in grammar.rules[below].nodes
        if isinstance(node, Tagged)
        for entry in node.entries
    ]
    used_up = {name for entry in entries for name in entry.takes if name != entry.name}
    return frozenset(entry.name for entry in entries if entry.operation == "=") - used_up
