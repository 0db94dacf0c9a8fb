"""The tree of a grammar: the possible orders of words, each node with its place in the file."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from decimal import Decimal
from operator import is_
from typing import NamedTuple, TypeVar

from hri.speech.grammar.tags import TagEntry, spell_entries
from hri.speech.grammar.words import ANY, MOST_FREE, MOST_SPOKEN

_PLAIN = re.compile(r"""[^\s=;|*+<>()\[\]{}/"\\]+(?:/[^\s=;|*+<>()\[\]{}/"\\]+)*""")


class SourceSpan(NamedTuple):
    """Where something stands in its file; line and column count from 1, the end is past it."""

    line: int
    column: int
    end_line: int
    end_column: int


@dataclass(frozen=True, slots=True)
class Token:
    """One word, lower case."""

    text: str
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Anything:
    """`<any>`, `<any 2>`, `<any 1-3>`: words that nobody has listed; `<name.spoken>`: a free slot,
    such words that set a tag.
    """

    span: SourceSpan
    least: int = 1
    most: int = MOST_FREE
    """How many words."""
    slot: str = ""
    """The tag that its words are the value of; empty for `<any>`."""

    @property
    def text(self) -> str:
        """As few of them as there may be."""
        return " ".join([ANY] * self.least)

    @property
    def written(self) -> str:
        """As grammars have it, and word graphs."""
        name = f"{self.slot}.spoken" if self.slot else "any"
        if (self.least, self.most) == (1, MOST_SPOKEN if self.slot else MOST_FREE):
            return f"<{name}>"
        most = f"-{self.most}" if self.most > self.least else ""
        return f"<{name} {self.least}{most}>"


@dataclass(frozen=True, slots=True)
class RuleReference:
    """`<name>`; after loading, the key of the rule in `Grammar.rules`."""

    name: str
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Sequence:
    """One thing after the other; without items it is `<NULL>`, which is silent."""

    items: tuple[Expression, ...]
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Alternative:
    """One of several; without choices it is `<VOID>`, which can never be said."""

    choices: tuple[Expression, ...]
    weights: tuple[float, ...]
    """How likely each choice is, against the others; as many as choices."""
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Optional:
    """`[item]`."""

    item: Expression
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Repeat:
    """`item*` or `item+`."""

    item: Expression
    minimum: int
    """0 or 1."""
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Tagged:
    """`item {tags}`: the tags are applied after those inside the item."""

    item: Expression
    entries: tuple[TagEntry, ...]
    span: SourceSpan


Expression = Token | Anything | RuleReference | Sequence | Alternative | Optional | Repeat | Tagged


N = TypeVar("N", Token, RuleReference)


def children(node: Expression) -> tuple[Expression, ...]:
    """The nodes directly below."""
    match node:
        case Token() | Anything() | RuleReference():
            return ()
        case Sequence(items=below) | Alternative(choices=below):
            return below
        case Optional(item=item) | Repeat(item=item) | Tagged(item=item):
            return (item,)


def walk(node: Expression) -> Iterator[Expression]:
    """The node and all below it, in the order they were written."""
    pending = [node]
    while pending:
        node = pending.pop()
        yield node
        pending.extend(reversed(children(node)))


def depth(node: Expression) -> int:
    """How many nodes stand below each other, the node itself included."""
    level, nodes = 0, [node]
    while nodes:
        level += 1
        nodes = [below for node in nodes for below in children(node)]
    return level


def heard_choices(node: Alternative) -> tuple[Expression, ...]:
    """The choices that can be heard: a weight of 0 is as good as none (JSGF 1.0)."""
    if 0.0 not in node.weights:
        return node.choices
    return tuple(
        choice for choice, weight in zip(node.choices, node.weights, strict=True) if weight > 0.0
    )


def mapped(node: Expression, kind: type[N], change: Callable[[N], Expression]) -> Expression:
    """The same tree with something else for its references, or for its words.

    What stays the same is shared.
    """
    if isinstance(node, kind):
        return change(node)
    match node:
        case Sequence(items=items):
            changed = _mapped_all(items, kind, change)
            return node if changed is items else replace(node, items=changed)
        case Alternative(choices=choices):
            changed = _mapped_all(choices, kind, change)
            return node if changed is choices else replace(node, choices=changed)
        case Optional(item=item) | Repeat(item=item) | Tagged(item=item):
            inside = mapped(item, kind, change)
            return node if inside is item else replace(node, item=inside)
        case _:
            return node


def _mapped_all(
    nodes: tuple[Expression, ...], kind: type[N], change: Callable[[N], Expression]
) -> tuple[Expression, ...]:
    are_words_kept = kind is not Token
    changed = [
        node if are_words_kept and type(node) is Token else mapped(node, kind, change)
        for node in nodes
    ]
    return nodes if all(map(is_, changed, nodes)) else tuple(changed)


def spell(node: Expression) -> str:
    """The expression as JSGF without tags, with brackets where they are needed."""
    return _spell(node, _CHOICE, lambda tagged: "")


def spell_tagged(node: Expression) -> str:
    """The expression as JSGF with its tags; `read_jsgf` makes the same tree of it."""
    return _spell(node, _CHOICE, lambda tagged: " {" + _escape(spell_entries(tagged.entries)) + "}")


_CHOICE, _ROW, _ITEM = range(3)
"""How tightly a thing holds together: alternatives least, then sequences (JSGF 1.0, 4.7)."""


def _spell(node: Expression, least: int, tags: Callable[[Tagged], str]) -> str:
    """The node in brackets when it holds together less tightly than it must."""
    match node:
        case Token(text=text):
            return text if _is_plain(text) else _quoted(text)
        case Anything():
            return node.written
        case RuleReference(name=name):
            return f"<{name}>"
        case Sequence(items=()):
            return "<NULL>"
        case Alternative(choices=()):
            return "<VOID>"
        case Sequence(items=items):
            spelled = " ".join([_spell(item, _ITEM, tags) for item in items])
            return f"({spelled})" if least > _ROW else spelled
        case Alternative(choices=choices, weights=weights):
            rows = [_spell(choice, _ROW, tags) for choice in choices]
            spelled = " | ".join(map(_weighted, rows, weights))
            return f"({spelled})" if least > _CHOICE else spelled
        case Optional(item=item):
            return f"[{_spell(item, _CHOICE, tags)}]"
        case Repeat(item=item, minimum=minimum):
            return _spell(item, _ITEM, tags) + "*+"[minimum]
        case Tagged(item=item):
            return _spell(item, _ITEM, tags) + tags(node)


def _is_plain(word: str) -> bool:
    """Whether a word is read as one without quotes."""
    return bool(_PLAIN.fullmatch(word)) and word not in ("public", "import")


def _quoted(word: str) -> str:
    return '"' + word.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _weighted(spelled: str, weight: float) -> str:
    # Without an exponent, which not every reader knows.
    return spelled if weight == 1.0 else f"/{Decimal(repr(weight)):f}/ {spelled}"


def _escape(text: str) -> str:
    return text.replace("\\", "\\\\").replace("{", "\\{").replace("}", "\\}")
