"""Sentences that mean different things and sound alike, found by their phones.

A sentence is the phones of its words, each said in its likeliest way. The words that two sentences
share tell nobody which was said, so they are taken out. How far apart the rest is, is the cheapest
way to turn one into the other, phone by phone (V. Levenshtein 1966, with the costs of
`hri.speech.pronunciation.phones`), over the phones of the longer one: 0 is the same sound, 1 is
nothing in common.

Comparing all with all would take hours for a large grammar. So sentences are drawn first, and each
is compared only with those of other meaning whose phones, counted by thirds of the sentence, are
most like its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher

import numpy as np
from numpy.typing import NDArray

from hri.speech.grammar.matching import Parse
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.pronunciation.phones import DROPPED, PHONES, distance

Words = tuple[str, ...]

NEAREST = 12
"""Sentences that each one is compared with phone by phone."""
LONGEST = 120
"""Phones of a sentence that are looked at."""
FARTHEST = 0.25
"""Pairs that are farther apart are not told."""
_BLOCK = 512

_NUMBERS = {phone: number for number, phone in enumerate(PHONES)}
COSTS = np.array([[distance(one, other) for other in PHONES] for one in PHONES], np.float32)
_LIKENESS = np.exp(-COSTS / 0.15).astype(np.float32)
"""How much of one phone counts as another one."""


@dataclass(frozen=True, slots=True)
class SoundAlike:
    """Two sentences of different meaning."""

    first: Parse
    second: Parse
    distance: float
    """0 to 1; see the top of this module."""

    @property
    def difference(self) -> tuple[str, str]:
        """The words in which they differ, without those they share."""
        return difference(self.first.text, self.second.text)


def difference(one: str, other: str) -> tuple[str, str]:
    """The words in which two texts differ, without those they share."""
    changes = differing(one.split(), other.split())
    first, second = (
        " ... ".join(" ".join(words) for words in side) for side in zip(*changes, strict=True)
    )
    return first, second


Change = tuple[Words, Words]
"""Words of one sentence, and what stands in their place in another; either may be none."""


def differing(one: Sequence[str], other: Sequence[str]) -> tuple[Change, ...]:
    """What stands between the words that two sentences share in the same order."""
    # "meter" and "meters" sound alike and hardly ever mean two things.
    stems = [word.removesuffix("s") for word in one], [word.removesuffix("s") for word in other]
    first, second = stems if stems[0] != stems[1] else (one, other)
    start = _shared(first, second)
    end = _shared(first[start:][::-1], second[start:][::-1])
    one, other = one[start : len(one) - end], other[start : len(other) - end]
    if len(one) < 2 or len(other) < 2:
        return ((tuple(one), tuple(other)),)
    first, second = first[start : len(first) - end], second[start : len(second) - end]
    changes = SequenceMatcher(None, first, second, autojunk=False).get_opcodes()
    return tuple(
        (tuple(one[begin:end]), tuple(other[other_begin:other_end]))
        for kind, begin, end, other_begin, other_end in changes
        if kind != "equal"
    )


def _shared(one: Sequence[str], other: Sequence[str]) -> int:
    """How many words at their beginnings are the same."""
    pairs = zip(one, other, strict=False)
    return next((n for n, (a, b) in enumerate(pairs) if a != b), min(len(one), len(other)))


def sound_alikes(
    readings: Sequence[Parse], lexicon: Lexicon, farthest: float = FARTHEST
) -> list[SoundAlike]:
    """Pairs with different meanings that are not farther apart, the nearest first.

    Of the pairs that differ in the same words ("five" and "nine" in whatever is said with a
    number) only one is told, and none that differs in more words than those. Raises HriError for a
    word that nobody knows to say.
    """
    words = [reading.text.split() for reading in readings]
    examples: dict[tuple[Change, ...], tuple[int, int]] = {}
    for one, other in _candidates(readings, [phones_of(said, lexicon) for said in words]).tolist():
        examples.setdefault(differing(words[one], words[other]), (one, other))
    distances = distances_of(list(examples), lexicon)
    near = [changes for changes in examples if distances[changes] <= farthest]
    found: list[SoundAlike] = []
    for changes in sorted(_simplest(near), key=distances.__getitem__):
        one, other = examples[changes]
        found.append(SoundAlike(readings[one], readings[other], distances[changes]))
    return found


def _simplest(differences: Iterable[tuple[Change, ...]]) -> list[tuple[Change, ...]]:
    """Those that have no simpler one inside."""
    told: set[frozenset[Words]] = set()
    kept: list[tuple[Change, ...]] = []
    for changes in sorted(
        differences, key=lambda changes: sum(len(a) + len(b) for a, b in changes)
    ):
        parts = {frozenset(change) for change in changes}
        for first, second in changes:
            parts |= {frozenset(((one,), (other,))) for one in first for other in second}
        if told.isdisjoint(parts):
            kept.append(changes)
            if len(changes) == 1:
                told.add(frozenset(changes[0]))
    return kept


def phones_of(words: Sequence[str], lexicon: Lexicon) -> NDArray[np.int32]:
    """The numbers of the phones of some words, each said in its likeliest way."""
    return numbered([phone for word in words for phone in lexicon.pronunciations(word)[0]])


def numbered(phones: Sequence[str]) -> NDArray[np.int32]:
    """Phones as numbers: their places in PHONES."""
    return np.array([_NUMBERS[phone] for phone in phones[:LONGEST]], np.int32)


def _candidates(
    readings: Sequence[Parse], spoken: Sequence[NDArray[np.int32]]
) -> NDArray[np.int32]:
    """Pairs of indexes worth comparing: of other meaning, nearest by counted phones. [pairs, 2]"""
    if not readings:
        return np.empty((0, 2), np.int32)
    meanings = _meaning_numbers(readings)
    counts = counted(spoken)
    squares = (counts**2).sum(axis=1)
    found: list[NDArray[np.int32]] = []
    for start in range(0, len(readings), _BLOCK):
        rows = slice(start, start + _BLOCK)
        apart = squares[rows, None] + squares[None, :] - 2 * counts[rows] @ counts.T
        apart[meanings[rows, None] == meanings[None, :]] = np.inf
        nearest = np.argsort(apart, axis=1)[:, :NEAREST]
        is_other = np.isfinite(np.take_along_axis(apart, nearest, axis=1))
        row, column = np.nonzero(is_other)
        found.append(np.stack([row + start, nearest[row, column]], axis=1).astype(np.int32))
    return np.unique(np.sort(np.concatenate(found), axis=1), axis=0)


def _meaning_numbers(readings: Iterable[Parse]) -> NDArray[np.int32]:
    """The same number for the same rule and tags."""
    numbers: dict[object, int] = {}
    keys = ((reading.rule, tuple(sorted(reading.tags.items()))) for reading in readings)
    return np.array([numbers.setdefault(key, len(numbers)) for key in keys], np.int32)


def counted(spoken: Sequence[NDArray[np.int32]]) -> NDArray[np.float32]:
    """How often each phone, or one like it, is in each third of some words. [words, 3 x 39]"""
    counts = np.zeros((len(spoken), 3, len(PHONES)), np.float32)
    for row, phones in enumerate(spoken):
        thirds = np.repeat(np.arange(3), [(len(phones) + spare) // 3 for spare in (2, 1, 0)])
        np.add.at(counts[row], (thirds, phones), 1.0)
    alike: NDArray[np.float32] = counts @ _LIKENESS
    return alike.reshape(len(spoken), -1)


def distances_of(
    differences: Sequence[tuple[Change, ...]], lexicon: Lexicon
) -> dict[tuple[Change, ...], float]:
    """The cost of all changes of each difference, over the phones of their longer sides."""
    changes = list(dict.fromkeys(change for each in differences for change in each))
    costs: dict[Change, tuple[float, int]] = {}
    for start in range(0, len(changes), _BLOCK):
        block = changes[start : start + _BLOCK]
        first, first_lengths = padded([phones_of(one, lexicon) for one, _ in block])
        second, second_lengths = padded([phones_of(other, lexicon) for _, other in block])
        found = _table(first, second)[first_lengths, second_lengths, np.arange(len(block))]
        longer = np.maximum(first_lengths, second_lengths)
        costs |= zip(block, zip(found.tolist(), longer.tolist(), strict=True), strict=True)
    return {
        each: sum(costs[change][0] for change in each)
        / max(sum(costs[change][1] for change in each), 1)
        for each in differences
    }


def _table(first: NDArray[np.int32], second: NDArray[np.int32]) -> NDArray[np.float32]:
    """Levenshtein's table for many pairs at once. [first length + 1, second length + 1, pairs]"""
    rows, columns, count = first.shape[1], second.shape[1], len(first)
    table = np.empty((rows + 1, columns + 1, count), np.float32)
    table[:, 0] = DROPPED * np.arange(rows + 1)[:, None]
    table[0] = DROPPED * np.arange(columns + 1)[:, None]
    for row in range(1, rows + 1):
        costs = COSTS[first[:, row - 1, None], second].T
        for column in range(1, columns + 1):
            said_too_much = np.minimum(table[row - 1, column], table[row, column - 1]) + DROPPED
            changed = table[row - 1, column - 1] + costs[column - 1]
            np.minimum(said_too_much, changed, out=table[row, column])
    return table


def padded(
    sequences: Sequence[NDArray[np.int32]],
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """The sequences as one array with zeros behind the short ones, and their lengths."""
    lengths = np.array([len(sequence) for sequence in sequences], np.int32)
    padded = np.zeros((len(sequences), int(lengths.max(initial=0))), np.int32)
    for row, sequence in enumerate(sequences):
        padded[row, : len(sequence)] = sequence
    return padded, lengths
