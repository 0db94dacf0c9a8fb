"""Common first names of the United States, and who is named by a sentence.

A name shows that a line is for someone else ("leo, stop that"), or that someone is introduced.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from hri.speech.grammar.words import normalize

NAMES = Path(__file__).with_name("first_names.txt")
_BEGINNING = re.compile(r"(?:^|(?<=-)|(?<=^.'))[^\W\d_]")
"""Letters of a name that are capital."""
INTRODUCING = (
    ("i'm",),
    ("i", "am"),
    ("my", "name", "is"),
    ("my", "name's"),
    ("call", "me"),
    ("it's", "me"),
    ("this", "is"),
    ("meet",),
)
"""What stands before the name of who is introduced."""


@cache
def first_names() -> frozenset[str]:
    """All of them, in small letters; words that are more often something else are left out."""
    return frozenset(NAMES.read_text(encoding="utf-8").split())


def introduced(text: str, own: str = "") -> str:
    """The name of who is introduced by a sentence, or by their name alone; empty without one.

    `own` is the name of the robot, which introduces no one.
    """
    words = [word for word in normalize(text) if word != own.lower()]
    if len(words) == 1:
        return words[0].capitalize() if words[0] in first_names() else ""
    names = (name for start in range(len(words)) for name in _behind(words, start))
    return next(names, "").capitalize()


def as_name(text: str) -> str:
    """A name as it is written: "jean-luc" is "Jean-Luc"; words with capital letters stay."""
    return " ".join(word if word != word.lower() else _capitalized(word) for word in text.split())


def _capitalized(word: str) -> str:
    return _BEGINNING.sub(lambda letter: letter[0].upper(), word)


def _behind(words: Sequence[str], start: int) -> Sequence[str]:
    """The name behind an introduction that begins with a word, if one does."""
    for opening in INTRODUCING:
        end = start + len(opening)
        if tuple(words[start:end]) == opening and end < len(words):
            return [word for word in words[end : end + 1] if word in first_names()]
    return ()
