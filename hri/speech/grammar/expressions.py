"""The tree of a grammar: what may follow what, each node with the place it was written at."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from hri.speech.grammar.tags import TagEntry


@dataclass(frozen=True, slots=True)
class Span:
    """Where something stands in its file; line and column count from 1, the end is past it."""

    line: int
    column: int
    end_line: int
    end_column: int


@dataclass(frozen=True, slots=True)
class Token:
    """One word, lower case."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class RuleReference:
    """`<name>`; after loading, the key of the rule in `Grammar.rules`."""

    name: str
    span: Span


@dataclass(frozen=True, slots=True)
class Sequence:
    """One thing after the other; without items it is `<NULL>`, which is silent."""

    items: tuple[Expression, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Alternative:
    """One of several; without choices it is `<VOID>`, which can never be said."""

    choices: tuple[Expression, ...]
    weights: tuple[float, ...]
    """How likely each choice is, against the others; as many as choices."""
    span: Span


@dataclass(frozen=True, slots=True)
class Optional:
    """`[item]`."""

    item: Expression
    span: Span


@dataclass(frozen=True, slots=True)
class Repeat:
    """`item*` or `item+`."""

    item: Expression
    minimum: int
    """0 or 1."""
    span: Span


@dataclass(frozen=True, slots=True)
class Tagged:
    """`item {tags}`: the tags are applied after those inside the item."""

    item: Expression
    entries: tuple[TagEntry, ...]
    span: Span


Expression = Token | RuleReference | Sequence | Alternative | Optional | Repeat | Tagged


def children(node: Expression) -> tuple[Expression, ...]:
    """The nodes directly below."""
    match node:
        case Sequence(items=below) | Alternative(choices=below):
            return below
        case Optional(item=item) | Repeat(item=item) | Tagged(item=item):
            return (item,)
        case _:
            return ()


def walk(node: Expression) -> Iterator[Expression]:
    """The node and all below it, in the order they were written."""
    pending = [node]
    while pending:
        node = pending.pop()
        yield node
        pending.extend(reversed(children(node)))


def rename(node: Expression, key_of: Callable[[RuleReference], str]) -> Expression:
    """The same tree with another name in each reference."""
    match node:
        case RuleReference():
            return replace(node, name=key_of(node))
        case Sequence(items=items):
            return replace(node, items=tuple(rename(item, key_of) for item in items))
        case Alternative(choices=choices):
            return replace(node, choices=tuple(rename(choice, key_of) for choice in choices))
        case Optional(item=item) | Repeat(item=item) | Tagged(item=item):
            return replace(node, item=rename(item, key_of))
        case _:
            return node


def spell(node: Expression) -> str:
    """The expression as JSGF without tags, each part in brackets where it needs them."""
    match node:
        case Token(text=text):
            return text
        case RuleReference(name=name):
            return f"<{name}>"
        case Sequence(items=()):
            return "<NULL>"
        case Alternative(choices=()):
            return "<VOID>"
        case Sequence(items=items):
            return "(" + " ".join(spell(item) for item in items) + ")"
        case Alternative(choices=choices, weights=weights):
            return "(" + " | ".join(map(_weighted, choices, weights)) + ")"
        case Optional(item=item):
            return f"[{spell(item)}]"
        case Repeat(item=item, minimum=minimum):
            return f"({spell(item)}){'+' if minimum else '*'}"
        case Tagged(item=item):
            return spell(item)


def _weighted(choice: Expression, weight: float) -> str:
    return spell(choice) if weight == 1.0 else f"/{weight:.6f}/ {spell(choice)}"
