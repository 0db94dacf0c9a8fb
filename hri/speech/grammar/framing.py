"""What may be said before a sentence and behind it."""

from __future__ import annotations

from hri.speech.grammar.expressions import Alternative, Expression, Sequence, SourceSpan

AROUND = (1.0, 0.05)
"""Odds of nothing, and of what may be said before or behind a sentence."""
_NOTHING = Sequence((), SourceSpan(1, 1, 1, 1))


def framed(body: Expression, before: Expression | None, after: Expression | None) -> Expression:
    """What a rule says, between what may be said before and behind it, where there is such."""
    first, last = (
        [] if node is None else [Alternative((_NOTHING, node), AROUND, node.span)]
        for node in (before, after)
    )
    row = (*first, body, *last)
    return body if len(row) == 1 else Sequence(row, body.span)
