"""Adds rules of one grammar to another: "stop" counts under both, and shared parts serve both."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from hri.speech.grammar import analysis
from hri.speech.grammar.expressions import Alternative, RuleReference, mapped
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.rules import Rule, Rules


def with_interrupts_of(grammar: Grammar, other: Rules) -> Grammar:
    """The grammar with the public rules of `other` that are marked @interrupts.

    They keep their names and come first, so that a sentence of both grammars is theirs. A public
    rule that has the name of one of them is joined with it: the words of either are that rule.
    Other rules whose names meet get new ones. The grammar itself when it has them all.
    """
    marked = other.marked("interrupts")
    lacking = [
        key for key in other.public_rules if key in marked and not _has(grammar, other.rules[key])
    ]
    if not lacking:
        return grammar
    added = {
        key: replace(other.rules[key], is_public=key in lacking)
        for key in analysis.reachable(other.rules, lacking)
    }
    private = grammar.rules.keys() - set(grammar.public_rules)
    own = _renamed(grammar.rules, _free_names(private & set(lacking), {*grammar.rules, *added}))
    added = _renamed(added, _free_names(own.keys() & added.keys() - set(lacking), {*own, *added}))
    for key in lacking:
        if key in own:
            added[key] = _joined(added[key], own.pop(key))
    return replace(grammar, rules={**added, **own}, known=_known(grammar, other))


def with_parts_of(grammar: Grammar, other: Rules) -> Grammar:
    """The grammar with all rules of `other` as parts behind its own, each named `other.rule`.

    Own rules that have such a name, because they were imported, get new ones.
    """
    added = _renamed(other.rules, {key: f"{other.name}.{key}" for key in other.rules})
    parts = {key: replace(rule, is_public=False) for key, rule in added.items()}
    meeting = grammar.rules.keys() & parts.keys()
    own = _renamed(grammar.rules, _free_names(meeting, {*grammar.rules, *parts}))
    return replace(grammar, rules={**own, **parts}, known=_known(grammar, other))


def _known(grammar: Rules, other: Rules) -> dict[str, tuple[str, ...]]:
    """What the free slots of both usually are."""
    slots = {**grammar.known, **other.known}
    return {
        slot: tuple(dict.fromkeys((*grammar.known.get(slot, ()), *other.known.get(slot, ()))))
        for slot in slots
    }


def _has(grammar: Grammar, rule: Rule) -> bool:
    """Whether a grammar got that very rule from the same file, as one that extends it does."""
    own = grammar.rules.get(rule.key)
    return own is not None and own.is_public and (own.path, own.span) == (rule.path, rule.span)


def _free_names(keys: Collection[str], taken: set[str]) -> dict[str, str]:
    """Another name for each key, which nothing else has."""
    names = {}
    for key in sorted(keys):
        name = f"{key}'"
        while name in taken:
            name += "'"
        taken.add(name)
        names[key] = name
    return names


def _renamed(rules: dict[str, Rule], names: dict[str, str]) -> dict[str, Rule]:
    """The rules under other names, with the references to them."""
    if not names:
        return dict(rules)

    def resolve(node: RuleReference) -> RuleReference:
        return replace(node, name=names[node.name]) if node.name in names else node

    renamed = [
        replace(
            rule,
            key=names.get(key, key),
            expression=mapped(rule.expression, RuleReference, resolve),
        )
        for key, rule in rules.items()
    ]
    return {rule.key: rule for rule in renamed}


def _joined(first: Rule, second: Rule) -> Rule:
    """One rule for the words of both, with the marks of both."""
    choices = (first.expression, second.expression)
    return replace(
        first,
        expression=Alternative(choices, (1.0, 1.0), first.span),
        doc_tags=first.doc_tags + second.doc_tags,
    )
