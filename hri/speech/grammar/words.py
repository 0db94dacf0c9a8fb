"""The words of a text as they are compared: grammars, lists of names and what is heard alike."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable

from hri.speech.grammar.numerals import CURRENCIES

ANY = "<any>"
"""Stands for a word that nobody listed; no word has a bracket."""
MOST_FREE = 12
"""Words that `<any>` stands for at most, where the grammar gives no number."""
_CURLY = "\N{RIGHT SINGLE QUOTATION MARK}"
_SPOKEN = {"&": " and ", "%": " percent ", "\N{DEGREE SIGN}": " degrees ", "\\": " "}
"""Signs that are said as words, or stand between words, wherever they are."""
_SIGNS = str.maketrans(_SPOKEN)


_FREE = re.compile(r"<any(?:\s+(\d{1,9})(?:\s*-\s*(\d{1,9}))?)?\s*>")
_INITIALS = re.compile(r"(?:[^\W\d_]{1,2}\.)+[^\W\d_]{1,2}")
"""Of "U.S.A." or "Ph.D.", all but the last point."""
_MINUS = str.maketrans("\N{MINUS SIGN}\N{EN DASH}", "--")
_BEFORE_DIGITS = frozenset("-+.").union(CURRENCIES)


def normalize(text: str) -> list[str]:
    """The words of a text: lower case, composed (NFC), without the punctuation around them.

    "salt & pepper" is "salt and pepper", "50%" is "50 percent"; "U.S.A" has its last point.
    """
    return [bare for word in _split(text) if (bare := _bare(word))]


def typed(text: str) -> list[str]:
    """The words of a text that someone typed: signs before numbers, and of currencies, are kept."""
    return [signed for word in _split(text) if (signed := _signed(word))]


def _split(text: str) -> list[str]:
    if not text.isascii():
        text = unicodedata.normalize("NFC", text).replace(_CURLY, "'")
    if not text.isalnum() and not _SPOKEN.keys().isdisjoint(text):
        text = text.translate(_SIGNS)
    return text.lower().split()


def free_words(written: str) -> tuple[int, int] | None:
    """How many words `<any>`, `<any 2>`, or `<any 1-3>` stands for, least and most; None for
    anything else.
    """
    match = _FREE.fullmatch(written)
    if match is None:
        return None
    if match[1] is None:
        return 1, MOST_FREE
    return int(match[1]), int(match[2] or match[1])


def said(words: Iterable[str]) -> str:
    """What an engine heard as a text: free words are as many ANY as they are words at least."""
    return " ".join(
        word if (free := free_words(word)) is None else " ".join([ANY] * free[0]) for word in words
    )


def listed(text: str) -> str:
    """A text without what stands in it for words that nobody listed."""
    return " ".join(word for word in text.split() if word != ANY)


def _bare(word: str) -> str:
    if word.isalnum() or word == ANY:
        return word
    start, end = _bounds(word)
    return f"{word[start:end]}." if _INITIALS.fullmatch(word, start, end) else word[start:end]


def _signed(word: str) -> str:
    if word.isalnum() or word in CURRENCIES or word == ANY:
        return word
    start, end = _bounds(word)
    if start == end or not (word[start].isdigit() or word[end - 1].isdigit()):
        return _bare(word)
    word = word.translate(_MINUS)
    first = start
    while start and word[first].isdigit() and word[start - 1] in _BEFORE_DIGITS:
        start -= 1
    end += word[end - 1].isdigit() and word[end : end + 1] in CURRENCIES
    return word[start:end]


def _bounds(word: str) -> tuple[int, int]:
    """Where a word begins and ends without the punctuation around it."""
    letters = [place for place, sign in enumerate(word) if sign.isalnum() or sign in "_'"]
    if not letters:
        return 0, 0
    end = letters[-1] + 1
    while end < len(word) and unicodedata.category(word[end]).startswith("M"):
        end += 1  # Accents and vowel signs belong to the letter before them.
    return letters[0], end
