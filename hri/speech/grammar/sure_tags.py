"""Which tags every sentence of a rule gives: a task can rely on these."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial, reduce

from hri.speech.grammar.analysis import RulesByKey
from hri.speech.grammar.expressions import (
    Alternative,
    Anything,
    RuleReference,
    Sequence,
    Tagged,
    Token,
)
from hri.speech.grammar.fold import Fold
from hri.speech.grammar.tags import TagEntry

Names = frozenset[str]
Step = Callable[[Names], Names]
"""Maps the tags set before a part to those set behind it."""


def sure_tags(rules: RulesByKey, key: str) -> Names:
    """The tags that each sentence of a rule has, whatever its words.

    A tag that is only given by way of a rule that leads back to itself is not counted.
    """
    return _Surely(rules).rule(key, frozenset())


class _Surely(Fold[Step]):
    """Follows what is surely set through a rule, in the order its words are said."""

    def __init__(self, rules: RulesByKey) -> None:
        self._rules = rules
        self._known: dict[tuple[str, Names], Names] = {}

    def rule(self, key: str, before: Names) -> Names:
        """What is set behind a rule."""
        if key not in self._rules:
            return before
        if (key, before) not in self._known:
            self._known[key, before] = before  # what a recursive rule adds is not counted
            self._known[key, before] = self(self._rules[key].expression)(before)
        return self._known[key, before]

    def word(self, node: Token) -> Step:
        return _same

    def anything(self, node: Anything) -> Step:
        return lambda before: before | {node.slot} if node.slot else before

    def reference(self, node: RuleReference) -> Step:
        return partial(self.rule, node.name)

    def row(self, node: Sequence, parts: Iterator[Step]) -> Step:
        steps = list(parts)
        return lambda before: reduce(lambda known, step: step(known), steps, before)

    def choice(self, node: Alternative, parts: Iterator[Step]) -> Step:
        ways = list(parts)
        return lambda before: (
            frozenset.intersection(*(way(before) for way in ways)) if ways else before
        )

    def tagged(self, node: Tagged, part: Step) -> Step:
        return lambda before: reduce(_with, node.entries, part(before))


def _same(before: Names) -> Names:
    return before


def _with(before: Names, entry: TagEntry) -> Names:
    """What is surely set behind an entry."""
    if not before.issuperset(entry.takes):
        return before - set(entry.takes)
    is_set = entry.operation != "*=" or entry.name in before
    return (before - set(entry.takes)) | ({entry.name} if is_set else frozenset())
