"""What words mean: the plain data that a grammar writes in braces.

Between `{` and `}` stand entries, with spaces or semicolons between them:

    {emotion=happy}       the tag `emotion` is the text "happy"
    {distance=10}         a number; {angle=-90}, {scale=0.5}
    {place="the kitchen"} a text with spaces; {loud=true} and {loud=false} are yes and no
    {polite}              short for {polite=true}
    {number+=20}          adds to what is there; to 0 when nothing is
    {number*=100}         multiplies what is there; does nothing when nothing is
    {distance=$number}    takes the value of another tag, which is used up by it; nothing
                          happens when that tag was not set

Entries take effect in the order their words are said, those behind a group after those inside.
That is enough for compound numbers: "twenty" {number+=20}, "five" {number+=5}.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

Value = str | float | bool

LONGEST_TAG = 1000
"""Characters between the braces."""

_ENTRY = re.compile(
    r"""[\s;]*
    (?P<name>[A-Za-z_][\w.-]*)
    (?:\s*(?P<operation>\+=|\*=|=)\s*
       (?: "(?P<quoted>[^"]*)" | (?P<plain>[^\s;"=]+) )
    )?
    (?=[\s;]|$)[\s;]*""",
    re.VERBOSE,
)
_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?")
_WORDS: dict[str, Value] = {"true": True, "false": False}


@dataclass(frozen=True, slots=True)
class TagEntry:
    """One `name=value`."""

    name: str
    operation: str
    """"=", "+=" or "*="."""
    value: Value
    is_reference: bool = False
    """True when the value is the name of the tag to take the value from."""


def read_entries(text: str) -> tuple[TagEntry, ...]:
    """The entries between the braces. Raises ValueError with what is wrong."""
    if len(text) > LONGEST_TAG:
        raise ValueError(f"a tag of {len(text)} characters is too long")
    entries: list[TagEntry] = []
    position = 0
    while position < len(text.rstrip()):
        match = _ENTRY.match(text, position)
        if match is None:
            raise ValueError(f'cannot read the tag at "{text[position:].strip()[:30]}"')
        entries.append(_entry(match))
        position = match.end()
    if not entries:
        raise ValueError("the tag is empty")
    return tuple(entries)


def _entry(match: re.Match[str]) -> TagEntry:
    name, operation = match["name"], match["operation"] or "="
    if match["plain"] is not None and match["plain"].startswith("$"):
        return TagEntry(name, operation, match["plain"][1:], is_reference=True)
    value: Value = True
    if match["quoted"] is not None:
        value = match["quoted"]
    elif match["plain"] is not None:
        value = _value(match["plain"])
    if operation != "=" and not _is_number(value):
        raise ValueError(f"{name}{operation} needs a number")
    return TagEntry(name, operation, value)


def _value(text: str) -> Value:
    if _NUMBER.fullmatch(text):
        number = float(text)
        if not math.isfinite(number):
            raise ValueError(f"{text} is too large")
        return number
    return _WORDS.get(text, text)


def _is_number(value: object) -> bool:
    return isinstance(value, float)


def evaluate(groups: Iterable[tuple[TagEntry, ...]]) -> dict[str, Value]:
    """What remains when all tags, one group for each pair of braces, have taken effect."""
    tags: dict[str, Value] = {}
    for entries in groups:
        used: set[str] = set()
        for entry in entries:
            value: Value | None = entry.value
            if entry.is_reference:
                used.add(str(entry.value))
                value = tags.get(str(entry.value))
            if value is not None:
                _apply(tags, entry, value)
        for name in used - {entry.name for entry in entries}:
            tags.pop(name, None)
    return tags


def _apply(tags: dict[str, Value], entry: TagEntry, value: Value) -> None:
    if entry.operation == "=":
        tags[entry.name] = value
        return
    before = tags.get(entry.name, 0.0 if entry.operation == "+=" else None)
    if isinstance(before, float) and isinstance(value, float):
        result = before + value if entry.operation == "+=" else before * value
        # Ten times 0.3 is to read 3, not 3.0000000000000004.
        tags[entry.name] = round(result, 9)
