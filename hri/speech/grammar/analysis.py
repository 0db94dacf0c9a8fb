"""What the rules of a grammar allow, worked out without saying anything: arithmetic on the tree."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from itertools import islice
from typing import TypeVar

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.speech.grammar import free_slots
from hri.speech.grammar.doc_comments import ANY_COMMAND, LAST, DocTag
from hri.speech.grammar.exported_rules import exported_rules
from hri.speech.grammar.expressions import (
    Alternative,
    Anything,
    Expression,
    RuleReference,
    Sequence,
    Tagged,
    Token,
    children,
)
from hri.speech.grammar.fold import Fold
from hri.speech.grammar.rules import Rule, Rules
from hri.speech.grammar.words import ANY, misspelt_slot

RulesByKey = Mapping[str, Rule]
V = TypeVar("V")

MOST_TOLD = 100
"""Undefined names that are told."""
MOST_CIRCLES = 10
"""Circles of left recursion that are told, and rules of one that are named."""


def reachable(rules: RulesByKey, keys: Iterable[str]) -> list[str]:
    """The keys, and those of all rules they lead to, in the order they are met."""
    found: dict[str, None] = {}
    pending = list(reversed(list(keys)))
    while pending:
        key = pending.pop()
        if key not in found and key in rules:
            found[key] = None
            pending += reversed([node.name for node in rules[key].references])
    return list(found)


def words_of(rules: RulesByKey, keys: Iterable[str]) -> frozenset[str]:
    """The words of some rules, and of all that they lead to."""
    nodes = (node for key in reachable(rules, keys) for node in rules[key].nodes)
    return frozenset(node.text for node in nodes if isinstance(node, Token))


def tag_names(grammar: Rules, keys: Iterable[str]) -> frozenset[str]:
    """Names of all tags that an understood sentence of these rules may have."""
    rules = [grammar.rules[key] for key in reachable(grammar.rules, keys)]
    entries = [entry for rule in rules for entry in rule.tag_entries]
    slots = {
        node.slot
        for rule in rules
        for node in rule.nodes
        if isinstance(node, Anything) and node.slot
    }
    used_up = {name for entry in entries for name in entry.takes if name != entry.name}
    return frozenset(({entry.name for entry in entries} | slots) - used_up)


class Height(Fold[float]):
    """How many recursive rules the shortest way through a node enters within each other.

    Infinite when there is no way.
    """

    def __init__(self, heights: Mapping[str, float]) -> None:
        """`heights` are those of the rules; what has none can never be said."""
        self._heights = heights

    def word(self, node: Token) -> float:
        return 0

    def reference(self, node: RuleReference) -> float:
        return self._heights.get(node.name, math.inf)

    def row(self, node: Sequence, parts: Iterator[float]) -> float:
        return max(parts, default=0)

    def choice(self, node: Alternative, parts: Iterator[float]) -> float:
        least = math.inf
        for part in parts:
            least = min(least, part)
            if least == 0:
                break
        return least


def recursive_of(grammar: Rules) -> frozenset[str]:
    """Keys of the rules of a grammar that lead back to themselves."""
    return recursive_rules(grammar.rules)


def order_of(grammar: Rules) -> list[str]:
    """All keys of a grammar, as `used_first` orders them."""
    return used_first(grammar.rules)


def heights(grammar: Rules) -> dict[str, float]:
    """The height of every rule, itself included when it is recursive."""
    recursive = grammar.made(recursive_of)
    return settled(
        grammar,
        math.inf,
        lambda rule, known: Height(known)(rule.expression) + (rule.key in recursive),
    )


def switched_off(grammar: Rules) -> frozenset[str]:
    """Keys of the rules that are `<VOID>`, or lead only to such: nobody can say them."""
    known = settled(grammar, 0.0, lambda rule, known: Height(known)(rule.expression))
    return frozenset(key for key, least in known.items() if math.isinf(least))


class Silence(Fold[bool]):
    """Whether a node can be passed without a word."""

    def __init__(self, silent: Mapping[str, bool]) -> None:
        """`silent` says it of the rules."""
        self._silent = silent

    def word(self, node: Token) -> bool:
        return False

    def reference(self, node: RuleReference) -> bool:
        return self._silent.get(node.name, False)

    def row(self, node: Sequence, parts: Iterator[bool]) -> bool:
        return all(parts)

    def choice(self, node: Alternative, parts: Iterator[bool]) -> bool:
        return any(parts)


class Unlisted(Silence):
    """Whether a node can be passed without a word that is listed."""

    def anything(self, node: Anything) -> bool:
        return True


def silent_rules(grammar: Rules) -> dict[str, bool]:
    """Whether each rule can be passed without a word."""
    return settled(grammar, False, lambda rule, known: Silence(known)(rule.expression))


def settled(
    grammar: Rules, start: V, measure: Callable[[Rule, Mapping[str, V]], V]
) -> dict[str, V]:
    """Measure all rules, those they use before them, and those in circles until nothing changes."""
    rules, order = grammar.rules, grammar.made(order_of)
    users: dict[str, list[str]] = {}
    for key, names in _uses(rules).items():
        for name in names:
            users.setdefault(name, []).append(key)
    values = dict.fromkeys(rules, start)
    changed = set(order)
    while changed:
        for key in order:
            if key in changed:
                changed.discard(key)
                value = measure(rules[key], values)
                if value != values[key]:
                    values[key] = value
                    changed.update(users.get(key, ()))
    return values


def _uses(rules: RulesByKey) -> dict[str, set[str]]:
    """The rules that each refers to."""
    return {
        key: {node.name for node in rule.references} & rules.keys() for key, rule in rules.items()
    }


def used_first(rules: RulesByKey) -> list[str]:
    """All keys, each behind those it refers to; in a circle one of them comes too early."""
    order: list[str] = []
    met: set[str] = set()
    for first in rules:
        stack = [] if first in met else [(first, iter(rules[first].references))]
        met.add(first)
        while stack:
            key, uses = stack[-1]
            names = (node.name for node in uses)
            below = next((name for name in names if name in rules and name not in met), None)
            if below is None:
                order.append(key)
                stack.pop()
            else:
                met.add(below)
                stack.append((below, iter(rules[below].references)))
    return order


def recursive_rules(rules: RulesByKey) -> frozenset[str]:
    """The rules that lead to themselves, and those between two such."""
    uses = _uses(rules)
    users: dict[str, set[str]] = {key: set() for key in uses}
    for key, names in uses.items():
        for name in names:
            users[name].add(key)
    return without_ends(uses) & without_ends(users)


def without_ends(leads_to: Mapping[str, Collection[str]]) -> frozenset[str]:
    """The keys that lead into a circle: what is left when those that end are taken out."""
    left = {key: len(names) for key, names in leads_to.items()}
    back: dict[str, list[str]] = {}
    for key, names in leads_to.items():
        for name in names:
            back.setdefault(name, []).append(key)
    pending = [key for key, count in left.items() if not count]
    while pending:
        key = pending.pop()
        del left[key]
        for user in back.get(key, ()):
            left[user] -= 1
            if not left[user]:
                pending.append(user)
    return frozenset(left)


def left_corners(node: Expression, silent: Mapping[str, bool]) -> Iterator[RuleReference]:
    """The references that can stand before the first word of a node."""
    if isinstance(node, RuleReference):
        yield node
        return
    is_silent = Silence(silent)
    for child in children(node):
        yield from left_corners(child, silent)
        if isinstance(node, Sequence) and not is_silent(child):
            return


def left_recursion(grammar: Rules) -> Iterator[AuthoringError]:
    """Circles of rules that lead to each other before a word is said; no two share a rule."""
    for circle in _circles(grammar):
        what = f"<{circle[0]}> leads back to itself before a word is said"
        if len(circle) > 2:
            what += f" (through {', '.join(f'<{key}>' for key in circle[1:-1][:MOST_CIRCLES])})"
        remedy = "put the recursion at the end of the rule, or use * or +"
        yield AuthoringError(grammar.rules[circle[0]].place(), what, remedy)


def _circles(grammar: Rules) -> Iterator[list[str]]:
    silent = grammar.made(silent_rules)
    leads_to = {
        key: {node.name for node in left_corners(grammar.rules[key].expression, silent)}
        for key in grammar.rules
        if key in grammar.made(recursive_of)
    }
    while True:
        try:
            TopologicalSorter(leads_to).prepare()
        except CycleError as error:
            circle: list[str] = error.args[1][::-1]
            yield circle
            for key in circle:
                leads_to.pop(key, None)
        else:
            return


def errors(grammar: Rules) -> list[AuthoringError]:
    """What makes a grammar useless: each with its place and what to do, in the order of places.

    What follows only from a rule that could not be read is not told.
    """
    found = [*_undefined(grammar), *islice(left_recursion(grammar), MOST_CIRCLES)]
    if not found and not grammar.broken:
        found = [*_without_public(grammar), *_never_said(grammar), *_never_set(grammar)]
        found = found or [*_lost_marks(grammar), *_unread_limits(grammar)] or [*_too_free(grammar)]
        found = found or [*_without_words(grammar)] or [*_guessed(grammar)]
    return sorted(found, key=lambda error: (error.place.line, error.place.column))


def _guessed(grammar: Rules) -> Iterator[AuthoringError]:
    """Rules that must not be guessed from paraphrases: they move the robot, or give values."""
    for file in grammar.paraphrases:
        for key, line in file.heads:
            rule = grammar.rules.get(key)
            if rule is None or key in file.vague:
                continue
            if "careful" in rule.marks or tag_names(grammar, [key]):
                why = "moves the robot" if "careful" in rule.marks else "gives values"
                place = Place(file.path, line)
                yield AuthoringError(
                    place, f"<{key}> {why}, so no guess may mean it", f"write [{key} ?]"
                )


def _undefined(grammar: Rules) -> Iterator[AuthoringError]:
    told: set[str] = set()
    offered: Mapping[str, str] | None = None
    for rule in grammar.rules.values():
        for node in rule.references:
            known = node.name in grammar.rules or node.name in grammar.broken
            if not known and node.name not in told:
                told.add(node.name)
                offered = exported_rules() if offered is None else offered
                what = f"no rule <{node.name}>"
                remedy = f"write import <{offered.get(node.name)}>; for the one of that grammar"
                if node.name not in offered:
                    names = grammar.names if rule.path == grammar.path else grammar.rules
                    near = {*names, *offered}
                    remedy = did_you_mean(node.name, near, f"write <{node.name}> = words;")
                if slot := misspelt_slot(node.name):
                    remedy = f'did you mean "{slot}"?'
                yield AuthoringError(rule.place(node.span), what, remedy)
                if len(told) >= MOST_TOLD:
                    return


def _never_set(grammar: Rules) -> Iterator[AuthoringError]:
    """Values that are taken from tags which nothing sets, one error for each name."""
    tagged = [
        (rule, node)
        for rule in grammar.rules.values()
        for node in rule.nodes
        if isinstance(node, Tagged)
    ]
    known = {entry.name for _, node in tagged for entry in node.entries}
    nodes = (node for rule in grammar.rules.values() for node in rule.nodes)
    known |= {node.slot for node in nodes if isinstance(node, Anything)}
    for rule, node in tagged:
        for entry in node.entries:
            for name in entry.takes:
                if name not in known:
                    known.add(name)
                    what = f"no tag has the name ${name} that {entry.name} takes its value from"
                    remedy = did_you_mean(name, known - {name}, f"set it before: {{{name}=...}}")
                    yield AuthoringError(rule.place(node.span), what, remedy)


def _never_said(grammar: Rules) -> Iterator[AuthoringError]:
    """Recursion without an end. A rule that is switched off is fine, for that is what is meant."""
    for key, rule in grammar.rules.items():
        if math.isinf(grammar.made(heights)[key]) and key not in grammar.made(switched_off):
            what = f"<{key}> can never be said to its end"
            yield AuthoringError(rule.place(), what, "give it an alternative of words only")


def _without_public(grammar: Rules) -> Iterator[AuthoringError]:
    if not grammar.public_rules:
        what = "no public rule, so nothing can be heard"
        remedy = 'write "public" before the rules that are commands'
        yield AuthoringError(Place(grammar.path), what, remedy)


def _without_words(grammar: Rules) -> Iterator[AuthoringError]:
    keys = reachable(grammar.rules, grammar.public_rules)
    place = grammar.rules[grammar.public_rules[0]].place()
    if not any(isinstance(node, Token) for key in keys for node in grammar.rules[key].nodes):
        what = "the public rules hold no word"
        yield AuthoringError(place, what, "write the words of a command")
    elif grammar.made(switched_off).issuperset(grammar.public_rules):
        what = "the commands can never be said, for <VOID> or a weight of 0 stands in each"
        yield AuthoringError(place, what, "write words instead")


def _lost_marks(grammar: Rules) -> Iterator[AuthoringError]:
    """Marks that name other commands which are not there, or contradict each other."""
    for key in grammar.public_rules:
        rule = grammar.rules[key]
        named = {"after": {*rule.after} - {ANY_COMMAND}, "as": {rule.stands_for} - {LAST}}
        for tag in rule.doc_tags:
            if tag.name in named:
                yield from _lost(grammar, rule, tag, named[tag.name])
            if tag.name == "as" and not {"after", "typed"} & rule.marks:
                remedy = "write the commands before it: @after move turn"
                yield AuthoringError(rule.place(tag.span), "@as stands without @after", remedy)
            if tag.name == "as" and rule.stands_for == LAST and not {*rule.after} - {ANY_COMMAND}:
                what, remedy = "not every command has another form", "name them: @after move turn"
                yield AuthoringError(rule.place(tag.span), what, remedy)
            if tag.name == "as" and "anywhere" in rule.marks:
                what = "what stands for another command may not count @anywhere"
                yield AuthoringError(rule.place(tag.span), what, "take one of the two marks out")


def _unread_limits(grammar: Rules) -> Iterator[AuthoringError]:
    """Limits of free slots that are not understood."""
    for rule, tag in free_slots.marks(grammar):
        if free_slots.read_limits(tag) is None:
            what = f'@spoken "{tag.text[:40]}" does not say what may stand in a free slot'
            remedy = 'write @spoken name 2-12 letters, like "mc*", without not, or all of them'
            yield AuthoringError(rule.place(tag.span), what, remedy)


def _lost(
    grammar: Rules, rule: Rule, tag: DocTag, names: Collection[str]
) -> Iterator[AuthoringError]:
    others = [key for key in grammar.public_rules if key != rule.key]
    if not tag.text:
        what, remedy = f"@{tag.name} names no command", f"write one: @{tag.name} {others[0]}"
        yield AuthoringError(rule.place(tag.span), what, remedy)
        return
    for name in names:
        if name not in others:
            what = f'@{tag.name} names "{name}", which is not a command of this grammar'
            yield AuthoringError(rule.place(tag.span), what, did_you_mean(name, others))


def _moves(grammar: Rules, rule: Rule) -> bool:
    """Whether it moves the robot, itself or as the command that it stands for."""
    meant = rule.after if rule.stands_for == LAST else [rule.stands_for]
    others = (grammar.rules[key] for key in meant if key in grammar.rules)
    return any("careful" in one.marks for one in (rule, *others))


def _too_free(grammar: Rules) -> Iterator[AuthoringError]:
    """Commands that anything at all would be, and orders to move of which words are free."""
    free = settled(grammar, False, lambda rule, known: Unlisted(known)(rule.expression))
    silent = grammar.made(silent_rules)
    for key in grammar.public_rules:
        rule = grammar.rules[key]
        if free[key] and (not silent[key] or "anywhere" in rule.marks):
            what = f"<{key}> can be said with {_free_of(grammar, key)} alone, so it takes whatever"
            what += " is said"
            yield AuthoringError(rule.place(), what, "write a word that must be said")
        if _moves(grammar, rule):
            yield from _free_orders(grammar, rule)


def _free_of(grammar: Rules, key: str) -> str:
    """The first free words of a command as they are written; `<any>` for those around it."""
    nodes = (node for name in reachable(grammar.rules, [key]) for node in grammar.rules[name].nodes)
    return next((node.written for node in nodes if isinstance(node, Anything)), ANY)


def _free_orders(grammar: Rules, rule: Rule) -> Iterator[AuthoringError]:
    """Where an order to move has free words."""
    remedy = "list the words, or take @careful out if it moves nothing"
    for tag in rule.doc_tags:
        if tag.name == "anywhere":
            what = f"<{rule.key}> moves the robot, so it may not count @anywhere"
            yield AuthoringError(rule.place(tag.span), what, "take one of the two marks out")
    for key in reachable(grammar.rules, [rule.key]):
        part = grammar.rules[key]
        for node in part.nodes:
            if isinstance(node, Anything):
                what = f"<{rule.key}> moves the robot, so none of its words may be free"
                yield AuthoringError(part.place(node.span), what, remedy)
