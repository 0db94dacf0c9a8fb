"""Reads a text aloud: each stretch of it that is not plain words, in the words that are said.

Addresses, numbers, amounts, dates, times, codes, abbreviations and signs are read as an American
does; plain words stay as they are.
"""

# ruff: noqa: RUF001 - signs of texts are meant.
from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher

from hri.speech.notation import (
    addresses,
    chemistry,
    clock_times,
    dates,
    fraction,
    measures,
    mixes,
    money,
    plain_numbers,
    roman,
    signs,
    telephone,
    versions,
    words,
)
from hri.speech.notation.abbreviations import (
    BEFORE_NUMBERS,
    DAY_OF,
    MONTH_OF,
    PLAIN,
    SPELLED,
    STREETS,
    TITLES,
)
from hri.speech.notation.rule import LETTER, Rule, Scan
from hri.speech.notation.units import CURRENCIES

_ALIKE = str.maketrans(
    "’‘′″‐‑‒\u00a0\u2007\u2009\u202f₀₁₂₃₄₅₆₇₈₉＋－∕∗∙⋅≦≧º˚\u2126\u03bc",
    "'''\"---    0123456789+-/*××≤≥°°Ωµ",
)
"""Characters that are read as others; one for one, so that places stay."""
_DIGIT = (
    *addresses.WEB,
    *dates.RULES,
    *clock_times.RULES,
    *telephone.RULES,
    *versions.RULES,
    *telephone.HYPHENED,
    *money.BY_NUMBER,
    *measures.RULES,
    *fraction.RULES,
    *plain_numbers.RULES,
    *mixes.RULES,
    *plain_numbers.PLAIN,
)
_LETTER = (
    *signs.LETTERS,
    *measures.BY_NAME,
    *addresses.WEB,
    *addresses.NAMES,
    *words.NAMES,
    *dates.NAMED,
    *words.ABBREVIATIONS,
    *versions.NAMED,
    *chemistry.RULES,
    *roman.RULES,
    *mixes.NAMED,
    *money.BY_NAME,
)
_ORDINARY = re.compile(r"(?:[a-z]{3,}|[A-Z]?[a-z]{4,})(?=[ ,;!?\n]|\.(?:\s|$))(?!, ?[A-Z]{2}\b)")
_SHORT = frozenset(
    name.rstrip(".").lower()
    for names in (PLAIN, BEFORE_NUMBERS, TITLES, STREETS, MONTH_OF, DAY_OF, SPELLED)
    for name in names
)
"""Words that may be abbreviations."""
_WORD = re.compile(rf"{LETTER}+(?:'{LETTER}+)*")
_WRITTEN = re.compile(r"\S+")


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of a text, and what is said for it."""

    begin: int
    end: int
    words: str
    is_read: bool
    """Whether a rule read it: then space stands around it."""


@dataclass(frozen=True, slots=True)
class Spoken:
    """A text in words."""

    text: str
    origins: tuple[int, ...]
    """For each of its characters the one of the written text that it stands for."""
    letters: frozenset[int]
    """Where letters stand that are said by their names."""


def _of_signs() -> dict[str, tuple[Rule, ...]]:
    """The rules for what begins with a sign, by that sign."""
    found: dict[str, tuple[Rule, ...]] = dict.fromkeys(CURRENCIES, money.BY_SIGN)
    found["("] = found["+"] = telephone.RULES
    found["."] = (*measures.RULES, *plain_numbers.PLAIN, *addresses.PATHS)
    found["~"] = found["/"] = addresses.PATHS
    for firsts, rules in signs.RULES:
        for first in firsts:
            found[first] = (*found.get(first, ()), *rules)
    return found


_SIGNS = _of_signs()


def read_aloud(text: str) -> str:
    """The words that are said for an English text."""
    return spoken(text).text


def spoken(text: str) -> Spoken:
    """The words that are said for an English text, with their places in it.

    Takes time in proportion to the length of the text, whatever it is.
    """
    said: list[str] = []
    origins: list[int] = []
    letters: list[int] = []
    is_apart = False
    for stretch in stretches(text):
        if not stretch.words:
            is_apart = True
            continue
        if (stretch.is_read or is_apart) and said and _touch(said[-1], stretch.words):
            said.append(" ")
            origins.append(origins[-1])
        if stretch.is_read:
            place = len(origins)
            letters += [
                place + m.start() for m in re.finditer(r"(?<![\w'])[A-Z](?![\w'])", stretch.words)
            ]
        said.append(stretch.words)
        origins += _origins(text, stretch)
        is_apart = stretch.is_read
    return Spoken("".join(said), tuple(origins), frozenset(letters))


def _touch(before: str, after: str) -> bool:
    return before[-1] not in " \n\t([\"'“—" and (after[0].isalnum() or after[0] in "—$")


def _origins(text: str, stretch: Stretch) -> Iterator[int]:
    """The place in the text of each character that is said for a stretch of it."""
    if not stretch.is_read:
        yield from range(stretch.begin, stretch.end)
        return
    written = list(_WRITTEN.finditer(text, stretch.begin, stretch.end))
    starts = [match.start() for match in written] or [stretch.begin]
    spoken_words = stretch.words.split(" ")
    places = aligned([match[0] for match in written] or [""], spoken_words)
    for number, (word, place) in enumerate(zip(spoken_words, places, strict=True)):
        yield from [starts[place]] * (len(word) + (number + 1 < len(spoken_words)))


def stretches(text: str) -> Iterator[Stretch]:
    """The stretches of a text, one after the other."""
    text = text.translate(_ALIKE)
    scan, place = Scan(), 0
    while place < len(text):
        stretch, is_amount = _stretch(text, place, scan)
        yield stretch
        written = text[place : stretch.end]
        if is_amount or not written.isspace() or len(written) > 1:
            scan.is_after_amount = is_amount
        if stretch.words.count('"') % 2 and not stretch.is_read:
            scan.is_quoted = not scan.is_quoted
        place = stretch.end


def _stretch(text: str, place: int, scan: Scan) -> tuple[Stretch, bool]:
    first = text[place]
    if first.isspace():
        end = place + 1
        while end < len(text) and text[end].isspace():
            end += 1
        return Stretch(place, end, text[place:end], is_read=False), False
    if (first.isalpha() and (found := _ORDINARY.match(text, place))) and (
        found[0].lower() not in _SHORT
    ):
        return Stretch(place, found.end(), found[0], is_read=False), False
    for rule in _rules(text, place, first):
        found = rule.pattern.match(text, place)
        if found and (said := rule.words(found, scan)) is not None:
            return Stretch(place, found.end(), said, is_read=True), rule.is_amount
    if found := _WORD.match(text, place):
        return Stretch(place, found.end(), found[0], is_read=False), False
    said = signs.alone(first)
    whole = first if said is None else said
    return Stretch(place, place + 1, whole, is_read=said is not None), False


def _rules(text: str, place: int, first: str) -> Sequence[Rule]:
    if first.isdecimal() or first in fraction.SIGNS:
        return _DIGIT
    if first.isalpha():
        is_inner = place and text[place - 1].isalnum()
        return signs.LETTERS if is_inner else _LETTER
    return _SIGNS.get(first, ())


def aligned(written: Sequence[str], read: Sequence[str]) -> list[int]:
    """Which written word each word that is read stands for ("$5" is read "five dollars")."""
    matcher = SequenceMatcher(
        None, [word.lower() for word in written], [word.lower() for word in read], autojunk=False
    )
    origins: list[int] = []
    for _, begin, end, first, last in matcher.get_opcodes():
        count, of = last - first, max(1, end - begin)
        origins += [min(begin + place * of // count, len(written) - 1) for place in range(count)]
    return origins
