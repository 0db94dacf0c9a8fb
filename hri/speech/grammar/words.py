"""The words of a text as they are compared: grammars, lists of names and what is heard alike."""

from __future__ import annotations

import unicodedata

ANY = "<any>"
"""Stands for words that nobody listed; no word has a bracket."""
_CURLY = "\N{RIGHT SINGLE QUOTATION MARK}"
_SPOKEN = {"&": " and ", "%": " percent ", "\N{DEGREE SIGN}": " degrees ", "\\": " "}
"""Signs that are said as words, or stand between words, wherever they are."""
_SIGNS = str.maketrans(_SPOKEN)


def normalize(text: str) -> list[str]:
    """The words of a text: lower case, composed (NFC), without the punctuation around them.

    "salt & pepper" is "salt and pepper", "50%" is "50 percent".
    """
    if not text.isascii():
        text = unicodedata.normalize("NFC", text).replace(_CURLY, "'")
    if not text.isalnum() and not _SPOKEN.keys().isdisjoint(text):
        text = text.translate(_SIGNS)
    return [bare for word in text.lower().split() if (bare := _bare(word))]


def listed(text: str) -> str:
    """A text without what stands in it for words that nobody listed."""
    return " ".join(word for word in text.split() if word != ANY)


def _bare(word: str) -> str:
    if word.isalnum() or word == ANY:
        return word
    letters = [place for place, sign in enumerate(word) if sign.isalnum() or sign in "_'"]
    if not letters:
        return ""
    end = letters[-1] + 1
    while end < len(word) and unicodedata.category(word[end]).startswith("M"):
        end += 1  # Accents and vowel signs belong to the letter before them.
    return word[letters[0] : end]
