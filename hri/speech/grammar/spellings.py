"""What a typed text stands for: digits are number words, and "what's" is "what is".

A grammar has the words that are spoken. People type `2` for "two" and `$1,000`, contract,
abbreviate or write out as they like; each such spelling counts as the words of the grammar that it
stands for.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Iterator, Mapping

from hri.speech.grammar.numerals import CURRENCIES, LARGE, sayings
from hri.speech.grammar.words import normalize

MOST_SPELLINGS = 16
"""Ways to read a text that are tried."""

_HUNDREDS = re.compile(r"[0-9]{3}(?![0-9])(\.[0-9]+)?\D?")
_BEFORE_HUNDREDS = re.compile(r"\D{0,2}[0-9]{1,3}(,[0-9]{3})*")
"""Of a number with spaces, such as "1 000"."""
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
    """The contractions and abbreviations among some words, by what they stand for.

    "what is" is "what's", "usa" and "u s a" are "u.s.a.".
    """
    short = [word for word in known if "'" in word or word.endswith(".")]
    return {" ".join(form): word for word in short for form in _written_out(word)}


def spellings(
    words: list[str], known: Collection[str], forms: Mapping[str, str]
) -> Iterator[list[str]]:
    """Other words that a text may stand for, made of the known ones; the text itself is not one.

    `forms` are the `contracted_forms` of the known words. Words that are not known and stand for
    nothing are left as they are.
    """
    if not forms and all(word.isalpha() for word in words):
        return
    for grouped in _grouped(words):
        ways = itertools.product(*(_readings(word, known, forms) for word in grouped))
        for way in itertools.islice(ways, MOST_SPELLINGS):
            spelled = [part for reading in way for part in reading]
            for reading in (spelled, _contracted(spelled, forms)) if forms else (spelled,):
                if reading != words:
                    yield reading


def _grouped(words: list[str]) -> Iterator[list[str]]:
    """The words with "1 000" as one number and "$5 million" as "5 million dollars"; then as they
    are.
    """
    if any(word[0].isdigit() or word[0] in CURRENCIES for word in words):
        row: list[str] = []
        for word in words:
            if row and _HUNDREDS.fullmatch(word) and _BEFORE_HUNDREDS.fullmatch(row[-1]):
                row[-1] += f",{word}"
            elif word in LARGE and row and row[-1][0] in CURRENCIES and len(row[-1]) > 1:
                row[-1:] = [row[-1][1:], word, row[-1][0]]
            else:
                row.append(word)
        if row != words:
            yield row
    yield words


def _readings(word: str, known: Collection[str], forms: Mapping[str, str]) -> list[list[str]]:
    """What a word may stand for, itself first where the grammar knows it."""
    if word in CURRENCIES:
        return [*([name] for name in CURRENCIES[word] if name in known), []]
    short = [[forms[word]]] if word in forms else []
    if word.isalpha():
        return [[word], *short]
    written = [
        [part if part in known else forms.get(part, part) for part in form]
        for form in _written_out(word)
    ]
    said = [form for form in (*written, *short) if all(part in known for part in form)]
    return [[word], *said] if word in known or not said else said


def _written_out(word: str) -> Iterator[list[str]]:
    if any(sign.isnumeric() for sign in word):
        yield from map(normalize, dict.fromkeys(sayings(word)))
    if word.endswith("."):
        letters = word.split(".")[:-1]
        yield ["".join(letters)]
        yield letters
    for whole in _WHOLE.get(word, ()):
        yield whole.split()
    for ending, parts in _PARTS.items():
        if word.endswith(ending) and len(word) > len(ending):
            yield from ([word.removesuffix(ending), part] for part in parts)


def _contracted(words: list[str], forms: Mapping[str, str]) -> list[str]:
    """The words with each row contracted that the grammar knows as one word, the longest first."""
    longest = max(form.count(" ") for form in forms) + 1
    row: list[str] = []
    position = 0
    while position < len(words):
        for length in range(min(longest, len(words) - position), 1, -1):
            whole = forms.get(" ".join(words[position : position + length]))
            if whole is not None:
                break
        else:
            length, whole = 1, words[position]
        row.append(whole)
        position += length
    return row
