"""A grammar: rules that say which sentences are understood, and what they mean."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from hri.hal.word_graph import WordGraph
from hri.speech.grammar import analysis, expansion
from hri.speech.grammar.automaton import Automaton, build, build_spoken
from hri.speech.grammar.expressions import (
    Alternative,
    Anything,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    SourceSpan,
    Token,
    mapped,
    spell,
)
from hri.speech.grammar.fold import Fold
from hri.speech.grammar.free_slots import spoken_slots
from hri.speech.grammar.graph import word_graph
from hri.speech.grammar.matching import Matcher, matcher_of
from hri.speech.grammar.rules import Rules
from hri.speech.grammar.words import normalize

RARE = 0.00001
"""Odds of an answer against a command: PocketSphinx hears both at any time."""
_NOWHERE = SourceSpan(1, 1, 1, 1)


@dataclass(frozen=True)
class Grammar(Rules):
    """Rules, and all that engines make of them."""

    def with_commands(self, keys: Collection[str]) -> Grammar:
        """The same rules, with some of them, public or not, as the only commands."""
        rules = {key: replace(rule, is_public=key in keys) for key, rule in self.rules.items()}
        return replace(self, rules=rules)

    def without(self, topics: Collection[str], rules: Collection[str] = ()) -> Grammar:
        """The same rules, where some, and those about one of these topics, are commands no more."""
        silent = frozenset(
            key
            for key in self.public_rules
            if {key, self.rules[key].stands_for} & frozenset(rules)
            or self.rules[key].topics & frozenset(topics)
        )
        if not silent:
            return self
        # Kept, with all that is made of it, for whoever leaves out the same.
        kept: dict[frozenset[str], Grammar] = self.made(_quieter)
        if silent not in kept:
            found = {
                key: replace(rule, is_public=False) if key in silent else rule
                for key, rule in self.rules.items()
            }
            kept.clear()
            kept[silent] = replace(self, rules=found)
        return kept[silent]

    def called(self, name: str) -> Grammar:
        """The same rules for a robot with a name, which rules that are marked @name know then."""
        words = tuple(Token(word, _NOWHERE) for word in normalize(name))
        if not words:
            return self
        # Kept for the next robot of that name, with all that is made of it.
        names: dict[tuple[Token, ...], Grammar] = self.made(_names)
        if (known := names.get(words)) is not None:
            return known
        rules = {
            key: replace(rule, expression=_either(rule.expression, Sequence(words, _NOWHERE)))
            if "name" in rule.marks
            else rule
            for key, rule in self.rules.items()
        }
        called = replace(self, rules=rules)
        names.clear()
        names[words] = called
        return called

    def words(self) -> frozenset[str]:
        """All words that can be said, lower case."""
        return analysis.words_of(self.rules, self.public_rules)

    def has_words(self) -> bool:
        """Whether any word can be said."""
        return any(isinstance(node, Token) for node in self._nodes())

    def tag_names(self, rule: str = "") -> frozenset[str]:
        """Names of all tags that an understood sentence, perhaps only of one rule, may have."""
        return analysis.tag_names(self, [rule] if rule else self.public_rules)

    def _nodes(self) -> Iterator[Expression]:
        for key in analysis.reachable(self.rules, self.public_rules):
            yield from self.rules[key].nodes

    def flat_jsgf(self, rules: Collection[str] | None = None) -> str:
        """The same sentences, perhaps only those of some rules, as JSGF with a single public rule,
        without tags and imports.
        """
        return flat_jsgf(self, self.public_rules if rules is None else rules)

    def sentences(self, limit: int) -> Iterable[str]:
        """Sentences of the grammar, at most `limit`, the public rules taking turns."""
        return expansion.sentences(self, self.public_rules, limit)

    def sample(self, most: int, rules: Collection[str] | None = None) -> list[str]:
        """Different sentences, at most so many: all, or the first of each rule and as many others
        by chance, always the same. None has free words. `rules` are public ones; None is all.
        """
        return expansion.sample(self, most, self.public_rules if rules is None else rules)

    def sentences_of(self, rule: str, limit: int) -> Iterable[str]:
        """Sentences of one rule, at most `limit`."""
        return expansion.sentences(self, (rule,), limit)

    @property
    def automaton(self) -> Automaton:
        """The public rules written out as arcs; raises AuthoringError when they are too many."""
        return self.made(build)

    @property
    def matcher(self) -> Matcher:
        """Follows sentences; see `hri.speech.grammar.matching`."""
        return self.made(matcher_of)

    def graph(self) -> WordGraph:
        """Which word may follow which; made once. Raises what `automaton` raises."""
        return self.made(_graph)

    @property
    def recursive_rules(self) -> frozenset[str]:
        """Keys of the rules that lead back to themselves."""
        return self.made(analysis.recursive_of)

    @property
    def used_first(self) -> list[str]:
        """All keys, each behind those it refers to; in a circle one of them comes too early."""
        return self.made(analysis.order_of)


def _either(one: Expression, other: Expression) -> Expression:
    return Alternative((one, other), (1.0, 1.0), one.span)


def _names(rules: Rules) -> dict[tuple[Token, ...], Grammar]:
    """The rules by the name that the robot was called last."""
    return {}


def _quieter(rules: Rules) -> dict[frozenset[str], Grammar]:
    """The rules by the topics that were left out last."""
    return {}


def _graph(rules: Rules) -> WordGraph:
    graph = word_graph(rules.made(build_spoken))
    slots = rules.made(spoken_slots)
    found = {word: slots[word] for word in graph.words if word in slots}
    return replace(graph, expected=rules.marked("answer"), slots=found)


def flat_jsgf(grammar: Grammar, rules: Collection[str]) -> str:
    """See `Grammar.flat_jsgf`. PocketSphinx knows one public rule only and no dots in names.

    What can never be said is left out: with a `<VOID>` anywhere it hears nothing of the rest. So
    are parts with free words, which no other engine knows; words said beside commands, which
    PocketSphinx would hear in everything; and rules with a topic: among all the small talk it
    mistakes every second command.
    """
    unsaid = {key for key, rule in grammar.rules.items() if "aside" in rule.marks}
    sayable = _Sayable(grammar.made(analysis.heights), unsaid)
    said = {}
    for key in grammar.used_first:
        said[key] = sayable(grammar.rules[key].expression)
        if said[key] is None:
            unsaid.add(key)
    spoken = frozenset(rules) - grammar.marked("typed")
    public = [
        key
        for key in grammar.public_rules
        if key in spoken and said[key] is not None and not grammar.rules[key].topics
    ]
    keys = [key for key in analysis.reachable(grammar.rules, public) if said[key] is not None]
    names = {
        key: f"r{number}_{re.sub(r'[^A-Za-z0-9]', '_', key)}" for number, key in enumerate(keys)
    }
    rare = grammar.marked("answer")
    top = " | ".join(f"/{RARE if key in rare else 1}/ <{names[key]}>" for key in public) or "<VOID>"
    lines = ["#JSGF V1.0;", "grammar flat;", f"public <sentence> = {top};"]
    for key in keys:
        kept = said[key]
        if kept is not None:
            expression = mapped(
                kept, RuleReference, lambda node: replace(node, name=names[node.name])
            )
            lines.append(f"<{names[key]}> = {spell(expression)};")
    return "\n".join(lines) + "\n"


class _Sayable(Fold[Expression | None]):
    """A node without its parts that have no sentence; None when it has none itself."""

    def __init__(self, heights: Mapping[str, float], unsaid: Collection[str]) -> None:
        """`heights` are those of the rules; `unsaid` are rules that count as never said."""
        self._heights, self._unsaid = heights, unsaid

    def word(self, node: Token) -> Expression:
        return node

    def anything(self, node: Anything) -> None:
        return None

    def reference(self, node: RuleReference) -> Expression | None:
        is_said = node.name not in self._unsaid and not math.isinf(self._heights[node.name])
        return node if is_said else None

    def row(self, node: Sequence, parts: Iterator[Expression | None]) -> Expression | None:
        items = list(parts)
        kept = tuple(item for item in items if item is not None)
        return replace(node, items=kept) if len(kept) == len(items) else None

    def choice(self, node: Alternative, parts: Iterator[Expression | None]) -> Expression | None:
        weights = [weight for weight in node.weights if weight > 0.0]
        kept = [(part, odds) for part, odds in zip(parts, weights, strict=True) if part is not None]
        if not kept:
            return None
        choices, odds = (tuple(part for part, _ in kept), tuple(odds for _, odds in kept))
        return replace(node, choices=choices, weights=odds)

    def optional(self, node: Optional, part: Expression | None) -> Expression:
        return Sequence((), node.span) if part is None else Optional(part, node.span)

    def repeated(self, node: Repeat, part: Expression | None) -> Expression | None:
        return None if part is None else Repeat(part, 1, node.span)
