"""A grammar: rules that say which sentences are understood, and what they mean."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from hri.core.errors import Place
from hri.hal.word_graph import WordGraph
from hri.speech.grammar import analysis, expansion
from hri.speech.grammar.automaton import Automaton, build
from hri.speech.grammar.doc_comments import MARKS, DocTag
from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    SourceSpan,
    Tagged,
    Token,
    rename,
    spell,
    walk,
)
from hri.speech.grammar.graph import word_graph
from hri.speech.grammar.jsgf import Import, NameListImport
from hri.speech.grammar.matching import Matcher


@dataclass(frozen=True)
class Rule:
    """One rule of a grammar, with where it came from."""

    key: str
    """Its name in `Grammar.rules`: short in the main file, `grammar.name` when imported."""
    expression: Expression
    is_public: bool
    span: SourceSpan
    path: Path
    doc: str = ""
    """The words of the doc comment before it."""
    doc_tags: tuple[DocTag, ...] = ()
    """The `@name text` of that comment."""

    @cached_property
    def nodes(self) -> tuple[Expression, ...]:
        """Its expression and all below it, in the order of writing."""
        return tuple(walk(self.expression))

    @cached_property
    def references(self) -> tuple[RuleReference, ...]:
        """All that its expression holds, in the order of writing."""
        return tuple(node for node in self.nodes if isinstance(node, RuleReference))

    @cached_property
    def marks(self) -> frozenset[str]:
        """Those of `hri.speech.grammar.doc_comments.MARKS` that its comment sets."""
        return frozenset(tag.name for tag in self.doc_tags if tag.name in MARKS)

    @property
    def examples(self) -> tuple[str, ...]:
        """Sentences that its comment promises to be understood."""
        return tuple(tag.text for tag in self.doc_tags if tag.name == "example")

    def place(self, span: SourceSpan | None = None) -> Place:
        """The spot of a node of this rule; without one, of the rule itself."""
        span = span or self.span
        return Place(self.path, span.line, span.column)


@dataclass(frozen=True)
class Grammar:
    """Rules by key; what the public ones allow is understood."""

    name: str
    path: Path
    rules: dict[str, Rule]
    broken: frozenset[str] = frozenset()
    """Keys of rules that are there but could not be read; empty in a grammar that is used."""
    locale: str = ""
    """The language its header names, such as "en" or "en-US"."""
    idle_imports: tuple[Import | NameListImport, ...] = ()
    """Imports of the main file that bring nothing it uses."""
    names: frozenset[str] = frozenset()
    """What the main file may call rules: its own, and imported ones in short and in full."""

    @cached_property
    def public_rules(self) -> tuple[str, ...]:
        """Names of the public rules of the main file, in its order; imported ones only help."""
        return tuple(key for key, rule in self.rules.items() if rule.is_public)

    @property
    def is_english(self) -> bool:
        """Whether its header names English, or no language."""
        return not self.locale or self.locale.lower().startswith("en")

    def with_commands(self, keys: Collection[str]) -> Grammar:
        """The same rules, with some of them, public or not, as the only commands."""
        rules = {key: replace(rule, is_public=key in keys) for key, rule in self.rules.items()}
        return replace(self, rules=rules)

    def marked(self, mark: str) -> frozenset[str]:
        """The public rules with a mark, which is one of `doc_comments.MARKS`."""
        return self._marked[mark]

    @cached_property
    def _marked(self) -> dict[str, frozenset[str]]:
        of_rules = [(key, self.rules[key].marks) for key in self.public_rules]
        return {mark: frozenset(key for key, marks in of_rules if mark in marks) for mark in MARKS}

    def words(self) -> frozenset[str]:
        """All words that can be said, lower case."""
        return frozenset(node.text for node in self._nodes() if isinstance(node, Token))

    def has_words(self) -> bool:
        """Whether any word can be said."""
        return any(isinstance(node, Token) for node in self._nodes())

    def tag_names(self, rule: str = "") -> frozenset[str]:
        """Names of all tags that an understood sentence, perhaps only of one rule, may have."""
        tagged = [node for node in self._nodes(rule) if isinstance(node, Tagged)]
        entries = [entry for node in tagged for entry in node.entries]
        used_up = {name for entry in entries for name in entry.takes if name != entry.name}
        return frozenset({entry.name for entry in entries} - used_up)

    def _nodes(self, rule: str = "") -> Iterator[Expression]:
        for key in analysis.reachable(self.rules, [rule] if rule else self.public_rules):
            yield from self.rules[key].nodes

    def flat_jsgf(self) -> str:
        """The same sentences as JSGF with a single public rule, without tags and imports."""
        return flat_jsgf(self)

    def sentences(self, limit: int) -> Iterable[str]:
        """Sentences of the grammar, at most `limit`, the public rules taking turns."""
        return expansion.sentences(self, self.public_rules, limit)

    def sample(self, most: int) -> list[str]:
        """Different sentences, at most so many: all, or the first of each rule and as many others
        by chance, always the same.
        """
        return expansion.sample(self, most)

    def sentences_of(self, rule: str, limit: int) -> Iterable[str]:
        """Sentences of one rule, at most `limit`."""
        return expansion.sentences(self, (rule,), limit)

    @cached_property
    def automaton(self) -> Automaton:
        """The public rules written out as arcs; raises AuthoringError when they are too many."""
        return build(self)

    @cached_property
    def matcher(self) -> Matcher:
        """Follows sentences; see `hri.speech.grammar.matching`."""
        return Matcher(self.automaton)

    @cached_property
    def _graph(self) -> WordGraph:
        return word_graph(self.automaton)

    def graph(self) -> WordGraph:
        """Which word may follow which; made once. Raises what `automaton` raises."""
        return self._graph

    @cached_property
    def ways(self) -> expansion.Ways:
        """What walks through the rules to make sentences."""
        return expansion.Ways(self)

    @cached_property
    def heights(self) -> dict[str, float]:
        """How deep into recursive rules the shortest sentence of each goes; infinite without."""
        return analysis.heights(self)

    @cached_property
    def recursive_rules(self) -> frozenset[str]:
        """Keys of the rules that lead back to themselves."""
        return analysis.recursive_rules(self.rules)

    @cached_property
    def silent_rules(self) -> dict[str, bool]:
        """Whether each rule can be passed without a word."""
        return analysis.silent_rules(self)

    @cached_property
    def used_first(self) -> list[str]:
        """All keys, each behind those it refers to; in a circle one of them comes too early."""
        return analysis.used_first(self.rules)


def flat_jsgf(grammar: Grammar) -> str:
    """See `Grammar.flat_jsgf`. PocketSphinx knows one public rule only and no dots in names.

    What can never be said is left out: with a `<VOID>` anywhere it hears nothing of the rest.
    """
    said = {key: _sayable(rule.expression, grammar) for key, rule in grammar.rules.items()}
    public = [key for key in grammar.public_rules if said[key] is not None]
    keys = [key for key in analysis.reachable(grammar.rules, public) if said[key] is not None]
    names = {
        key: f"r{number}_{re.sub(r'[^A-Za-z0-9]', '_', key)}" for number, key in enumerate(keys)
    }
    top = " | ".join(f"<{names[key]}>" for key in public) or "<VOID>"
    lines = ["#JSGF V1.0;", "grammar flat;", f"public <sentence> = {top};"]
    for key in keys:
        kept = said[key]
        if kept is not None:
            expression = rename(kept, lambda node: replace(node, name=names[node.name]))
            lines.append(f"<{names[key]}> = {spell(expression)};")
    return "\n".join(lines) + "\n"


def _sayable(node: Expression, grammar: Grammar) -> Expression | None:
    """The node without its parts that have no sentence; None when it has none itself."""
    if math.isinf(analysis.height(node, grammar.heights)):
        return None
    match node:
        case Alternative(choices=choices, weights=weights):
            kept = [
                (said, weight)
                for choice, weight in zip(choices, weights, strict=True)
                if (said := _sayable(choice, grammar)) is not None
            ]
            return replace(
                node,
                choices=tuple(said for said, _ in kept),
                weights=tuple(weight for _, weight in kept),
            )
        case Sequence(items=items):
            rows = [_sayable(item, grammar) for item in items]
            return replace(node, items=tuple(row for row in rows if row is not None))
        case Optional(item=item) | Repeat(item=item) | Tagged(item=item):
            said = _sayable(item, grammar)
            return Sequence((), node.span) if said is None else replace(node, item=said)
        case _:
            return node
