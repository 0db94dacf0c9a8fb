"""Sentences that mean something only after another one: "again", "the other way", "no i mean left".

A rule marked `@after move turn` counts for a while after one of these commands, one marked `@after
any` after whatever was understood. With `@as last` it
stands for that command: its tags are those of the command before, changed by its own, so that
`the other way {angle*=-1}` behind "turn left" is a turn to the right. With `@as turn` it stands for
<turn>, which takes over the tags of the command before only where that was a <turn>, too.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from hri.speech.grammar import analysis
from hri.speech.grammar.doc_comments import ANY_COMMAND, LAST
from hri.speech.grammar.matching import Parse
from hri.speech.grammar.rules import Rules
from hri.speech.grammar.tags import Value, evaluate

FOLLOWED_FOR = 20.0
"""Seconds after a command in which what follows it counts."""


@dataclass(frozen=True, slots=True)
class Followed:
    """A command that others may follow."""

    rule: str = ""
    """Empty for one that no rule names behind @after."""
    tags: Mapping[str, Value] = field(default_factory=dict)


def can_be_followed(grammar: Rules) -> frozenset[str]:
    """The commands after which other rules count."""
    return grammar.made(_can_be_followed)


def _can_be_followed(grammar: Rules) -> frozenset[str]:
    followers = (grammar.rules[key] for key in grammar.marked("after"))
    return frozenset(name for rule in followers for name in rule.after)


def out_of_place(grammar: Rules, last: Followed | None) -> frozenset[str]:
    """The rules marked @after that do not count after what was said last."""
    before = set() if last is None else {last.rule, ANY_COMMAND}
    followers = grammar.marked("after")
    return frozenset(key for key in followers if before.isdisjoint(grammar.rules[key].after))


def resolved(grammar: Rules, found: Parse, last: Followed | None) -> Parse:
    """The command that a sentence stands for after the last one; itself where it is one."""
    rule = grammar.rules[found.rule]
    if not rule.stands_for or found.rule in out_of_place(grammar, last):
        return found
    last = last or Followed()
    target = last.rule if rule.stands_for == LAST else rule.stands_for
    before = last.tags if target == last.rule else {}
    known = {*before, *grammar.made(_tags)[target]}
    changed = evaluate(found.entries, before)
    return replace(found, rule=target, tags={k: v for k, v in changed.items() if k in known})


def _tags(grammar: Rules) -> dict[str, frozenset[str]]:
    """The names of the tags of each command."""
    return {key: analysis.tag_names(grammar, [key]) for key in grammar.public_rules}
