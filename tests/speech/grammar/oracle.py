"""What grammars mean, worked out in the plainest way: to compare the quick one with."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch

from hypothesis import assume, strategies as st

from hri.core.errors import AuthoringError
from hri.speech.grammar import Grammar, Rule, automaton
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
)
from hri.speech.grammar.framing import framed
from hri.speech.grammar.tags import TagEntry, evaluate

SPAN = SourceSpan(1, 1, 1, 1)
Reading = tuple[tuple[object, ...], tuple[tuple[TagEntry, ...], ...]]
"""The words and rules of a tree, and the tags in order."""


def readings(
    grammar: Grammar, node: Expression, words: tuple[str, ...], begin: int, end: int
) -> Iterator[Reading]:
    """All ways through a node that say the words from `begin` to `end`."""
    match node:
        case Token(text=text):
            if words[begin:end] == (text,):
                yield (text,), ()
        case RuleReference(name=name):
            rule = grammar.rules[name]
            for children, groups in readings(grammar, rule.expression, words, begin, end):
                yield ((name, begin, end, children),), groups
        case Sequence(items=()):
            if begin == end:
                yield (), ()
        case Sequence(items=(first, *rest)):
            for middle in range(begin, end + 1):
                yield from pairs(
                    readings(grammar, first, words, begin, middle),
                    readings(grammar, Sequence(tuple(rest), SPAN), words, middle, end),
                )
        case Alternative(choices=choices, weights=weights):
            for choice, weight in zip(choices, weights, strict=True):
                if weight > 0.0:
                    yield from readings(grammar, choice, words, begin, end)
        case Optional(item=item):
            yield from readings(grammar, item, words, begin, end)
            if begin == end:
                yield (), ()
        case Repeat(item=item, minimum=minimum):
            if begin == end:
                yield from readings(grammar, item, words, begin, end) if minimum else [((), ())]
                return
            yield from readings(grammar, item, words, begin, end)
            for middle in range(begin + 1, end):
                yield from pairs(
                    readings(grammar, item, words, begin, middle),
                    readings(grammar, Repeat(item, 1, SPAN), words, middle, end),
                )
        case Tagged(item=item, entries=entries):
            for children, groups in readings(grammar, item, words, begin, end):
                yield children, (*groups, entries)


def pairs(earlier: Iterator[Reading], later: Iterator[Reading]) -> Iterator[Reading]:
    """Each of the earlier readings with each of the later ones behind it."""
    # The later ones may lead back here: they are asked for only where something stands before.
    if begun := list(earlier):
        for (one, groups), (other, more) in itertools.product(begun, later):
            yield one + other, groups + more


def meanings(grammar: Grammar, words: tuple[str, ...]) -> set[tuple[object, ...]]:
    """All different trees of a sentence with their tags."""
    return {
        (children[0], tuple(sorted(evaluate(groups).items())))
        for key in grammar.public_rules
        for children, groups in readings(grammar, RuleReference(key, SPAN), words, 0, len(words))
    }


WORDS = ("x", "y", "z")
RULES = ("a", "b", "c")


def _below(inner: st.SearchStrategy[Expression]) -> st.SearchStrategy[Expression]:
    some = st.lists(inner, min_size=1, max_size=3).map(tuple)
    entries = st.sampled_from("pqr").map(lambda name: (TagEntry(name, "+=", 1.0),))
    return st.one_of(
        some.map(lambda items: Sequence(items, SPAN)),
        some.map(lambda items: Alternative(items, (1.0, 0.0, 2.5)[: len(items)], SPAN)),
        some.map(lambda items: Alternative(items, (1.0,) * len(items), SPAN)),
        inner.map(lambda item: Optional(item, SPAN)),
        st.tuples(inner, st.sampled_from([0, 1])).map(lambda pair: Repeat(*pair, SPAN)),
        st.tuples(inner, entries).map(lambda pair: Tagged(*pair, SPAN)),
    )


def expressions() -> st.SearchStrategy[Expression]:
    """Small expressions of a few words and rules, recursive ones among them."""
    leaves = st.one_of(
        st.sampled_from(WORDS).map(lambda word: Token(word, SPAN)),
        st.sampled_from(WORDS).map(lambda word: Token(word, SPAN)),
        st.sampled_from(RULES).map(lambda name: RuleReference(name, SPAN)),
        st.just(Sequence((), SPAN)),
    )
    return st.recursive(leaves, _below, max_leaves=6)


def grammars() -> st.SearchStrategy[Grammar]:
    """Grammars of three rules, two of them public, some with the third before or behind them."""
    frames = st.sampled_from([None, RuleReference("c", SPAN)])
    commands = st.tuples(expressions(), frames, frames).map(lambda parts: framed(*parts))
    return st.tuples(commands, commands, expressions()).map(
        lambda bodies: Grammar(
            "test",
            Path("test.jsgf"),
            {
                key: Rule(key, body, key != "c", SPAN, Path("test.jsgf"))
                for key, body in zip(RULES, bodies, strict=True)
            },
        )
    )


def assume_written_out(grammar: Grammar) -> None:
    """Leave out grammars that are left-recursive, or large by chance."""
    with patch.object(automaton, "MOST_ARCS", 5_000):
        try:
            _ = grammar.automaton
        except AuthoringError as error:
            assume(False)
            raise AssertionError from error
