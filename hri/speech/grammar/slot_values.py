"""What people say to give one value of a command: "the small one" to "Which size?"."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

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
from hri.speech.grammar.grammar import Grammar

VALUE = "value"
"""The rule whose sentences give the value."""


def values_of(grammar: Grammar, rule: str, tag: str) -> Grammar:
    """The grammar with a single command, VALUE: what gives a tag of a rule its value, by itself.

    Its sentences have the tags that they have within the rule. The grammar has no command where
    nothing in the rule gives that tag. Around a free slot the words of the rule may be said again:
    "jazz", and "i like jazz", also the word before it alone: "to feed the cat".
    """
    own = grammar.rules[rule]
    found = tuple(_givers(grammar, own.expression, tag))
    if any(isinstance(one, Anything) for one in found):
        found = (own.expression, *_words_before(own.expression, tag), *found[:1])
    choice = Alternative(found, (1.0,) * len(found), own.expression.span)
    rules = {key: replace(one, is_public=False) for key, one in grammar.rules.items()}
    marks = tuple(one for one in own.doc_tags if one.name in ("spoken", "careful"))
    key = VALUE if VALUE not in rules else f"{VALUE}.{tag}"
    rules[key] = replace(own, key=key, expression=choice, is_public=bool(found), doc_tags=marks)
    return replace(grammar, rules=rules)


def _words_before(node: Expression, tag: str) -> Iterator[Expression]:
    """The first free slot of a tag that has a word right before it, with that word."""
    if isinstance(node, Sequence):
        for before, after in pairwise(node.items):
            if isinstance(before, Token) and isinstance(after, Anything) and after.slot == tag:
                yield Sequence((before, after), after.span)
                return
    for below in children(node):
        if found := next(_words_before(below, tag), None):
            yield found
            return


def _givers(grammar: Grammar, node: Expression, tag: str) -> Iterator[Expression]:
    """The smallest parts of an expression that give a tag its value by themselves."""
    match node:
        case Tagged(entries=entries) if any(entry.name == tag for entry in entries):
            yield node
        case Anything(slot=slot) if slot == tag:
            yield node
        case RuleReference(name=name) if name in grammar.rules:
            if tag in grammar.tag_names(name):
                yield node
        case _:
            for below in children(node):
                yield from _givers(grammar, below, tag)
