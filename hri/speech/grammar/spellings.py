"""What a typed text stands for: digits are number words, and "what's" is "what is".

A grammar has the words that are spoken. People type `2` for "two" and `$1,000`, contract,
abbreviate, write out or put hyphens as they like; each such spelling counts as the words of the
grammar that it stands for.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Iterator, Mapping
from typing import NamedTuple

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


class Spelling(NamedTuple):
    """A text in words that it may stand for."""

    words: list[str]
    origins: list[tuple[int, int]]
    """Of each word, the numbers of the first word it stands for and of the one behind the last."""


def contracted_forms(known: Collection[str]) -> dict[str, str]:
    """The contractions, abbreviations, numbers, and words with a hyphen among some words, by what
    they stand for.

    "what is" is "what's", "usa" and "u s a" are "u.s.a.", "ice cream" is "ice-cream", and
    "one thousand" is "1,000".
    """
    short = [
        word
        for word in known
        if "'" in word or "-" in word or word.endswith(".") or any(map(str.isdigit, word))
    ]
    return {" ".join(form): word for word in short for form in _written_out(word)}


def longest_of(forms: Mapping[str, str]) -> int:
    """Words of the longest of these `contracted_forms`."""
    return max((form.count(" ") for form in forms), default=0) + 1


def spellings(
    words: list[str], known: Collection[str], forms: Mapping[str, str], longest: int
) -> Iterator[Spelling]:
    """Other words that a text may stand for, made of the known ones; the text itself is not one.

    `forms` are the `contracted_forms` of the known words, `longest` is `longest_of` them. Words
    that are not known and stand for nothing are left as they are.
    """
    if not forms and all(word.isalpha() for word in words):
        return
    for grouped in _grouped(words):
        readings = (_readings(word, known, forms) for word in grouped.words)
        for way in itertools.islice(itertools.product(*readings), MOST_SPELLINGS):
            spelled = Spelling(
                [part for reading in way for part in reading],
                [
                    origin
                    for reading, origin in zip(way, grouped.origins, strict=True)
                    for _ in reading
                ],
            )
            for reading in (spelled, _contracted(spelled, forms, longest)) if forms else (spelled,):
                if reading.words != words:
                    yield reading


def as_it_stands(words: list[str]) -> Spelling:
    """A text in its own words."""
    return Spelling(words, [(place, place + 1) for place in range(len(words))])


def _grouped(words: list[str]) -> Iterator[Spelling]:
    """The words with "1 000" as one number, "$ 5" as "$5", and "$5 million" as "5 million dollars";
    then as they are.
    """
    if any(word[0].isdigit() or word[0] in CURRENCIES for word in words):
        row: list[str] = []
        origins: list[tuple[int, int]] = []
        for place, word in enumerate(words):
            if row and _HUNDREDS.fullmatch(word) and _BEFORE_HUNDREDS.fullmatch(row[-1]):
                row[-1] += f",{word}"
                origins[-1] = (origins[-1][0], place + 1)
            elif row and row[-1] in CURRENCIES and word[0].isdigit():
                row[-1] += word
                origins[-1] = (origins[-1][0], place + 1)
            elif word in LARGE and row and row[-1][0] in CURRENCIES and len(row[-1]) > 1:
                row[-1:] = [row[-1][1:], word, row[-1][0]]
                origins[-1:] = [(origins[-1][0], place + 1)] * 3
            else:
                row.append(word)
                origins.append((place, place + 1))
        if row != words:
            yield Spelling(row, origins)
    yield as_it_stands(words)


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
    whole = [[forms[text]] for form in written if (text := " ".join(form)) in forms]
    said = [form for form in (*written, *short, *whole) if all(part in known for part in form)]
    return [[word], *said] if word in known or not said else said


def _written_out(word: str) -> Iterator[list[str]]:
    if any(sign.isnumeric() for sign in word):
        yield from map(normalize, dict.fromkeys(sayings(word)))
    if word.endswith("."):
        letters = word.split(".")[:-1]
        yield ["".join(letters)]
        yield letters
    joined = word.split("-")
    if len(joined) > 1 and all(joined):
        yield joined
        yield ["".join(joined)]
    for whole in _WHOLE.get(word, ()):
        yield whole.split()
    for ending, parts in _PARTS.items():
        if word.endswith(ending) and len(word) > len(ending):
            yield from ([word.removesuffix(ending), part] for part in parts)


def _contracted(text: Spelling, forms: Mapping[str, str], longest: int) -> Spelling:
    """The words with each row contracted that the grammar knows as one word, the longest first."""
    words, origins = text
    row = Spelling([], [])
    position = 0
    while position < len(words):
        for length in range(min(longest, len(words) - position), 1, -1):
            whole = forms.get(" ".join(words[position : position + length]))
            if whole is not None:
                break
        else:
            length, whole = 1, words[position]
        row.words.append(whole)
        row.origins.append((origins[position][0], origins[position + length - 1][1]))
        position += length
    return row
