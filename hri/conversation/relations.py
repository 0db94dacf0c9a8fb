"""Reads `memory.toml`: what an app remembers of people, its questions, and its words for both.

    [relation.likes]
    several = true                                  # else a new value replaces the one before
    is_name = false                                 # whether it is written with capital letters
    tell = "You like {value}."                      # to "what do you know about me"
    ask = "Do you like {value}?"                    # whether that is so
    ask_for = "What do you like to do?"             # as long as nothing is known
    follow_up = ["How was your {value} evening?"]   # what a fact is used for, at the next meeting

A rule of a grammar names the relation that it gives a value of: `@remember likes`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from hri.conversation.facts import LONGEST_TEXT, WORDS
from hri.conversation.spoken_text import check_text, fields_of
from hri.core.errors import AuthoringError, Mistakes, did_you_mean
from hri.core.toml import Table, load_toml
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.rules import Rule

FILE = "memory.toml"
KIND = "memory"
REMEMBER = "remember"
"""The mark of a rule that gives a fact."""
MOST_RELATIONS = 200
MOST_TEXTS = 100
"""Texts of one key."""
FILLED_IN = ("value", "name")
"""What may stand in braces."""


@dataclass(frozen=True, slots=True)
class Relation:
    """What may be known of a person: a table [relation.NAME]."""

    name: str
    tell: str
    several: bool = False
    """Whether there can be several values; else a new one replaces the one before."""
    ask: tuple[str, ...] = ()
    """Whether a value is right."""
    ask_for: tuple[str, ...] = ()
    """Questions for a value, as long as there is none."""
    follow_up: tuple[str, ...] = ()
    """Questions that use a value, in a later meeting than that in which it was told."""
    is_name: bool = False
    """Whether a value is a name, which begins with capital letters however it was typed."""


def load_relations(files: Sequence[Path]) -> dict[str, Relation]:
    """The relations of these files by name; those of a later file replace earlier ones.

    Raises AuthoringError with the place of a mistake; AuthoringErrors when there are several.
    """
    mistakes = Mistakes()
    found: dict[str, Relation] = {}
    for path in files:
        table = load_toml(path, KIND)
        for name, entry in mistakes.keep(partial(_tables, table)) or ():
            if relation := mistakes.keep(partial(_relation, name, entry)):
                found[name] = relation
        mistakes.keep(table.finish)
        if len(found) > MOST_RELATIONS:
            what = f"{len(found)} relations"
            mistakes.add(table.error("relation", what, f"keep at most {MOST_RELATIONS}"))
    mistakes.tell()
    return found


def _tables(table: Table) -> list[tuple[str, Table]]:
    return list(table.tables("relation"))


def _relation(name: str, entry: Table) -> Relation:
    if not name.isidentifier() or len(name) > LONGEST_TEXT:
        remedy = "use letters, digits and underscores"
        raise entry.error(None, f'"{name}" is not a name for a relation', remedy)
    tell = entry.string("tell")
    _check(entry, "tell", tell, needs_value=True)
    relation = Relation(
        name,
        tell,
        entry.flag("several"),
        _texts(entry, "ask", needs_value=True),
        _texts(entry, "ask_for", needs_value=False),
        _texts(entry, "follow_up", needs_value=True),
        entry.flag("is_name"),
    )
    entry.finish()
    return relation


def _texts(entry: Table, key: str, *, needs_value: bool) -> tuple[str, ...]:
    """A text, or a list of texts."""
    is_list = isinstance(entry.data.get(key), list)
    texts = entry.strings(key) if is_list else [entry.string(key, "")]
    if len(texts) > MOST_TEXTS:
        raise entry.error(key, f"{key} has {len(texts)} texts", f"keep at most {MOST_TEXTS}")
    for text in filter(None, texts):
        _check(entry, key, text, needs_value)
    return tuple(filter(None, texts))


def _check(entry: Table, key: str, text: str, needs_value: bool) -> None:
    check_text(entry, text, FILLED_IN, key)
    has_value = "value" in fields_of(text)
    if needs_value and not has_value:
        raise entry.error(key, f'"{text}" does not say the value', "write {value} in it")
    if has_value and not needs_value:
        what = f"{key} is asked while no value is known, and has {{value}}"
        raise entry.error(key, what, "write a question without {value}, or use ask")


def remembered_by(
    rules: Mapping[str, Rule], relations: Mapping[str, Relation] | Iterable[str]
) -> dict[str, str]:
    """The relation of each rule with `@remember RELATION`, by rule.

    Raises AuthoringError with the place of the mark for a relation that memory.toml does not have.
    """
    known = tuple(relations)
    found = {}
    for key, rule in rules.items():
        for tag in rule.doc_tags:
            if tag.name != REMEMBER:
                continue
            name = tag.text.partition(" ")[0]
            if name not in known:
                what = f'@{REMEMBER} "{name}", which is not a relation of {FILE}'
                otherwise = f"add [relation.{name or 'NAME'}] to {FILE}"
                remedy = did_you_mean(name, known, otherwise)
                raise AuthoringError(rule.place(tag.span), what, remedy)
            found[key] = name
    return found


def source_of(
    relation: str, grammar: Grammar, relations: Mapping[str, Relation] | Iterable[str]
) -> tuple[str, str] | None:
    """The public rule that gives a fact of a relation, and the tag with its words; None without
    such a rule, or when several tags could have them. Raises AuthoringError as `remembered_by`.
    """
    for rule, name in remembered_by(grammar.rules, relations).items():
        tags = grammar.tag_names(rule)
        named = [tag for tag in (WORDS, relation) if tag in tags]
        told = named or ([*tags] if len(tags) == 1 else [])
        if name == relation and rule in grammar.public_rules and told:
            return rule, told[0]
    return None
