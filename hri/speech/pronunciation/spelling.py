"""What an author may have meant by a word that no dictionary knows."""

from __future__ import annotations

import difflib
import string
from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cache
from importlib.resources import files
from typing import Protocol

from hri.speech.pronunciation.lexicon import Lexicon

LONGEST_WORD = 30
"""Letters; a longer word is not looked into."""
SHORTEST_WORD = 4
"""Letters; a shorter one may be anything, unless it is a common word."""
SHORTEST_PART = 3
"""Letters of each of two words that were written as one."""
LIKENESS = 0.8
"""Share of the letters that a common word must have in order, to be meant after several slips."""
_LETTERS = string.ascii_lowercase + "'"


class _Words(Protocol):
    """A lexicon, or a set."""

    def __contains__(self, word: str, /) -> bool: ...


def meant(word: str, lexicon: Lexicon) -> str:
    """Known words that are likely meant, two when they were written as one; else empty.

    Common words come first: the dictionary has many names that are one letter away from one.
    """
    common = vocabulary()
    return (
        _mended(word, common)
        or split(word, common)
        or _like(word)
        or near(word, lexicon)
        or split(word, lexicon)
    )


@cache
def vocabulary() -> frozenset[str]:
    """Some ten thousand words of English, in alphabetical order in `vocabulary.txt`."""
    text = files(__package__).joinpath("vocabulary.txt").read_text(encoding="utf-8")
    return frozenset(text.split())


@cache
def _by_letter() -> Mapping[str, list[str]]:
    found: dict[str, list[str]] = defaultdict(list)
    for word in sorted(vocabulary()):
        found[word[0]].append(word)
    return dict(found)


def split(word: str, known: _Words) -> str:
    """Known words that were written as one: "footpath" as "foot path", "turn_on"; else empty."""
    parts = [part for part in word[:LONGEST_WORD].split("_") if part]
    if "_" in word:
        return " ".join(parts) if parts and all(part in known for part in parts) else ""
    cuts = range(SHORTEST_PART, min(len(word), LONGEST_WORD) - SHORTEST_PART + 1)
    ways = (f"{word[:cut]} {word[cut:]}" for cut in cuts if _are_known(word, cut, known))
    return next(ways, "")


def _are_known(word: str, cut: int, known: _Words) -> bool:
    return word[:cut] in known and word[cut:] in known


def near(word: str, known: _Words) -> str:
    """A known word that is one slip of the fingers away and begins alike; else empty."""
    return _mended(word, known) if len(word) >= SHORTEST_WORD else ""


def _mended(word: str, known: _Words) -> str:
    if len(word) > LONGEST_WORD:
        return ""
    return next((mended for mended in _slips(word) if mended != word and mended in known), "")


def _like(word: str) -> str:
    """The common word that is most like it, with the same first letter; else empty."""
    if not SHORTEST_WORD <= len(word) <= LONGEST_WORD:
        return ""
    return next(
        iter(difflib.get_close_matches(word, _by_letter().get(word[0], ()), 1, LIKENESS)), ""
    )


def _slips(word: str) -> Iterator[str]:
    """Words with two letters swapped, one more, one fewer, one other: likeliest slips first."""
    places = range(1, len(word))
    for place in range(len(word) - 1):
        yield word[:place] + word[place + 1] + word[place] + word[place + 2 :]
    for place in (*places, len(word)):
        yield from (word[:place] + letter + word[place:] for letter in _LETTERS)
    for place in places:
        yield word[:place] + word[place + 1 :]
    for place in places:
        yield from (word[:place] + letter + word[place + 1 :] for letter in _LETTERS)
