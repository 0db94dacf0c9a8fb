"""The line of an authored file that a message refers to, with a caret under the spot."""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from pathlib import Path

from hri.core.errors import HriError, Place
from hri.speech.grammar.encoding import read_source

WIDEST = 100
"""Most characters of a line to show."""


class Excerpts:
    """Lines of files, each file read once."""

    def __init__(self) -> None:
        self._lines: dict[Path, Sequence[str]] = {}

    def of(self, place: Place) -> str:
        """Two indented lines: the file's and the caret; empty without a line."""
        if place.path not in self._lines:
            try:
                self._lines[place.path] = read_source(place.path).text.split("\n")
            except HriError:
                self._lines[place.path] = ()
        lines = self._lines[place.path]
        if not 0 < place.line <= len(lines) or not lines[place.line - 1].strip():
            return ""
        line, column = lines[place.line - 1].rstrip(), place.column - 1
        # A long line is cut to what is around the spot.
        first = max(0, column - WIDEST // 2) if len(line) > WIDEST else 0
        before, shown = line[first : first + column - first], line[first : first + WIDEST]
        return f"    {_printable(shown)}\n    {_blank(before)}^"


def _blank(text: str) -> str:
    """Spaces as wide as a text is on a screen."""
    wide = sum(unicodedata.east_asian_width(letter) in "WF" for letter in text)
    return " " * (len(text) + wide)


def _printable(text: str) -> str:
    return "".join(letter if letter.isprintable() else " " for letter in text)
