"""What words mean: the plain data that a grammar writes in braces.

Between `{` and `}` stand entries, with spaces or semicolons between them:

    {emotion=happy}       the tag `emotion` is the text "happy"
    {distance=10}         a number; {angle=-90}, {scale=0.5}
    {place="the kitchen"} a text with spaces; {loud=true} and {loud=false} are yes and no
    {polite}              short for {polite=true}; behind a text without quotes a ";" stands
                          before it, for it might be the second word of the text
    {number+=20}          adds to what is there; to 0 when nothing is
    {toppings+=ham}       collects texts in a list, also a second text or a number behind one
    {number*=100}         multiplies what is there; does nothing when no number is
    {distance=$number}    takes the value of another tag, which is used up by it; nothing
                          happens when that tag was not set; also with += and *=
    {time="$hour:$minute"}  puts the values of other tags into a text and uses them up; nothing
                          happens when one of them was not set; "$$" is a "$"

What is none of this, such as the code of another program, is kept as it is: `opaque` makes it one
of the texts in the list `tag`.

Entries take effect in the order their words are said, those behind a group after those inside.
That is enough for compound numbers: "twenty" {number+=20}, "five" {number+=5}. Nothing is ever
run: a tag is data, whoever wrote the grammar. In a text in quotes, "" is a quote.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

Value = str | float | bool | tuple[str, ...]
"""A tuple is a list of texts that `+=` collected."""

OPAQUE = "tag"
"""The name under which tags of other programs are collected."""
LONGEST_TAG = 1000
"""Characters between the braces."""
LONGEST_VALUE = 1000
"""Characters of a text that is put together; what is longer is not set."""
MOST_COLLECTED = 200
"""Texts of a list; it takes no more than these. A sentence has no more words."""

_ENTRY = re.compile(
    r"""[\s;]*
    (?P<name>[A-Za-z_][\w.-]*)
    (?:\s*(?P<operation>\+=|\*=|=)\s*
       (?: "(?P<quoted>(?:[^"]|"")*+)" | (?P<plain>[^\s;"=]+) )
    )?
    (?=[\s;]|$)[\s;]*""",
    re.VERBOSE,
)
_NAME = re.compile(r"[A-Za-z_][\w.-]*")
_NUMBER = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?")
_PLAIN = re.compile(r"[^\s;\"={}\\$]+")
_HOLE = re.compile(r"\$(?:\$|([A-Za-z_]\w*))")
_WORDS: dict[str, Value] = {"true": True, "false": False}
_REMEDY = "write {name=value}, more of them with spaces between"


@dataclass(frozen=True, slots=True)
class Reference:
    """`$name`: the value of another tag."""

    name: str


@dataclass(frozen=True, slots=True)
class Template:
    """A text in quotes with `$name` in it."""

    text: str

    @property
    def names(self) -> tuple[str, ...]:
        """The tags whose values it takes."""
        return tuple(match[1] for match in _HOLE.finditer(self.text) if match[1])

    def fill(self, tags: Mapping[str, Value]) -> str | None:
        """The text with the values in it; None when one is missing or it grows too long."""
        if any(name not in tags for name in self.names):
            return None
        text = _HOLE.sub(lambda hole: written(tags[hole[1]]) if hole[1] else "$", self.text)
        return text if len(text) <= LONGEST_VALUE else None


@dataclass(frozen=True, slots=True)
class TagEntry:
    """One `name=value`."""

    name: str
    operation: str
    """"=", "+=" or "*="."""
    value: Value | Reference | Template

    @property
    def takes(self) -> tuple[str, ...]:
        """The tags whose values it uses up."""
        match self.value:
            case Reference(name):
                return (name,)
            case Template() as template:
                return template.names
            case _:
                return ()


class TagError(ValueError):
    """What is wrong with the text between the braces, and how far into it; -1: with all of it."""

    def __init__(self, what: str, offset: int, remedy: str = _REMEDY) -> None:
        super().__init__(what)
        self.offset = offset
        self.remedy = remedy


def read_entries(text: str) -> tuple[TagEntry, ...]:
    """The entries between the braces. Raises TagError.

    A lone name right behind a text without quotes is refused: it may be the rest of the text.
    """
    if len(text) > LONGEST_TAG:
        raise TagError(f"a tag of {len(text)} characters is too long", -1)
    entries: list[TagEntry] = []
    before: re.Match[str] | None = None
    position, end = 0, len(text.rstrip(" \t\r\n;"))
    while position < end:
        match = _ENTRY.match(text, position)
        if match is None:
            offset = position + len(text[position:]) - len(text[position:].lstrip(" \t\r\n;"))
            raise TagError(f'cannot read the tag at "{text[offset:].strip()[:30]}"', offset)
        if before is not None and match["operation"] is None:
            _refuse_rest_of_text(before, entries[-1].value, match)
        entries.append(_entry(match))
        position, before = match.end(), match
    if not entries:
        raise TagError("the tag is empty", -1)
    return tuple(entries)


def opaque(text: str) -> tuple[TagEntry, ...]:
    """A tag of another program, as one text with single spaces.

    Nothing for an empty one. What is longer than LONGEST_VALUE ends there.
    """
    words = " ".join(text.split())[:LONGEST_VALUE]
    return (TagEntry(OPAQUE, "+=", words),) if words else ()


def _refuse_rest_of_text(before: re.Match[str], value: object, match: re.Match[str]) -> None:
    """Raise TagError for the second word of `{light=very bright}`."""
    if before["plain"] is not None and isinstance(value, str) and ";" not in before.group():
        what = f'"{match["name"]}" stands behind a text without quotes'
        whole = f'{before["name"]}="{value} {match["name"]}"'
        remedy = f"write {whole} if it belongs to the text, {match['name']}=true if it does not"
        raise TagError(what, match.start("name"), remedy)


def _entry(match: re.Match[str]) -> TagEntry:
    name, operation = match["name"], match["operation"] or "="
    value = _value(match)
    if operation == "*=" and not isinstance(value, float | Reference):
        raise TagError(f"{name}{operation} needs a number", match.start("name"))
    return TagEntry(name, operation, value)


def _value(match: re.Match[str]) -> Value | Reference | Template:
    quoted, plain = match["quoted"], match["plain"]
    if quoted is not None:
        quoted = quoted.replace('""', '"')
        template = Template(quoted)
        return template if template.names else quoted.replace("$$", "$")
    if plain is None:
        return True
    if not plain.startswith("$"):
        return read_value(plain, match.start("plain"))
    if not _NAME.fullmatch(plain, 1):
        raise TagError(f"{plain} names no tag", match.start("plain"))
    return Reference(plain[1:])


def read_value(text: str, offset: int = -1) -> Value:
    """A plain value: a number, true or false, or a text, which may stand in quotes.

    Raises TagError with the offset for a number that is too large.
    """
    if _NUMBER.fullmatch(text):
        number = float(text)
        if not math.isfinite(number):
            raise TagError(f"{text} is too large", offset)
        return number
    return _WORDS.get(text, text.strip('"'))


def are_same(one: Mapping[str, Value], other: Mapping[str, Value]) -> bool:
    """Whether two sets of tags are equal; to Python, but not here, 1 is true."""
    kinds = {name: type(value) for name, value in one.items()}
    return one == other and kinds == {name: type(value) for name, value in other.items()}


def written(value: Value) -> str:
    """A value as text: whole numbers without a point, yes and no as true and false.

    Commas stand between the texts of a list.
    """
    match value:
        case tuple():
            return ", ".join(value)
        case bool():
            return "true" if value else "false"
        case float():
            return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
        case _:
            return value


def spell_entries(entries: Iterable[TagEntry]) -> str:
    """The entries as they are written between the braces; the inverse of `read_entries`."""
    return " ".join(map(_spell, entries))


def spell_tags(tags: Mapping[str, Value]) -> str:
    """What a sentence means, as the entries that say so; a list is collected text by text."""
    return spell_entries(
        TagEntry(name, "+=" if isinstance(value, tuple) else "=", part)
        for name, value in tags.items()
        for part in (value if isinstance(value, tuple) else (value,))
    )


def _spell(entry: TagEntry) -> str:
    match entry.value:
        case Reference(name):
            value = f"${name}"
        case Template(text):
            value = _quoted(text)
        case str() as text:
            is_plain = _PLAIN.fullmatch(text) and text not in _WORDS and not _NUMBER.fullmatch(text)
            value = text if is_plain else _quoted(text.replace("$", "$$"))
        case other:
            value = written(other)
    return f"{entry.name}{entry.operation}{value}"


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def evaluate(
    groups: Iterable[tuple[TagEntry, ...]], before: Mapping[str, Value] | None = None
) -> dict[str, Value]:
    """What remains when all tags, one group for each pair of braces, have taken effect, on those
    that were there before.
    """
    tags = dict(before or {})
    for entries in groups:
        used: set[str] = set()
        for entry in entries:
            value = _current(entry, tags)
            if value is not None:
                used.update(entry.takes)
                _apply(tags, entry, value)
        for name in used - {entry.name for entry in entries}:
            tags.pop(name, None)
    return tags


def _current(entry: TagEntry, tags: Mapping[str, Value]) -> Value | None:
    match entry.value:
        case Reference(name):
            return tags.get(name)
        case Template() as template:
            return template.fill(tags)
        case value:
            return value


def _apply(tags: dict[str, Value], entry: TagEntry, value: Value) -> None:
    before = tags.get(entry.name)
    match entry.operation:
        case "=":
            tags[entry.name] = value
        case "+=":
            tags[entry.name] = _sum(before, value)
        case "*=" if isinstance(before, float) and isinstance(value, float):
            tags[entry.name] = _rounded(before * value, before)


def _sum(before: Value | None, value: Value) -> Value:
    """Numbers are added; all else is collected."""
    if isinstance(value, float) and isinstance(before, float | None):
        return _rounded((before or 0.0) + value, before or 0.0)
    return (*_texts(before), *_texts(value))[:MOST_COLLECTED]


def _texts(value: Value | None) -> tuple[str, ...]:
    if value is None or isinstance(value, tuple):
        return value or ()
    return (written(value),)


def _rounded(result: float, before: float) -> float:
    """A result without the noise of its last digits; the number before when it is too large."""
    # Ten times 0.3 is to read 3, not 3.0000000000000004; and there is no -0.
    return round(result, 9) + 0.0 if math.isfinite(result) else before
