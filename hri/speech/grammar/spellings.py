"""What a typed text stands for: digits are number words, and "what's" is "what is".

A grammar has the words that are spoken. People type `2` for "two", and contract or write out as
they like; each such spelling counts as the words of the grammar that it stands for.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping

from hri.speech.grammar.numerals import in_words
from hri.speech.grammar.words import normalize

MOST_SPELLINGS = 16
"""Ways to read a text that are tried."""

_PARTS = {
    "'d": ("would", "had"),
    "'ll": ("will",),
    "'m": ("am",),
    "'re": ("are",),
    "'s": ("is", "has", "us"),
    "'ve": ("have",),
    "n't": ("not",),
}
_WHOLE = {"can't": ("can not", "cannot"), "won't": ("will not",), "shan't": ("shall not",)}
"""Contractions that are more than a word and its ending."""


def contracted_forms(known: Collection[str]) -> dict[str, str]:
    """The contractions among some words, by what they stand for: "what is" is "what's"."""
    contractions = [word for word in known if "'" in word]
    return {" ".join(form): word for word in contractions for form in _written_out(word)}


def spellings(
    words: list[str], known: Collection[str], forms: Mapping[str, str]
) -> Iterator[list[str]]:
    """Other words that a text may stand for, made of the known ones; the text itself is not one.

    `forms` are the `contracted_forms` of the known words. Words that are not known and stand for
    nothing are left as they are.
    """
    if not forms and all(word.isalpha() for word in words):
        return
    ways = itertools.product(*(_readings(word, known) for word in words))
    for way in itertools.islice(ways, MOST_SPELLINGS):
        spelled = [part for reading in way for part in reading]
        for reading in (spelled, _contracted(spelled, forms)) if forms else (spelled,):
            if reading != words:
                yield reading


def _readings(word: str, known: Collection[str]) -> list[list[str]]:
    """What a word may stand for, itself first where the grammar knows it."""
    if word.isalpha():
        return [[word]]
    said = [form for form in _written_out(word) if all(part in known for part in form)]
    return [[word], *said] if word in known or not said else said


def _written_out(word: str) -> Iterator[list[str]]:
    if any(sign.isdigit() for sign in word):
        yield normalize(in_words(word))
    for whole in _WHOLE.get(word, ()):
        yield whole.split()
    for ending, parts in _PARTS.items():
        if word.endswith(ending) and len(word) > len(ending):
            yield from ([word.removesuffix(ending), part] for part in parts)


def _contracted(words: list[str], forms: Mapping[str, str]) -> list[str]:
    """The words with each pair contracted that the grammar knows as one word."""
    row: list[str] = []
    for word in words:
        pair = forms.get(f"{row[-1]} {word}") if row else None
        if pair is None:
            row.append(word)
        else:
            row[-1] = pair
    return row
