"""Words that are written alike and said in several ways: which one the words around them mean.

The table is `heteronyms.txt`. Each reading has the points of its part of speech, and more for each
word around it that shows it ("bass" beside "lake" is a fish); the one with most is said.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from hri.speech.pronunciation.phones import Phones, with_s
from hri.speech.pronunciation.word_classes import END, class_of, votes

BESIDE, NEAR = 3.0, 2.0
"""Points for a telling word right beside, and for one anywhere in the sentence."""
MOST_NEAR = 2
"""Telling words of a sentence that count."""
FIRST = 0.5
"""Points for the reading that is listed first, the likeliest."""
TAGGED = 1.0
"""Points for what another tagger says."""
TAGS = {"NN": "noun", "JJ": "adjective", "VBD": "past", "VBN": "past", "VB": "verb"}
"""Parts of speech by the first letters of tags of the Penn Treebank."""


@dataclass(frozen=True, slots=True)
class Reading:
    """One way to say a word."""

    parts_of_speech: tuple[str, ...]
    phones: Phones
    """With stress."""
    near: frozenset[str]
    """Words of the sentence that tell it."""
    before: frozenset[str]
    """Words right before it that do, two of them joined by "_"."""
    after: frozenset[str]
    """Words right after it that do, likewise."""


def said(words: Sequence[str], place: int, tag: str = "") -> Phones:
    """How the word at a place of a sentence is said, with stress; empty for all other words.

    Marks are words, too. `tag` is what a tagger of the Penn Treebank says of the word.
    """
    readings = _readings(words, place)
    if not readings:
        return ()
    around = [word.lower().replace("\N{RIGHT SINGLE QUOTATION MARK}", "'") for word in words]
    found = votes(around, place)
    part = next((part for name, part in TAGS.items() if tag.startswith(name)), "")
    found[part] = found.get(part, 0.0) + TAGGED
    points = [_points(reading, found, around, place) for reading in readings]
    points[0] += FIRST
    return readings[points.index(max(points))].phones


def _readings(words: Sequence[str], place: int) -> tuple[Reading, ...]:
    """Those of a word; one that is only written with a capital has its own ("Polish")."""
    word = words[place]
    proper = heteronyms().get(word, ()) if word[:1].isupper() else ()
    if not proper:
        return heteronyms().get(word.lower(), ())
    begins = class_of(words[place - 1] if place else "") == END
    return proper if begins else proper[:1]


def _points(
    reading: Reading, found: Mapping[str, float], words: Sequence[str], place: int
) -> float:
    beside = len(reading.before & _joined(reversed(words[:place][-2:]), backward=True))
    following = (word for word in words[place + 1 : place + 4] if word != "-")
    beside += len(reading.after & _joined(following))
    near = len(reading.near & {*words[:place], *words[place + 1 :]})
    part = max(found.get(part, 0.0) for part in reading.parts_of_speech)
    return part + BESIDE * beside + NEAR * min(near, MOST_NEAR)


def _joined(words: Iterator[str], *, backward: bool = False) -> frozenset[str]:
    """One word, and it with the next."""
    one, two = next(words, ""), next(words, "")
    return frozenset((one, f"{two}_{one}" if backward else f"{one}_{two}"))


@cache
def heteronyms() -> Mapping[str, tuple[Reading, ...]]:
    """The readings of each word, and of its form with -s."""
    text = files(__package__).joinpath("heteronyms.txt").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    listed = {line.split()[0]: tuple(_parsed(line.partition(" ")[2])) for line in lines}
    return {**dict(_with_s(listed)), **listed}


def _parsed(text: str) -> Iterator[Reading]:
    for reading in text.split("|"):
        parts, _, rest = reading.partition(":")
        phones: list[str] = []
        telling: dict[str, list[str]] = {"": phones, "~": [], "<": [], ">": []}
        group = phones
        for word in rest.split():
            if word in telling:
                group = telling[word]
            else:
                group.append(word)
        sides = (frozenset(telling[sign]) for sign in "~<>")
        yield Reading(tuple(parts.split()), tuple(phones), *sides)


def _with_s(listed: Mapping[str, tuple[Reading, ...]]) -> Iterator[tuple[str, tuple[Reading, ...]]]:
    for word, readings in listed.items():
        inflected = [
            Reading(kept, with_s(one.phones), one.near, one.before, one.after)
            for one in readings
            if (kept := tuple({"noun", "verb"} & {*one.parts_of_speech}))
        ]
        if inflected and (word.endswith("ss") or not word.endswith("s")):
            yield word + ("es" if word.endswith(("ss", "sh")) else "s"), tuple(inflected)
