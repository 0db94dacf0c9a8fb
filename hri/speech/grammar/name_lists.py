"""Lists of names from text files: `import "friends.txt" as <friend>;`.

One name a line, in UTF-8, as it is spoken:

    # Who may be called.
    Robin Smith
    the boss = Alex
    room twelve = 12

What is heard sets a tag of the rule's name, here `friend`, to the line's value: what stands behind
"=", a number or true or false as in tags, and without "=" the name as it is written.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from hri.core.errors import AuthoringError, Place
from hri.core.reading import read_text
from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    Sequence,
    SourceSpan,
    Tagged,
    Token,
)
from hri.speech.grammar.tags import TagEntry, TagError, Value, read_value
from hri.speech.grammar.words import normalize

MOST_NAMES = 100_000
"""Lines with a name in one file."""
LONGEST_NAME = 200
"""Characters of one line."""
MOST_LISTS = 20
"""Lists of what free slots usually are that are kept, until their text changes."""
MOST_ERRORS = 100
"""Most mistakes reported for one file."""


def read_names(path: Path, tag: str) -> tuple[Expression, list[AuthoringError]]:
    """The names of a file as alternatives that set a tag, and the mistakes in its lines.

    Raises HriError when it cannot be read, AuthoringError when it is not UTF-8 text.
    """
    text = read_text(path, "list of names")
    errors: list[AuthoringError] = []
    choices: list[Expression] = []
    known: dict[str, tuple[Value, int]] = {}
    for number, column, line in _lines(text):
        try:
            words, value = _name(line)
            if _is_new(known, " ".join(words), value, number):
                choices.append(_choice(words, TagEntry(tag, "=", value), number, column, len(line)))
        except TagError as error:
            place = Place(path, number, column)
            errors.append(AuthoringError(place, str(error), "write: spoken words = value"))
            if len(errors) >= MOST_ERRORS:
                break
        if len(choices) > MOST_NAMES:
            what = f"more than {MOST_NAMES} names"
            errors.append(AuthoringError(Place(path, number), what, "shorten the list"))
            break
    if not choices and not errors:
        errors.append(AuthoringError(Place(path), "no name in this list", "write one a line"))
    whole = SourceSpan(1, 1, text.count("\n") + 1, 1)
    return Alternative(tuple(choices), (1.0,) * len(choices), whole), errors


def read_known(path: Path) -> tuple[tuple[str, ...], tuple[AuthoringError, ...]]:
    """What a free slot usually is: the lower case words of each line, each once, and the mistakes.

    Raises HriError when it cannot be read, AuthoringError when it is not UTF-8 text.
    """
    return _known(read_text(path, "list of names"), path)


@lru_cache(maxsize=MOST_LISTS)
def _known(text: str, path: Path) -> tuple[tuple[str, ...], tuple[AuthoringError, ...]]:
    """Most grammars are read again and again with the same lists, which are long."""
    errors: list[AuthoringError] = []
    known: dict[str, None] = {}
    for number, column, line in _lines(text):
        try:
            words, _ = _name(line)
            if "=" in line:
                raise TagError("a free slot takes its value from what is said", -1)
            known[" ".join(words)] = None
        except TagError as error:
            place = Place(path, number, column)
            errors.append(AuthoringError(place, str(error), "write words only"))
        if len(errors) >= MOST_ERRORS:
            break
        if len(known) > MOST_NAMES:
            what = f"more than {MOST_NAMES} names"
            errors.append(AuthoringError(Place(path, number), what, "shorten the list"))
            break
    if not known and not errors:
        errors.append(AuthoringError(Place(path), "no name in this list", "write one a line"))
    return tuple(known), tuple(errors)


def _is_new(known: dict[str, tuple[Value, int]], name: str, value: Value, line: int) -> bool:
    """Whether a name stands here for the first time. Raises TagError for a second value."""
    first, at = known.setdefault(name, (value, line))
    if at != line and first != value:
        raise TagError(f'"{name}" has another value in line {at}', -1)
    return at == line


def _lines(text: str) -> Iterator[tuple[int, int, str]]:
    """Number, column and text of the lines that hold a name, comments cut off."""
    for number, line in enumerate(text.split("\n"), start=1):
        if "#" in line:
            line = line.partition(" #")[0] if not line.lstrip().startswith("#") else ""
        stripped = line.strip()
        if stripped:
            yield number, len(line) - len(line.lstrip()) + 1, stripped


def _name(line: str) -> tuple[list[str], Value]:
    """The spoken words of a line and its value. Raises TagError."""
    spoken, sign, value = line.partition("=")
    words = normalize(spoken)
    if len(line) > LONGEST_NAME:
        raise TagError(f"a name of {len(line)} characters is too long", -1)
    if not words:
        raise TagError("no spoken words here", -1)
    if sign and not value.strip():
        raise TagError('no value behind "="', -1)
    if '"' in value.strip().strip('"'):
        raise TagError("a quote inside the value", -1)
    return words, read_value(value.strip()) if sign else line.strip('"')


def _choice(words: list[str], entry: TagEntry, line: int, column: int, length: int) -> Tagged:
    span = SourceSpan(line, column, line, column + length)
    tokens = tuple([Token(word, span) for word in words])
    return Tagged(tokens[0] if len(tokens) == 1 else Sequence(tokens, span), (entry,), span)
