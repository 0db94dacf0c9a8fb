"""Operators of tags that cannot apply: `*=` where no number is, `+=` of a number to a text."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from hri.speech.grammar.expressions import Tagged
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.lint.finding import Finding, warning
from hri.speech.grammar.rules import Rule
from hri.speech.grammar.tags import Reference, TagEntry

NUMBER, FLAG, TEXT, LIST = "a number", "true or false", "a text", "a list"

Kinds = dict[str, set[str]]
"""What the value of a tag may be, by its name, in any sentence of the grammar."""


def idle_operators(grammar: Grammar, rules: Iterable[Rule]) -> Iterator[Finding]:
    """Where a tag in one of these rules has an operator that does nothing, or another thing."""
    kinds = _kinds(grammar)
    set_to = _kinds(grammar, operations=("=",))
    for rule in rules:
        for node in rule.nodes:
            for entry in node.entries if isinstance(node, Tagged) else ():
                if (wrong := _wrong(entry, kinds, set_to)) is not None:
                    yield warning(rule.place(node.span), *wrong)


def _wrong(entry: TagEntry, kinds: Kinds, set_to: Kinds) -> tuple[str, str] | None:
    """The mistake in an entry, and its remedy."""
    name, before = entry.name, kinds.get(entry.name, set())
    if entry.operation == "*=" and not before:
        what = f'"{name}*=" does nothing, for nothing gives {name} a value'
        return what, f"set it before: {{{name}=1}}"
    if entry.operation == "*=" and NUMBER not in before:
        what = f'"{name}*=" does nothing, for {name} is {_either(before)}'
        return what, f"give {name} a number, or replace it, {{{name}=...}}"
    if entry.operation == "*=" and isinstance(entry.value, Reference):
        factor = kinds.get(entry.value.name, set())
        if factor and NUMBER not in factor:
            what = f'"{name}*=" does nothing, for ${entry.value.name} is {_either(factor)}'
            return what, f"give {entry.value.name} a number"
    if entry.operation == "+=" and isinstance(entry.value, float):
        fixed = set_to.get(name, set())
        if fixed and NUMBER not in fixed:
            what = f'"{name}+=" collects texts, for {name} is {_either(fixed)}, and adds nothing'
            return what, f'give {name} a number to add to, or write the number in quotes, "2"'
    return None


def _kinds(grammar: Grammar, operations: tuple[str, ...] = ("=", "+=")) -> Kinds:
    """What the tags of all rules may be."""
    nodes = [node for rule in grammar.rules.values() for node in rule.nodes]
    entries = [
        entry
        for node in nodes
        if isinstance(node, Tagged)
        for entry in node.entries
        if entry.operation in operations
    ]
    found: Kinds = defaultdict(set)
    takers: dict[str, list[TagEntry]] = defaultdict(list)
    for entry in entries:
        if isinstance(entry.value, Reference):
            takers[entry.value.name].append(entry)
    waiting = entries
    while waiting:  # values go from tag to tag
        entry = waiting.pop()
        more = _kinds_of(entry, found) - found[entry.name]
        if more:
            found[entry.name] |= more
            waiting.extend(takers[entry.name])
    return {name: kinds for name, kinds in found.items() if kinds}


def _kinds_of(entry: TagEntry, known: Kinds) -> set[str]:
    match entry.value:
        case Reference(name):
            kinds = set(known[name])
        case bool():
            kinds = {FLAG}
        case float():
            kinds = {NUMBER}
        case _:
            kinds = {TEXT}
    if entry.operation == "+=":
        return {NUMBER if kind == NUMBER else LIST for kind in kinds}
    return kinds


def _either(kinds: set[str]) -> str:
    return " or ".join(sorted(kinds))
