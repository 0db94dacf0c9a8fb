"""Text to meaning: whether a grammar allows a sentence, and the tags of its words.

Every node of the grammar is tried at most once at each word, and what it can reach is kept, so
the work grows with nodes x words x words and never explodes. Where a sentence can be read in two
ways, the alternative that was written first wins.
"""

from __future__ import annotations

import re
from collections.abc import Generator, Mapping
from dataclasses import dataclass, field

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
from hri.speech.grammar.rules import Grammar
from hri.speech.grammar.tags import TagEntry, Value, evaluate

MOST_WORDS = 200
"""A longer text is no command."""

Groups = tuple[tuple[TagEntry, ...], ...]
Reached = dict[int, Groups]
"""Number of words behind a node, by the first way that led there: its tags in order."""
Steps = Generator[tuple[Expression, int], Reached, Reached]

_EDGES = re.compile(r"^[^\w']+|[^\w']+$")


@dataclass(frozen=True, slots=True)
class Parse:
    """A sentence that the grammar allows."""

    text: str
    """The grammar's words, lower case, one space between."""
    rule: str
    """The public rule that allows it."""
    tags: Mapping[str, Value] = field(default_factory=dict)


def normalize(text: str) -> list[str]:
    """The words of a text: lower case, without the punctuation around them."""
    words = (
        _EDGES.sub("", word)
        for word in text.lower().replace("\N{RIGHT SINGLE QUOTATION MARK}", "'").split()
    )
    return [word for word in words if word]


def parse(grammar: Grammar, text: str) -> Parse | None:
    """What a sentence means; None when no public rule allows all of it."""
    words = normalize(text)
    if not words or len(words) > MOST_WORDS:
        return None
    matcher = _Matcher(grammar, words)
    for key in grammar.public_rules:
        groups = matcher.reach(grammar.rules[key].expression).get(len(words))
        if groups is not None:
            return Parse(" ".join(words), key, evaluate(groups))
    return None


class _Matcher:
    """Finds where nodes can end in one list of words.

    The methods are generators that ask for the ends of other nodes by yielding them; `reach`
    answers from its own stack, so that no depth of rules can exhaust Python's.
    """

    def __init__(self, grammar: Grammar, words: list[str]) -> None:
        self._grammar = grammar
        self._words = words
        self._known: dict[tuple[int, int], Reached] = {}

    def reach(self, node: Expression) -> Reached:
        stack: list[tuple[tuple[int, int], Steps]] = []
        answer = self._enter(node, 0, stack)
        while stack:
            key, steps = stack[-1]
            try:
                asked, position = steps.send(answer)  # type: ignore[arg-type]
            except StopIteration as end:
                stack.pop()
                answer = self._known[key] = end.value
            else:
                answer = self._enter(asked, position, stack)
        return self._known[id(node), 0]

    def _enter(
        self, node: Expression, position: int, stack: list[tuple[tuple[int, int], Steps]]
    ) -> Reached | None:
        """What is known of a node; else None, and its steps are on the stack."""
        key = (id(node), position)
        known = self._known.get(key)
        if known is None:
            # Left recursion meets this empty answer and goes no further.
            self._known[key] = {}
            stack.append((key, self._steps(node, position)))
        return known

    def _steps(self, node: Expression, position: int) -> Steps:
        match node:
            case Token(text=text):
                is_here = position < len(self._words) and self._words[position] == text
                return {position + 1: ()} if is_here else {}
            case RuleReference(name=name):
                return (yield self._grammar.rules[name].expression, position)
            case Sequence(items=items):
                return (yield from self._sequence(items, position))
            case Alternative(choices=choices):
                reached: Reached = {}
                for choice in choices:
                    for end, groups in (yield choice, position).items():
                        reached.setdefault(end, groups)
                return reached
            case Optional(item=item):
                return {**(yield item, position), position: ()}
            case Repeat(item=item, minimum=minimum):
                return (yield from self._repeat(item, minimum, position))
            case Tagged(item=item, entries=entries):
                reached = yield item, position
                return {end: (*groups, entries) for end, groups in reached.items()}

    def _sequence(self, items: tuple[Expression, ...], position: int) -> Steps:
        reached: Reached = {position: ()}
        for item in items:
            further: Reached = {}
            for middle, before in reached.items():
                for end, groups in (yield item, middle).items():
                    further.setdefault(end, before + groups)
            reached = further
        return reached

    def _repeat(self, item: Expression, minimum: int, position: int) -> Steps:
        reached: Reached = {} if minimum else {position: ()}
        edge: Reached = {position: ()}
        while edge:
            further: Reached = {}
            for middle, before in edge.items():
                for end, groups in (yield item, middle).items():
                    if end not in reached:
                        reached[end] = further[end] = before + groups
            edge = further
        return reached
