"""Sentences of a grammar: all in turn, one by chance, and how many there are.

Repeats are said at most twice here, and recursion goes a few rules deep. Choices of weight 0 are
never said. Free words are "<any>", those of free slots, too, unless `ShownWays` shows what they
usually are. The same arguments give the same sentences in the same order.
"""

from __future__ import annotations

import math
import random
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import accumulate, islice

from hri.core.errors import AuthoringError, Place
from hri.speech.grammar import analysis
from hri.speech.grammar.analysis import Height
from hri.speech.grammar.expressions import (
    Alternative,
    Anything,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    Tagged,
    Token,
    children,
    heard_choices,
)
from hri.speech.grammar.fold import Fold
from hri.speech.grammar.free_slots import spoken_slots
from hri.speech.grammar.rules import Rules
from hri.speech.grammar.words import ANY

Words = tuple[str, ...]

SPARE_DEPTH = 4
"""Recursive rules that may be entered beyond the shortest way."""
MOST_REPEATS = 2
MOST_STALE = 20_000
"""Ways that may give no new sentence before a rule counts as told to its end."""
MOST_STEPS = 200_000
"""Parts of one sentence, silent ones included."""
MOST_BITS = 4096
"""Of a number of ways; more count as infinite."""
MOST_COUNTED = 100_000
"""Ways up to which different sentences are counted."""
_SEED = 4

_Todo = tuple[Expression, int, "_Todo"] | None
"""What is still to be said: a node, how many rules may be entered, and what follows."""
_Said = tuple[str, "_Said"] | None
"""The words so far, the last one first."""


def sentences(
    grammar: Rules, rules: Iterable[str], limit: int, shown: type[Ways] | None = None
) -> Iterator[str]:
    """Different sentences, at most `limit`, the rules taking turns.

    A rule of which MOST_STALE ways in a row bring nothing new gives no more. `shown` is
    `ShownWays` for words that free slots usually have.
    """
    ways = [grammar.made(shown or Ways).all(key) for key in rules]
    seen: set[Words] = {()}
    while ways:
        for way in tuple(ways):
            if limit <= 0:
                return
            tried = islice(way, MOST_STALE)
            words = next((words for words in tried if words not in seen), None)
            if words is None:
                ways.remove(way)
            else:
                seen.add(words)
                limit -= 1
                yield " ".join(words)


def sample(grammar: Rules, most: int, rules: Collection[str]) -> list[str]:
    """See `Grammar.sample`."""
    written = dict.fromkeys(sentences(grammar, rules, most))
    found = dict.fromkeys(filter(_is_listed, written))
    if len(written) == most:
        found = dict.fromkeys(list(found)[: most - most // 2])
        chance = random_sentences(grammar, random.Random(_SEED), rules)
        drawn = filter(_is_listed, islice(chance, 2 * most))
        while len(found) < most and (sentence := next(drawn, None)) is not None:
            found[sentence] = None
    return list(found)


def _is_listed(sentence: str) -> bool:
    """Whether a sentence has words, and no free ones."""
    return bool(sentence) and ANY not in sentence


def random_sentence(
    grammar: Rules,
    chance: random.Random,
    rules: Iterable[str] | None = None,
    shown: type[Ways] | None = None,
) -> str:
    """A sentence of one of the rules, all public ones without; drawn by the weights.

    Optional parts are said half of the time. May be empty when the grammar allows silence. `shown`
    is `ShownWays` for words that free slots usually have. Raises AuthoringError when the sentences
    of the rule are too long to be drawn, and for a grammar without public rules.
    """
    return next(random_sentences(grammar, chance, rules, shown))


def random_sentences(
    grammar: Rules,
    chance: random.Random,
    rules: Iterable[str] | None = None,
    shown: type[Ways] | None = None,
) -> Iterator[str]:
    """Sentences as `random_sentence` draws them, without end; faster than one by one."""
    keys, ways = tuple(rules or grammar.public_rules), grammar.made(shown or Ways)
    if not keys:
        what = "no public rule, so there is no sentence"
        raise AuthoringError(Place(grammar.path), what, 'write "public" before a rule')
    while True:
        yield " ".join(ways.draw(chance.choice(keys), chance))


def count_ways(grammar: Rules, rules: Iterable[str] | None = None) -> float:
    """In how many ways the rules, all public ones without, can be said; exact as an int.

    A sentence that can be read in two ways counts twice, silence counts as one. `math.inf` with
    repeats, with recursion, and beyond 2 ** MOST_BITS.
    """
    counts = _count_rules(grammar)
    return _bounded(sum(counts[key] for key in rules or grammar.public_rules))


def count_sentences(grammar: Rules, rules: Iterable[str] | None = None) -> int | None:
    """How many different sentences the rules have; None with more than MOST_COUNTED ways."""
    keys = tuple(rules or grammar.public_rules)
    if count_ways(grammar, keys) > MOST_COUNTED:
        return None
    return len({words for key in keys for words in grammar.made(Ways).all(key)} - {()})


class Ways:
    """The ways through the rules of a grammar, on explicit stacks: depth is unlimited."""

    def __init__(self, grammar: Rules) -> None:
        self._grammar = grammar
        self._height = Height(grammar.made(analysis.heights))
        self._heights: dict[int, float] = {}
        self._odds: dict[tuple[int, float], tuple[list[Expression], list[float]]] = {}
        self._recursive = grammar.made(analysis.recursive_of)

    def all(self, key: str) -> Iterator[Words]:
        """The words of every way through a rule, in the order of writing; none is a dead end."""
        stack: list[tuple[_Todo, _Said]] = []
        self._push(stack, self._start(key), None)
        steps = 0
        while stack and steps < MOST_STEPS:
            todo, said = stack.pop()
            steps += 1
            if todo is None:
                steps = 0
                yield _words(said)
                continue
            node, depth, rest = todo
            match node:
                case Token(text=text):
                    stack.append((rest, (text, said)))
                case Anything():
                    stack.append((rest, (self.free(node), said)))
                case Alternative():
                    for choice in reversed(heard_choices(node)):
                        self._push(stack, (choice, depth, rest), said)
                case Optional(item=item):
                    self._push(stack, (item, depth, rest), said)
                    stack.append((rest, said))
                case Repeat(item=item, minimum=minimum):
                    for count in range(MOST_REPEATS, minimum - 1, -1):
                        if count == 0 or self.height(item) <= depth:
                            stack.append((_row((item,) * count, depth, rest), said))
                case _:
                    stack.append((self._inside(node, depth, rest), said))

    def draw(self, key: str, chance: random.Random) -> Words:
        """The words of one way through a rule."""
        todo = self._start(key)
        said: list[str] = []
        for _ in range(MOST_STEPS):
            if todo is None:
                return tuple(said)
            node, depth, rest = todo
            match node:
                case Token(text=text):
                    said.append(text)
                    todo = rest
                case Anything():
                    said.append(self.free(node, chance))
                    todo = rest
                case Alternative():
                    todo = (self._drawn(node, depth, chance), depth, rest)
                case Optional(item=item):
                    is_said = self.height(item) <= depth and chance.random() >= 0.5
                    todo = (item, depth, rest) if is_said else rest
                case Repeat(item=item, minimum=minimum):
                    most = MOST_REPEATS if self.height(item) <= depth else minimum
                    todo = _row((item,) * chance.randint(minimum, most), depth, rest)
                case _:
                    todo = self._inside(node, depth, rest)
        rule = self._grammar.rules[key]
        what = f"<{key}> has sentences of more than {MOST_STEPS} parts"
        raise AuthoringError(rule.place(), what, "split it into shorter commands")

    def free(self, node: Anything, chance: random.Random | None = None) -> str:
        """What stands for free words."""
        return node.text

    def height(self, node: Expression) -> float:
        """`Height`, looked up where it was asked for before."""
        known = self._heights.get(id(node))
        if known is None:
            known = self._heights[id(node)] = self._height(node)
        return known

    def _start(self, key: str) -> _Todo:
        rule = self._grammar.rules[key]
        depth = self._grammar.made(analysis.heights)[key] + SPARE_DEPTH
        return None if math.isinf(depth) else (RuleReference(key, rule.span), int(depth), None)

    def _push(self, stack: list[tuple[_Todo, _Said]], todo: _Todo, said: _Said) -> None:
        """Unless it is a dead end."""
        if todo is not None and self.height(todo[0]) <= todo[1]:
            stack.append((todo, said))

    def _inside(self, node: Expression, depth: int, rest: _Todo) -> _Todo:
        match node:
            case RuleReference(name=name):
                return (
                    self._grammar.rules[name].expression,
                    depth - (name in self._recursive),
                    rest,
                )
            case Tagged(item=item):
                return (item, depth, rest)
            case Sequence(items=items):
                return _row(items, depth, rest)
        raise TypeError(node)

    def _drawn(self, node: Alternative, depth: int, chance: random.Random) -> Expression:
        """One of the choices, by their weights."""
        least = max(depth, self.height(node))
        known = self._odds.get((id(node), least))
        if known is None:
            pairs = zip(node.choices, node.weights, strict=True)
            fit = [(one, odds) for one, odds in pairs if odds > 0.0 and self.height(one) <= least]
            odds = list(accumulate(odds for _, odds in fit))
            known = self._odds[id(node), least] = [one for one, _ in fit], odds
        choices, odds = known
        return chance.choices(choices, cum_weights=odds)[0]


class ShownWays(Ways):
    """The same with what free slots usually are, by chance or the first, or `<name>` as often as
    there must be a word.
    """

    def __init__(self, grammar: Rules) -> None:
        super().__init__(grammar)
        self._usual = {
            written: [text for text in slot.known if slot.least <= len(text.split()) <= slot.most]
            for written, slot in grammar.made(spoken_slots).items()
        }

    def free(self, node: Anything, chance: random.Random | None = None) -> str:
        if not node.slot:
            return super().free(node, chance)
        usual = self._usual[node.written]
        if not usual:
            return " ".join([f"<{node.slot}>"] * node.least)
        return usual[0] if chance is None else chance.choice(usual)


def _row(items: tuple[Expression, ...], depth: int, rest: _Todo) -> _Todo:
    for item in reversed(items):
        rest = (item, depth, rest)
    return rest


def _words(said: _Said) -> Words:
    words: list[str] = []
    while said is not None:
        word, said = said
        words.append(word)
    return tuple(reversed(words))


def _count_rules(grammar: Rules) -> Mapping[str, float]:
    """The ways of each rule, those it uses before it; none of those that lead into a circle."""
    heights, rules = grammar.made(analysis.heights), grammar.rules
    live = {key: set(_live_references(rule.expression, heights)) for key, rule in rules.items()}
    endless = analysis.without_ends(live)
    counts: dict[str, float] = dict.fromkeys(endless, math.inf)
    for key in grammar.made(analysis.order_of):
        if key not in endless:
            counts[key] = _Count(counts)(rules[key].expression)
    return counts


def _live_references(node: Expression, heights: Mapping[str, float]) -> Iterator[str]:
    """The rules that can be said below a node."""
    height, pending = Height(heights), [node]
    while pending:
        node = pending.pop()
        if isinstance(node, RuleReference):
            yield node.name
        pending += [below for below in children(node) if not math.isinf(height(below))]


class _Count(Fold[float]):
    """In how many ways a node can be said, with those of the rules."""

    def __init__(self, counts: Mapping[str, float]) -> None:
        self._counts = counts

    def word(self, node: Token) -> float:
        return 1

    def reference(self, node: RuleReference) -> float:
        return self._counts.get(node.name, 0)

    def row(self, node: Sequence, parts: Iterator[float]) -> float:
        return _product(list(parts))

    def choice(self, node: Alternative, parts: Iterator[float]) -> float:
        return _bounded(sum(parts))

    def repeated(self, node: Repeat, part: float) -> float:
        return math.inf if part else 0


def _product(factors: list[float]) -> float:
    if 0 in factors:
        return 0
    product: float = 1
    for factor in factors:
        product = _bounded(product * factor)
    return product


def _bounded(count: float) -> float:
    return math.inf if isinstance(count, int) and count.bit_length() > MOST_BITS else count
