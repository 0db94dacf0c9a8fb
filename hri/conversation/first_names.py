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
OWN = (
    ("i'm",),
    ("i", "am"),
    ("my", "name", "is"),
    ("my", "name's"),
    ("call", "me"),
    ("it's", "me"),
)
"""What stands before the name of who talks."""
INTRODUCING = (*OWN, ("this", "is"), ("meet",))
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
    return _named(words, INTRODUCING)


def introduces_self(text: str) -> bool:
    """Whether who talks says by a sentence what they are called."""
    return bool(_named(normalize(text), OWN))


def as_name(text: str) -> str:
    """A name as it is written: "jean-luc" is "Jean-Luc"; words with capital letters stay."""
    return " ".join(word if word != word.lower() else _capitalized(word) for word in text.split())


def _capitalized(word: str) -> str:
    return _BEGINNING.sub(lambda letter: letter[0].upper(), word)


def _named(words: Sequence[str], openings: Sequence[tuple[str, ...]]) -> str:
    """The first name behind one of these openings; empty without one."""
    rests = (
        words[start + len(opening) :]
        for start in range(len(words))
        for opening in openings
        if tuple(words[start : start + len(opening)]) == opening
    )
    return next((rest[0].capitalize() for rest in rests if {*rest[:1]} & first_names()), "")
