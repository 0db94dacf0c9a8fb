"""The rules of a grammar as data: what may be said, and where it was written."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

from hri.core.errors import AuthoringError, Place
from hri.speech.grammar.doc_comments import MARKS, TOPIC, DocTag
from hri.speech.grammar.expressions import Expression, RuleReference, SourceSpan, Tagged, walk
from hri.speech.grammar.jsgf import Import, KnownListImport, NameListImport
from hri.speech.grammar.paraphrases import Paraphrases
from hri.speech.grammar.tags import TagEntry

T = TypeVar("T")


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
    def tag_entries(self) -> tuple[TagEntry, ...]:
        """Those of all its tags, in the order of writing."""
        tagged = (node for node in self.nodes if isinstance(node, Tagged))
        return tuple(entry for node in tagged for entry in node.entries)

    @cached_property
    def marks(self) -> frozenset[str]:
        """Those of `hri.speech.grammar.doc_comments.MARKS` that its comment sets."""
        return frozenset(tag.name for tag in self.doc_tags if tag.name in MARKS)

    @cached_property
    def topics(self) -> frozenset[str]:
        """What its comment says it is about, the words behind @topic."""
        texts = (tag.text for tag in self.doc_tags if tag.name == TOPIC)
        return frozenset(word for text in texts for word in text.split())

    @cached_property
    def after(self) -> tuple[str, ...]:
        """The commands after which it counts; empty for a rule that always does."""
        return tuple(name for tag in self.doc_tags if tag.name == "after" for name in _names(tag))

    @cached_property
    def stands_for(self) -> str:
        """The command that it means: another rule, or `LAST`; empty for one that means itself."""
        return next((tag.text for tag in self.doc_tags if tag.name == "as"), "")

    @property
    def examples(self) -> tuple[str, ...]:
        """Sentences that its comment promises to be understood."""
        return tuple(tag.text for tag in self.doc_tags if tag.name == "example")

    def place(self, span: SourceSpan | None = None) -> Place:
        """The spot of a node of this rule; without one, of the rule itself."""
        span = span or self.span
        return Place(self.path, span.line, span.column)


def _names(tag: DocTag) -> list[str]:
    """Rules that stand behind a mark, with or without angle brackets."""
    return [name.strip("<>,") for name in tag.text.split()]


@dataclass(frozen=True)
class Rules:
    """Rules by key; what the public ones allow is understood. `Grammar` makes use of them."""

    name: str
    path: Path
    rules: dict[str, Rule]
    broken: frozenset[str] = frozenset()
    """Keys of rules that are there but could not be read; empty in a grammar that is used."""
    locale: str = ""
    """The language its header names, such as "en" or "en-US"."""
    idle_imports: tuple[Import | NameListImport | KnownListImport, ...] = ()
    """Imports of the main file that bring nothing it uses."""
    names: frozenset[str] = frozenset()
    """What the main file may call rules: its own, and imported ones in short and in full."""
    warnings: tuple[AuthoringError, ...] = ()
    """What is odd about how its files are written, and costs no rule."""
    known_lists: tuple[KnownListImport, ...] = ()
    """The imports of the main file that say what free slots usually are."""
    known: Mapping[str, tuple[str, ...]] = field(default_factory=dict, repr=False)
    """What free slots usually are, by their names: lower case words with one space between."""
    paraphrases: tuple[Paraphrases, ...] = field(default=(), repr=False)
    """Those that lie beside its files."""
    _made: dict[Callable[..., Any], Any] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def made(self, make: Callable[[Rules], T]) -> T:
        """What a function makes of these rules, made once."""
        if make not in self._made:
            self._made[make] = make(self)
        found: T = self._made[make]
        return found

    @cached_property
    def public_rules(self) -> tuple[str, ...]:
        """Names of the public rules of the main file, in its order; imported ones only help."""
        return tuple(key for key, rule in self.rules.items() if rule.is_public)

    @cached_property
    def spoken_rules(self) -> tuple[str, ...]:
        """The public rules that count by voice, too."""
        typed = self.marked("typed")
        return tuple(key for key in self.public_rules if key not in typed)

    @cached_property
    def topics(self) -> frozenset[str]:
        """What the public rules are about."""
        return frozenset().union(*(self.rules[key].topics for key in self.public_rules))

    def marked(self, mark: str) -> frozenset[str]:
        """The public rules with a mark, which is one of `doc_comments.MARKS`."""
        return self._marked[mark]

    @cached_property
    def _marked(self) -> dict[str, frozenset[str]]:
        of_rules = [(key, self.rules[key].marks) for key in self.public_rules]
        return {mark: frozenset(key for key, marks in of_rules if mark in marks) for mark in MARKS}
