"""Text that someone else wrote, as messages show it: one line that cannot command a terminal."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import TextIO

LONGEST_QUOTE = 80
"""Characters between two quotation marks of a message."""
LONGEST_MESSAGE = 2000
"""Characters of a whole message: a list of known names still fits."""
CUT = "..."

_QUOTE = re.compile('"[^"]*"')


def escaped(text: str) -> str:
    """The text in one line that shows every character.

    Control characters, line separators, direction marks, invisible characters and lone surrogates
    appear as Python spells them: ``\\x1b``, ``\\u202e``.
    """
    return text if text.isprintable() else "".join(map(_shown, text))


def report(text: str, file: TextIO | None = None, *, flush: bool = False) -> None:
    """Print a result as one line, in which no name or text of a file can command the terminal."""
    print(escaped(text), file=file, flush=flush)


def quoted(text: str, most: int = LONGEST_QUOTE) -> str:
    """The text as `escaped` shows it, cut to a number of characters."""
    if len(text) <= most and text.isprintable():
        return text
    return _head(text, most)


def message_line(text: str) -> str:
    """A message in one line: each quotation in it cut to LONGEST_QUOTE, the whole in its middle."""
    line = _QUOTE.sub(lambda quotation: f'"{quoted(quotation[0][1:-1])}"', text)
    if len(line) <= LONGEST_MESSAGE and line.isprintable():
        return line
    shown = _head(line, LONGEST_MESSAGE)
    if not shown.endswith(CUT):
        return shown
    # The remedy stands at the end.
    end = "".join(reversed(list(_fitting(map(_shown, reversed(line)), LONGEST_MESSAGE // 3))))
    return f"{_head(line, LONGEST_MESSAGE * 2 // 3 - 1)} {end}"


def _head(text: str, most: int) -> str:
    """The beginning of the text as `escaped` shows it, with CUT where something is missing."""
    pieces = list(_fitting(map(_shown, text), most))
    if len(pieces) == len(text):
        return "".join(pieces)
    while sum(map(len, pieces)) > most - len(CUT) and pieces:
        pieces.pop()
    return "".join(pieces) + CUT


def _fitting(pieces: Iterable[str], most: int) -> Iterator[str]:
    """As many of the pieces as have `most` characters together."""
    length = 0
    for piece in pieces:
        length += len(piece)
        if length > most:
            return
        yield piece


def _shown(character: str) -> str:
    if character.isprintable():
        return character
    return character.encode("unicode_escape").decode("ascii")
