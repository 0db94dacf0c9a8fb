"""The words of a text as they are compared: grammars, lists of names and what is heard alike."""

from __future__ import annotations

import difflib
import re
import unicodedata
from collections.abc import Callable, Iterable

from hri.speech.grammar.numerals import CURRENCIES

ANY = "<any>"
"""Stands for a word that nobody listed; no word has a bracket."""
MOST_FREE = 12
"""Words that `<any>` stands for at most, where the grammar gives no number."""
MOST_SPOKEN = 3
"""Words that the free slot `<name.spoken>` stands for at most, likewise."""
_ASCII = str.maketrans(
    "\N{RIGHT SINGLE QUOTATION MARK}\N{HYPHEN}\N{NON-BREAKING HYPHEN}\N{EN DASH}\N{MINUS SIGN}",
    "'----",
)
_SPOKEN = {"&": " and ", "%": " percent ", "\N{DEGREE SIGN}": " degrees ", "\\": " "}
"""Signs that are said as words, or stand between words, wherever they are."""
_SIGNS = str.maketrans(_SPOKEN)


_FREE = re.compile(
    r"<(?:any|(?P<slot>[A-Za-z_]\w*)\.spoken)"
    r"(?:\s+(?P<least>\d{1,9})(?:\s*-\s*(?P<most>\d{1,9}))?)?\s*>"
)
_MISSPELT = re.compile(
    r"(?P<slot>[A-Za-z_]\w{0,99})\.(?P<end>[A-Za-z]{4,9})(?P<number>\s+\d{1,3}(-\d{1,3})?)?"
)
_PLACEHOLDER = re.compile(r"<[A-Za-z_]\w*>")
_INITIALS = re.compile(r"(?:[^\W\d_]{1,2}\.)+[^\W\d_]{1,2}")
"""Of "U.S.A." or "Ph.D.", all but the last point."""
_BEFORE_DIGITS = frozenset("-+.").union(CURRENCIES)


def normalize(text: str) -> list[str]:
    """The words of a text: lower case, composed (NFC), without the punctuation around them.

    "salt & pepper" is "salt and pepper", "50%" is "50 percent"; "U.S.A" has its last point.
    """
    return [bare for word in _split(text) if (bare := _bare(word))]


def typed(text: str) -> list[str]:
    """The words of a text that someone typed: signs before numbers, and of currencies, are kept."""
    return [signed for word in _split(text) if (signed := _signed(word))]


def as_typed(text: str) -> list[str]:
    """The same words, as many as `typed` gives, in the letters that they were typed in."""
    words = _split(text, str)
    return [_signed(word) or word for word in words if _signed(word.lower())]


def _split(text: str, letters: Callable[[str], str] = str.lower) -> list[str]:
    if not text.isascii():
        text = unicodedata.normalize("NFC", text).translate(_ASCII)
    if not text.isalnum() and not _SPOKEN.keys().isdisjoint(text):
        text = text.translate(_SIGNS)
    return letters(text).split()


def free_words(written: str) -> tuple[int, int] | None:
    """How many words `<any>`, `<any 2>`, `<any 1-3>`, or a free slot as `<name.spoken>` or
    `<name.spoken 1-2>` stands for, least and most; None for anything else.
    """
    match = _FREE.fullmatch(written)
    if match is None:
        return None
    if match["least"] is None:
        return 1, MOST_FREE if match["slot"] is None else MOST_SPOKEN
    return int(match["least"]), int(match["most"] or match["least"])


def slot_name(written: str) -> str:
    """The name of a free slot: "name" of `<name.spoken 1-2>`; empty for `<any>` and words."""
    match = _FREE.fullmatch(written)
    return (match["slot"] or "") if match is not None else ""


def misspelt_slot(name: str) -> str:
    """The free slot that is meant by a name such as `name.spokn 1-2`; empty if none is."""
    match = _MISSPELT.fullmatch(name)
    if match is None or not difflib.get_close_matches(match["end"].lower(), ["spoken"], cutoff=0.7):
        return ""
    return f"{match['slot']}.spoken{match['number'] or ''}"


def said(words: Iterable[str]) -> str:
    """What an engine heard as a text: free words are as many ANY as they are words at least."""
    return " ".join(
        word if (free := free_words(word)) is None else " ".join([ANY] * free[0]) for word in words
    )


def is_placeholder(word: str) -> bool:
    """Whether a word stands for one that nobody listed: ANY, or `<name>` for one of a free slot."""
    return word.startswith("<") and _PLACEHOLDER.fullmatch(word) is not None


def listed(text: str) -> str:
    """A text without what stands in it for words that nobody listed."""
    return " ".join(word for word in text.split() if word != ANY)


def _bare(word: str) -> str:
    if word.isalnum() or is_placeholder(word):
        return word
    start, end = _bounds(word)
    return f"{word[start:end]}." if _INITIALS.fullmatch(word, start, end) else word[start:end]


def _signed(word: str) -> str:
    if word.isalnum() or word in CURRENCIES or is_placeholder(word):
        return word
    start, end = _bounds(word)
    if start == end or not (word[start].isdigit() or word[end - 1].isdigit()):
        return _bare(word)
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
