"""What the rules of a grammar allow, worked out without saying anything: arithmetic on the tree."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from typing import TYPE_CHECKING, TypeVar

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    Repeat,
    RuleReference,
    Sequence,
    Tagged,
    Token,
    children,
    walk,
)

if TYPE_CHECKING:
    from hri.speech.grammar.rules import Grammar, Rule

Rules = Mapping[str, "Rule"]
V = TypeVar("V")


def references(node: Expression) -> Iterator[RuleReference]:
    """All references below a node."""
    return (below for below in walk(node) if isinstance(below, RuleReference))


def reachable(rules: Rules, keys: Iterable[str]) -> list[str]:
    """The keys, and those of all rules they lead to, in the order they are met."""
    found: dict[str, None] = {}
    pending = list(reversed(list(keys)))
    while pending:
        key = pending.pop()
        if key not in found and key in rules:
            found[key] = None
            pending += reversed([node.name for node in references(rules[key].expression)])
    return list(found)


def height(node: Expression, heights: Mapping[str, float]) -> float:
    """How many rules deep the shortest way through a node goes; infinite when there is none."""
    match node:
        case RuleReference(name=name):
            return heights.get(name, math.inf) + 1
        case Sequence(items=items):
            return max((height(item, heights) for item in items), default=0)
        case Alternative(choices=choices):
            return min((height(choice, heights) for choice in choices), default=math.inf)
        case Repeat(item=item, minimum=1) | Tagged(item=item):
            return height(item, heights)
        case _:
            return 0


def heights(rules: Rules) -> dict[str, float]:
    """The height of every rule."""
    return _settle(rules, math.inf, height)


def is_silent(node: Expression, silent: Mapping[str, bool]) -> bool:
    """Whether a node can be passed without a word."""
    match node:
        case RuleReference(name=name):
            return silent.get(name, False)
        case Sequence(items=items):
            return all(is_silent(item, silent) for item in items)
        case Alternative(choices=choices):
            return any(is_silent(choice, silent) for choice in choices)
        case Repeat(item=item, minimum=1) | Tagged(item=item):
            return is_silent(item, silent)
        case Token():
            return False
        case _:
            return True


def silent_rules(rules: Rules) -> dict[str, bool]:
    """Whether each rule can be passed without a word."""
    return _settle(rules, False, is_silent)


def _settle(
    rules: Rules, start: V, measure: Callable[[Expression, Mapping[str, V]], V]
) -> dict[str, V]:
    """Measure all rules again and again until nothing changes; users of a change come next."""
    users: dict[str, list[str]] = {}
    for key, rule in rules.items():
        for node in references(rule.expression):
            users.setdefault(node.name, []).append(key)
    values = dict.fromkeys(rules, start)
    pending: dict[str, None] = dict.fromkeys(reversed(list(rules)))
    while pending:
        key, _ = pending.popitem()
        value = measure(rules[key].expression, values)
        if value != values[key]:
            values[key] = value
            pending.update(dict.fromkeys(users.get(key, ())))
    return values


def left_corners(node: Expression, silent: Mapping[str, bool]) -> Iterator[RuleReference]:
    """The references that can stand before the first word of a node."""
    if isinstance(node, RuleReference):
        yield node
        return
    for child in children(node):
        yield from left_corners(child, silent)
        if isinstance(node, Sequence) and not is_silent(child, silent):
            return


def left_recursion(rules: Rules) -> list[str]:
    """The keys of a circle of rules that lead to each other before a word is said; else none."""
    silent = silent_rules(rules)
    leads_to = {
        key: [node.name for node in left_corners(rule.expression, silent)]
        for key, rule in rules.items()
    }
    try:
        TopologicalSorter(leads_to).prepare()
    except CycleError as error:
        circle: list[str] = error.args[1]
        return circle[::-1]
    return []


def errors(grammar: Grammar) -> list[AuthoringError]:
    """What makes a well-written grammar useless: each with its place and what to do."""
    found = [*_undefined(grammar), *_recursive(grammar), *_without_public(grammar)]
    return found or [*_never_said(grammar), *_without_words(grammar)]


def _undefined(grammar: Grammar) -> Iterator[AuthoringError]:
    for rule in grammar.rules.values():
        for node in references(rule.expression):
            if node.name not in grammar.rules:
                what = f"no rule <{node.name}>"
                remedy = did_you_mean(node.name, grammar.rules, f"write <{node.name}> = words;")
                yield AuthoringError(rule.place(node.span), what, remedy)


def _recursive(grammar: Grammar) -> Iterator[AuthoringError]:
    circle = left_recursion(grammar.rules)
    if circle:
        what = f"<{circle[0]}> leads back to itself before a word is said"
        if len(circle) > 2:
            what += f" (through {', '.join(f'<{key}>' for key in circle[1:-1])})"
        remedy = "put the recursion at the end of the rule, or use * or +"
        yield AuthoringError(grammar.rules[circle[0]].place(), what, remedy)


def _never_said(grammar: Grammar) -> Iterator[AuthoringError]:
    for key, rule in grammar.rules.items():
        if math.isinf(grammar.heights[key]):
            what = f"<{key}> can never be said to its end"
            yield AuthoringError(rule.place(), what, "give it an alternative of words only")


def _without_public(grammar: Grammar) -> Iterator[AuthoringError]:
    if not grammar.public_rules:
        what = "no public rule, so nothing can be heard"
        remedy = 'write "public" before the rules that are commands'
        yield AuthoringError(Place(grammar.path), what, remedy)


def _without_words(grammar: Grammar) -> Iterator[AuthoringError]:
    if not grammar.words():
        place = grammar.rules[grammar.public_rules[0]].place()
        what = "the public rules hold no word"
        yield AuthoringError(place, what, "write the words of a command")
