"""Which tags every sentence of a rule gives: a task can rely on these."""

from __future__ import annotations

from functools import reduce

from hri.speech.grammar.analysis import RulesByKey
from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    Tagged,
    heard_choices,
)
from hri.speech.grammar.tags import TagEntry

Names = frozenset[str]


def sure_tags(rules: RulesByKey, key: str) -> Names:
    """The tags that each sentence of a rule has, whatever its words.

    A tag that is only given by way of a rule that leads back to itself is not counted.
    """
    return _Walk(rules).rule(key, frozenset())


class _Walk:
    """Follows what is surely set through a rule, in the order its words are said."""

    def __init__(self, rules: RulesByKey) -> None:
        self._rules = rules
        self._known: dict[tuple[str, Names], Names] = {}

    def rule(self, key: str, before: Names) -> Names:
        if key not in self._rules:
            return before
        if (key, before) not in self._known:
            self._known[key, before] = before  # what a recursive rule adds is not counted
            self._known[key, before] = self.node(self._rules[key].expression, before)
        return self._known[key, before]

    def node(self, node: Expression, before: Names) -> Names:
        match node:
            case RuleReference(name=name):
                return self.rule(name, before)
            case Sequence(items=items):
                return reduce(lambda known, item: self.node(item, known), items, before)
            case Alternative():
                ways = [self.node(choice, before) for choice in heard_choices(node)]
                return frozenset.intersection(*ways) if ways else before
            case Optional(item=item) | Repeat(item=item, minimum=0):
                return before & self.node(item, before)
            case Repeat(item=item):
                return self.node(item, before)
            case Tagged(item=item, entries=entries):
                return reduce(_with, entries, self.node(item, before))
            case _:
                return before


def _with(before: Names, entry: TagEntry) -> Names:
    """What is surely set behind an entry."""
    if not before.issuperset(entry.takes):
        return before - set(entry.takes)
    is_set = entry.operation != "*=" or entry.name in before
    return (before - set(entry.takes)) | ({entry.name} if is_set else frozenset())
