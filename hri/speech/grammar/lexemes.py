"""The pieces a JSGF text consists of, and the lines and columns they stand at."""

from __future__ import annotations

import re
from bisect import bisect_right
from typing import NamedTuple

from hri.speech.grammar.expressions import SourceSpan

MOST_LEXEMES = 300_000
"""Words and signs of one file; a file of 4 MB of sensible text has about as many."""
TOO_MUCH = "too much"
"""Text of the lexeme of kind "end" where there is more."""

_LEXICON = re.compile(
    r"""(?P<space>\s+)
    |(?P<word>[^\s=;|*+<>()\[\]{}/"]++(?:/(?![/*])[^\s=;|*+<>()\[\]{}/"]++)*+)
    |(?P<rule><(?:[^\s<>{}"*]+|[^<>;|(){}\[\]\n"]*)>)
    |(?P<sign>[=;|*+()\[\]])
    |(?P<tag>\{[^\\{}]*+(?:(?:\\.|\{[^\\{}]*+\})[^\\{}]*+){0,100}+\})
    |(?P<comment>//[^\n]*+|/\*.*?(?:\*/|\Z))
    |(?P<quoted>"[^"\\\n]*+(?:\\.[^"\\\n]*+){0,100}+")
    |(?P<weight>/[^/\n|;]*+/)
    |(?P<stray>.)""",
    re.VERBOSE | re.DOTALL,
)
# A "/" inside a word is part of it ("and/or") unless a comment begins there; a rule's name may
# hold almost any sign, but no white space: the second form is read to be refused as a whole.
# A tag may hold braces in pairs, as code does.
# No form looks far ahead in vain: a text of only escaped quotes takes no longer than others.


class Lexeme(NamedTuple):
    """A piece of the text; `kind` is a group of the lexicon, or "end"."""

    kind: str
    text: str
    start: int
    end: int


class Lines:
    """Knows the line and column of an offset into a text, both counted from 1."""

    def __init__(self, text: str) -> None:
        self._starts = [0, *(match.end() for match in re.finditer("\n", text))]

    def place(self, offset: int) -> tuple[int, int]:
        line = bisect_right(self._starts, offset)
        return line, offset - self._starts[line - 1] + 1

    def span(self, start: int, end: int) -> SourceSpan:
        line, column = self.place(start)
        if line == len(self._starts) or end < self._starts[line]:
            return SourceSpan(line, column, line, column + end - start)
        return SourceSpan(line, column, *self.place(end))


class Lexemes(NamedTuple):
    """A text in pieces, the last of kind "end"; comments apart from the rest."""

    pieces: list[Lexeme]
    comments: list[Lexeme]


def split(text: str, start: int) -> Lexemes:
    """The pieces from an offset on; ends after MOST_LEXEMES, when more is left of the text."""
    pieces: list[Lexeme] = []
    comments: list[Lexeme] = []
    for match in _LEXICON.finditer(text, start):
        kind = match.lastgroup or "stray"
        if kind == "space":
            continue
        lexeme = Lexeme(kind, match.group(), match.start(), match.end())
        if kind == "comment":
            comments.append(lexeme)
        else:
            pieces.append(lexeme)
        if len(pieces) >= MOST_LEXEMES or len(comments) >= MOST_LEXEMES:
            pieces.append(Lexeme("end", TOO_MUCH, match.end(), match.end()))
            return Lexemes(pieces, comments)
    pieces.append(Lexeme("end", "the end of the file", len(text), len(text)))
    return Lexemes(pieces, comments)
