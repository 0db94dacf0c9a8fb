"""Which words are names: of these the dictionary is asked first, not the rules of a voice.

`first_names.txt` holds the most frequent first names of the United States (Census Bureau, 1990, and
newer ones) that are not common words of English; they are known in small letters, too.
"""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

from hri.speech.pronunciation.lexicon import without_accents
from hri.speech.pronunciation.spelling import vocabulary

LONGEST_ABBREVIATION = 4
"""Letters: a longer word in capitals is a word ("NAKAMURA"), a shorter one may be spelled."""

OPENING = frozenset('.!?:…"“”(')
"""Marks after which a capital says nothing."""

_ENDING = re.compile(r"['\N{RIGHT SINGLE QUOTATION MARK}](?:s|d|ll|re|ve)?$")


def is_name(word: str, *, begins_sentence: bool = False) -> bool:
    """Whether a word, without 's or 'll, is a name by itself or by its capital.

    At the beginning of a sentence, where all words have one, the capital says nothing.
    """
    stem = _ENDING.sub("", word)
    lower = stem.lower()
    has_capital = stem[:1].isupper()
    if without_accents(lower) in first_names():
        return has_capital or stem == lower
    if begins_sentence or not has_capital or lower in vocabulary():
        return False
    return not stem.isupper() or len(stem) > LONGEST_ABBREVIATION


@cache
def first_names() -> frozenset[str]:
    """First names in small letters, in alphabetical order in `first_names.txt`."""
    text = files(__package__).joinpath("first_names.txt").read_text(encoding="utf-8")
    return frozenset(text.split())
