"""Values that are lost: a tag that is set a second time before anything took its first value."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import reduce
from operator import or_
from typing import Final

from hri.speech.grammar import analysis
from hri.speech.grammar.expressions import (
    Alternative,
    Anything,
    Expression,
    Repeat,
    RuleReference,
    Sequence,
    Tagged,
    Token,
    children,
)
from hri.speech.grammar.fold import Fold
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.lint.finding import Finding, warning
from hri.speech.grammar.rules import Rule
from hri.speech.grammar.tags import TagEntry, spell_entries

VARIED: Final = object()
"""Stands for a value that depends on the spoken words."""


@dataclass(frozen=True, slots=True)
class Effect:
    """What a part of a grammar does to the tags, by one way through it at least."""

    leaves: Mapping[str, object] = field(default_factory=dict)
    """Tags that it gave a value, and that value: VARIED, unless it always is the same."""
    replaces: Mapping[str, bool] = field(default_factory=dict)
    """Tags whose value from before it is lost, and whether it surely is."""
    takes: frozenset[str] = frozenset()
    """Tags whose value from before it is used up."""

    def __or__(self, other: Effect) -> Effect:
        """Of one part or the other."""
        if other == self:
            return self
        leaves = {
            name: value if other.leaves.get(name, VARIED) == value else VARIED
            for name, value in self.leaves.items()
        }
        replaces = {
            name: is_sure and other.replaces.get(name, False)
            for name, is_sure in self.replaces.items()
        }
        return Effect(
            leaves | {name: VARIED for name in other.leaves if name not in leaves},
            replaces | {name: False for name in other.replaces if name not in replaces},
            self.takes | other.takes,
        )

    def then(self, other: Effect) -> Effect:
        """Of one part and the other behind it."""
        if not (other.leaves or other.replaces or other.takes):
            return self
        kept = {name: value for name, value in self.leaves.items() if name not in other.takes}
        replaced = {n: is_sure for n, is_sure in other.replaces.items() if n not in self.takes}
        sure = {name: True for name, is_sure in self.replaces.items() if is_sure}
        return Effect(
            {**kept, **other.leaves},
            {**self.replaces, **replaced, **sure},
            self.takes | (other.takes - self.leaves.keys()),
        )

    def lost(self, other: Effect) -> list[str]:
        """The tags whose value is lost when the other part follows.

        What always is the same and may be replaced is not: "turn {angle=90} [<angle>]" says what
        counts unless the person says something else.
        """
        return [
            name
            for name, is_sure in other.replaces.items()
            if (is_sure and name in self.leaves) or self.leaves.get(name) is VARIED
        ]


NOTHING = Effect()

Effects = Mapping[str, Effect]
"""Of the rules, by their keys."""
Tell = Callable[[Expression, list[str]], object]
"""Called with a part and the tags whose values it discards."""


def overwritten(grammar: Grammar, rules: Iterable[Rule]) -> Iterator[Finding]:
    """Where one of these rules loses the value of a tag, each tag once in each rule."""
    effects = analysis.settled(grammar, NOTHING, lambda rule, known: _of_rule(grammar, rule, known))
    for rule in rules:
        losses: dict[str, Expression] = {}

        def tell(node: Expression, tags: list[str], losses: dict[str, Expression] = losses) -> None:
            for tag in tags:
                losses.setdefault(tag, _culprit(node, tag, effects))

        EffectOf(effects, tell)(rule.expression)
        places = {node.span: (tag, node) for tag, node in sorted(losses.items(), reverse=True)}
        yield from (_finding(rule, node, tag) for tag, node in places.values())


def _of_rule(grammar: Grammar, rule: Rule, known: Effects) -> Effect:
    found = EffectOf(known)(rule.expression)
    # In a circle what was found once stays, so that this comes to an end.
    return found | known[rule.key] if rule.key in grammar.recursive_rules else found


def _finding(rule: Rule, node: Expression, tag: str) -> Finding:
    what = f'the second "{tag}" replaces the first'
    named, collected = "", f"{{all+=${tag}}}"
    match node:
        case RuleReference(name=name):
            what = f'<{name}> may come behind another "{tag}", and {what}'
            named = f", <{name}> {{first=${tag}}}"
        case Tagged(entries=entries):
            sums = [replace(entry, operation="+=") for entry in entries if entry.name == tag]
            collected = f"{{{spell_entries(sums)}}}"
    remedy = f"give each its own name{named}, or collect them, {collected}"
    return warning(rule.place(node.span), what, remedy)


def _culprit(node: Expression, tag: str, known: Effects) -> Expression:
    """The smallest part of a node that replaces a tag."""
    effect = EffectOf(known)
    for below in children(node):
        if tag in effect(below).replaces:
            return _culprit(below, tag, known)
    return node


class EffectOf(Fold[Effect]):
    """What a node does to the tags; `tell` is told where it loses what it set itself."""

    def __init__(self, known: Effects, tell: Tell = lambda node, tags: None) -> None:
        self._known, self._tell = known, tell

    def word(self, node: Token) -> Effect:
        return NOTHING

    def anything(self, node: Anything) -> Effect:
        return Effect({node.slot: VARIED}, {node.slot: True}) if node.slot else NOTHING

    def reference(self, node: RuleReference) -> Effect:
        return self._known.get(node.name, NOTHING)

    def row(self, node: Sequence, parts: Iterator[Effect]) -> Effect:
        so_far = NOTHING
        for item, further in zip(node.items, parts, strict=True):
            self._tell(item, so_far.lost(further))
            so_far = so_far.then(further)
        return so_far

    def choice(self, node: Alternative, parts: Iterator[Effect]) -> Effect:
        return reduce(or_, parts, next(parts, NOTHING))

    def repeated(self, node: Repeat, part: Effect) -> Effect:
        self._tell(node.item, part.lost(part))
        return part | part.then(part)

    def tagged(self, node: Tagged, part: Effect) -> Effect:
        outside = _effect_of_tags(node.item, node.entries)
        self._tell(node, part.lost(outside))
        self._tell(node, _set_twice(node.entries))
        return part.then(outside)


def _set_twice(entries: tuple[TagEntry, ...]) -> list[str]:
    """The tags that one pair of braces gives a value and then another one."""
    before: set[str] = set()
    lost = []
    for entry in entries:
        if entry.operation == "=" and entry.name in before and entry.name not in entry.takes:
            lost.append(entry.name)
        before.add(entry.name)
    return lost


def _effect_of_tags(item: Expression, entries: tuple[TagEntry, ...]) -> Effect:
    takes = frozenset(name for entry in entries for name in entry.takes)
    is_said = item != Sequence((), item.span)
    leaves = {
        entry.name: entry.value if entry.operation == "=" and not entry.takes else VARIED
        for entry in entries
        if entry.operation != "*=" and is_said
    }
    replaces = {
        entry.name: not entry.takes
        for entry in entries
        if entry.operation == "=" and entry.name not in takes
    }
    return Effect(leaves, replaces, takes)
