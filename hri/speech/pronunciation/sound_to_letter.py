"""How a word that nobody listed is spelled, from its sounds: a voice reads the other way round.

An n-gram over chunks of letters and phones (M. Bisani and H. Ney, "Joint-sequence models for
grapheme-to-phoneme conversion", Speech Communication 50, 2008), learned from the CMU dictionary and
a list of first names by `benchmarks/research/sound_to_letter`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

MODEL = Path(__file__).with_name("sound_to_letter.npz")
ORDER = 4
"""Chunks that are looked at together."""
SCALE = 16.0
"""Steps of the stored numbers in a natural log of 1."""
LONGEST = 2
"""Phones of a chunk."""
MOST_KEPT = 8
"""Spellings of the same sounds that are followed."""
MOST_CHUNKS = 10
"""Ways to write the same phones that are tried, the most frequent ones."""
_UNSEEN = -16.0
_EDGE = 0
"""The chunk before the first one and behind the last one."""


class _Model(NamedTuple):
    letters: Sequence[str]
    """Of each chunk."""
    numbers: Mapping[tuple[str, ...], Sequence[int]]
    """The chunks of some phones."""
    chances: Mapping[tuple[int, ...], float]
    left: Mapping[tuple[int, ...], float]


def spellings(phones: Sequence[str], most: int = 1) -> list[str]:
    """How people would write a word, lower case letters, the likeliest first.

    `phones` are those of the CMU dictionary, without stress. Empty for no phones, else there is
    one at least.
    """
    if not phones:
        return []
    model = _model()
    followed: list[dict[tuple[str, tuple[int, ...]], float]] = [{} for _ in range(len(phones) + 1)]
    followed[0]["", (_EDGE,)] = 0.0
    for place in range(len(phones)):
        kept = sorted(followed[place].items(), key=lambda item: -item[1])[:MOST_KEPT]
        for (text, before), score in kept:
            for size in range(1, LONGEST + 1):
                if place + size > len(phones):
                    break
                there = followed[place + size]
                for chunk in model.numbers.get(tuple(phones[place : place + size]), ()):
                    total = score + _chance(model, (*before, chunk))
                    key = text + model.letters[chunk], (*before, chunk)[1 - ORDER :]
                    if total > there.get(key, -np.inf):
                        there[key] = total
    found: dict[str, float] = defaultdict(lambda: -np.inf)
    for (text, before), score in followed[-1].items():
        found[text] = max(found[text], score + _chance(model, (*before, _EDGE)))
    return sorted(found, key=lambda text: (-found[text], text))[:most]


def load() -> None:
    """Read what it needs, which takes a quarter of a second, before it is needed."""
    _model()
    phone_chances()


@cache
def phone_chances() -> NDArray[np.float32]:
    """[40, 40, 40] Natural log of a phone of a name after two others, in the order of
    PHONES from 1 on; 0 is the beginning and the end.
    """
    with np.load(MODEL) as stored:
        return np.asarray(stored["phones"] / -np.float32(SCALE), np.float32)


def _chance(model: _Model, gram: tuple[int, ...]) -> float:
    """Natural log of the last chunk behind the others."""
    gram, lost = gram[-ORDER:], 0.0
    while len(gram) > 1:
        if (chance := model.chances.get(gram)) is not None:
            return lost + chance
        lost += model.left.get(gram[:-1], 0.0)
        gram = gram[1:]
    return lost + model.chances.get(gram, _UNSEEN)


@cache
def _model() -> _Model:
    with np.load(MODEL) as stored:
        scores = (stored["scores"] / -SCALE).tolist()
        rows = zip(stored["grams"].tolist(), stored["sizes"].tolist(), strict=True)
        grams = [tuple(row[:size]) for row, size in rows]
        chunks = [chunk.split() for chunk in stored["chunks"].tolist()]
    chances = {gram: chance for gram, (chance, _) in zip(grams, scores, strict=True)}
    numbers: dict[tuple[str, ...], list[int]] = defaultdict(list)
    for number, (_, *phones) in enumerate(chunks, start=1):
        numbers[tuple(phones)].append(number)
    for ways in numbers.values():
        ways.sort(key=lambda number: -chances.get((number,), _UNSEEN))
        del ways[MOST_CHUNKS:]
    return _Model(
        ("", *(letters for letters, *_ in chunks)),
        numbers,
        chances,
        {gram: left for gram, (_, left) in zip(grams, scores, strict=True) if left},
    )
