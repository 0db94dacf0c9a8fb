"""What a person told: a relation of an app's `memory.toml`, and a value in words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date, datetime
from typing import Any

from hri.core.errors import HriError
from hri.core.privacy import is_same_name
from hri.speech.grammar.dates import resolve

Scalar = str | float | bool
LONGEST_TEXT = 100
"""Characters of a name, of a value, and of a text behind one."""
MOST_TAGS = 5
"""Values behind the words of a fact."""
DATE = "date"
"""The tag of a spoken date, see `hri.speech.grammar.dates`."""
WORDS = "value"
"""The tag of a grammar that holds the words of a fact."""


@dataclass(frozen=True, slots=True)
class Fact:
    """Something that a person told."""

    relation: str
    """A table of memory.toml: "likes"."""
    value: str
    """In words, as they are said back: "jazz", "May third"."""
    since: datetime
    """Wall time at which it was told last."""
    values: Mapping[str, Scalar] = field(default_factory=dict)
    """Tags behind the words: {"date": "--05-03"}."""

    def is_about(self, relation: str, value: str = "") -> bool:
        """Whether it is of a relation and, if one is given, has this value."""
        return self.relation == relation and (not value or is_same_name(self.value, value))


def fact_of(
    relation: str, tags: Mapping[str, Any], today: date | None = None
) -> tuple[str, dict[str, Scalar]]:
    """The words and the values of what was said by a rule with `@remember`.

    The words are the text of the tag `value`, else that of the tag with the name of the relation,
    else the only text among the tags; empty when there is none. The values are all other tags that
    hold one value. With `today`, the words of a spoken date are those of its day: "May 3".
    """
    values = {name: value for name, value in tags.items() if isinstance(value, (str, int, float))}
    texts = [name for name, value in values.items() if isinstance(value, str)]
    named = [name for name in (WORDS, relation) if name in texts]
    found = next(iter(named or (texts if len(texts) == 1 else [])), None)
    if found is None:
        return "", {}
    if found == DATE and today is not None:
        return _day_words(str(values[found]), today), values
    return str(values.pop(found)), values


def _day_words(text: str, today: date) -> str:
    """The day of a spoken date; the text itself where it means none."""
    try:
        day = resolve(text, today)
    except ValueError:
        return text
    return f"{day:%B} {day.day}"


def check_words(text: str, what: str, longest: int = LONGEST_TEXT) -> str:
    """A text that may be remembered, in one line. Raises HriError."""
    words = " ".join(text.split())
    if not words:
        raise HriError(f"an empty {what} - say one")
    if len(words) > longest or not words.isprintable():
        remedy = f"use at most {longest} printable characters"
        raise HriError(f'"{words}" is not a {what} to remember - {remedy}')
    return words


def check_values(values: Mapping[str, Scalar]) -> dict[str, Scalar]:
    """Values that may be remembered behind a fact. Raises HriError."""
    if len(values) > MOST_TAGS:
        raise HriError(f"{len(values)} values of one fact - give at most {MOST_TAGS}")
    for name, value in values.items():
        is_long = isinstance(value, str) and len(value) > LONGEST_TEXT
        is_wild = isinstance(value, (int, float)) and not abs(value) <= 1e300
        if len(name) > LONGEST_TEXT or is_long or is_wild:
            raise HriError(f'the value "{name}" cannot be remembered - make it shorter or finite')
    return dict(values)
