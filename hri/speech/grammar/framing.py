"""What may be said before a sentence and behind it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hri.speech.grammar.expressions import Alternative, Expression, Sequence, SourceSpan

AROUND = (1.0, 0.05)
"""Odds of nothing, and of what may be said before or behind a sentence."""
NOTHING = Sequence((), SourceSpan(1, 1, 1, 1))


@dataclass(frozen=True, slots=True)
class Frame(Alternative):
    """What may be said, or not, before sentences or behind them: the same for many rules."""


def framed(body: Expression, before: Expression | None, after: Expression | None) -> Expression:
    """A rule's body between the optional words before and behind it, if it has any."""
    first, last = (
        [] if node is None else [Frame((NOTHING, node), AROUND, node.span)]
        for node in (before, after)
    )
    row = (*first, body, *last)
    return body if len(row) == 1 else Sequence(row, body.span)


@dataclass(frozen=True, slots=True)
class Framed:
    """A sentence, and the frames around it in the order in which they are said."""

    before: tuple[Frame, ...]
    body: Expression
    after: tuple[Frame, ...]


def unframed(expression: Expression) -> Framed:
    """A rule's expression, taken apart."""
    items = expression.items if isinstance(expression, Sequence) else (expression,)
    before = tuple(_leading(items))
    rest = items[len(before) :]
    after = tuple(_leading(rest[::-1]))[::-1]
    rest = rest[: len(rest) - len(after)]
    return Framed(before, rest[0] if len(rest) == 1 else Sequence(rest, expression.span), after)


def _leading(items: tuple[Expression, ...]) -> Iterator[Frame]:
    for item in items:
        if not isinstance(item, Frame):
            return
        yield item
