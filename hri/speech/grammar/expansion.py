"""Sentences of a grammar: all in turn, or one by chance."""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from hri.speech.grammar.analysis import height
from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    Tagged,
    Token,
)

if TYPE_CHECKING:
    from hri.speech.grammar.rules import Grammar

Words = tuple[str, ...]

SPARE_DEPTH = 4
"""Rules that may be entered beyond the shortest way; bounds what recursion brings."""
DEEPEST = 60
"""Rules within rules; what is deeper is left out."""
MOST_REPEATS = 2


def sentences(grammar: Grammar, rules: Iterable[str], limit: int) -> Iterator[str]:
    """Different sentences, at most `limit`, the rules taking turns.

    Repeats are said at most twice, and recursion goes a few rules deep.
    """
    ways = [
        _ways(grammar, RuleReference(key, grammar.rules[key].span), _depth(grammar, key))
        for key in rules
    ]
    seen: set[Words] = {()}
    while ways and limit > 0:
        for way in tuple(ways):
            words = next((words for words in way if words not in seen), None)
            if words is None:
                ways.remove(way)
            elif limit > 0:
                seen.add(words)
                limit -= 1
                yield " ".join(words)


def _depth(grammar: Grammar, key: str) -> int:
    return min(int(min(grammar.heights[key], DEEPEST)) + 1 + SPARE_DEPTH, DEEPEST)


def _ways(grammar: Grammar, node: Expression, depth: int) -> Iterator[Words]:
    """All ways through a node that enter at most `depth` rules; none is a dead end."""
    if height(node, grammar.heights) > depth:
        return
    match node:
        case Token(text=text):
            yield (text,)
        case RuleReference(name=name):
            yield from _ways(grammar, grammar.rules[name].expression, depth - 1)
        case Sequence(items=items):
            yield from _in_turn(grammar, items, depth)
        case Alternative(choices=choices):
            for choice in choices:
                yield from _ways(grammar, choice, depth)
        case Optional(item=item):
            yield ()
            yield from _ways(grammar, item, depth)
        case Repeat(item=item, minimum=minimum):
            for count in range(minimum, MOST_REPEATS + 1):
                yield from _in_turn(grammar, (item,) * count, depth)
        case Tagged(item=item):
            yield from _ways(grammar, item, depth)


def _in_turn(grammar: Grammar, items: tuple[Expression, ...], depth: int) -> Iterator[Words]:
    if not items:
        yield ()
        return
    for first in _ways(grammar, items[0], depth):
        for rest in _in_turn(grammar, items[1:], depth):
            yield first + rest


def random_sentence(grammar: Grammar, chance: random.Random) -> str:
    """A sentence drawn by the weights; may be empty when the grammar allows silence."""
    key = chance.choice(grammar.public_rules)
    reference = RuleReference(key, grammar.rules[key].span)
    return " ".join(_draw(grammar, reference, _depth(grammar, key), chance))


def _draw(grammar: Grammar, node: Expression, depth: int, chance: random.Random) -> Words:
    match node:
        case Token(text=text):
            return (text,)
        case RuleReference(name=name):
            return _draw(grammar, grammar.rules[name].expression, depth - 1, chance)
        case Sequence(items=items):
            return _draw_all(grammar, items, depth, chance)
        case Alternative(choices=choices, weights=weights):
            open_ways = [
                (choice, weight)
                for choice, weight in zip(choices, weights, strict=True)
                if height(choice, grammar.heights) <= max(depth, height(node, grammar.heights))
            ]
            ways, odds = zip(*open_ways, strict=True)
            odds = odds if sum(odds) > 0 else (1.0,) * len(odds)
            return _draw(grammar, chance.choices(ways, odds)[0], depth, chance)
        case Optional(item=item):
            if height(item, grammar.heights) > depth or chance.random() < 0.5:
                return ()
            return _draw(grammar, item, depth, chance)
        case Repeat(item=item, minimum=minimum):
            most = MOST_REPEATS if height(item, grammar.heights) <= depth else minimum
            count = chance.randint(minimum, most)
            return _draw_all(grammar, (item,) * count, depth, chance)
        case Tagged(item=item):
            return _draw(grammar, item, depth, chance)


def _draw_all(
    grammar: Grammar, items: tuple[Expression, ...], depth: int, chance: random.Random
) -> Words:
    drawn = (_draw(grammar, item, depth, chance) for item in items)
    return tuple(itertools.chain.from_iterable(drawn))
