"""The likeliest phones of a sound of which no word is known, as they follow each other in names.

Prefix beam search (A. Hannun et al., "First-pass large vocabulary continuous speech recognition
using bi-directional recurrent DNNs", 2014): the sum of all ways to hear each sequence of phones.
"""

from __future__ import annotations

import heapq
import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hri.speech.pronunciation.phones import PHONES, Phones
from hri.speech.pronunciation.sound_to_letter import phone_chances
from hri.speech.recognizers.ctc.classes import BLANK

Doubles = NDArray[np.float64]

PHONE_WEIGHT = 0.4
"""How much it counts against the sound how likely phones follow each other.

This, UNLISTED and NEXT_WORD of `spoken_words` are fitted to 120 names, half of them of no list, by
four voices; none of them is in `benchmarks/speech/names.txt`.
"""
MOST_FOLLOWED = 24
"""Beginnings that are followed from frame to frame."""
CLEAR = 0.02
"""Probability in a frame from which a phone may begin there."""
SHORTEST = 2
"""Phones of a word."""


class FreePhones(NamedTuple):
    """Phones and how likely they are, natural log."""

    score: float
    phones: Phones


class _Begun(NamedTuple):
    """Phones, as classes of the network, after some frames."""

    rank: float
    """How likely they follow each other, weighted."""
    phone: float
    """How likely they have been said and the last one still sounds, and that it does not."""
    blank: float


def free_phones(rows: Doubles, come: Doubles, gone: Doubles, most: int) -> list[FreePhones]:
    """The likeliest phones between other words, as `KnownWords.heard` takes them; best first."""
    chances = _weighed()
    begun: dict[tuple[int, ...], _Begun] = {}
    found: dict[tuple[int, ...], float] = defaultdict(float)
    for frame, row in enumerate(rows):
        heard = row.tolist()
        begun = _onward(begun, heard, float(come[frame]), chances)
        if gone[frame + 1] > 0.0:
            for classes, now in begun.items():
                found[classes] += (now.phone + now.blank) * float(gone[frame + 1])
    ranked = [
        FreePhones(math.log(chance * _rank(classes)), tuple(PHONES[one - 1] for one in classes))
        for classes, chance in found.items()
        if chance > 0.0 and len(classes) >= SHORTEST
    ]
    return sorted(ranked, reverse=True)[:most]


def _onward(
    begun: Mapping[tuple[int, ...], _Begun],
    heard: Sequence[float],
    come: float,
    chances: Sequence[Sequence[Sequence[float]]],
) -> dict[tuple[int, ...], _Begun]:
    """The likeliest beginnings after a frame more, of which `heard` are the probabilities."""
    still = heard[BLANK]
    likely = [one for one, chance in enumerate(heard) if chance > CLEAR and one != BLANK]
    coming: dict[tuple[int, ...], list[float]] = {}
    for one in likely:
        coming[one,] = [chances[0][0][one], come * heard[one], 0.0]
    for classes, (rank, phone, blank) in begun.items():
        last, whole = classes[-1], phone + blank
        same = coming.setdefault(classes, [rank, 0.0, 0.0])
        same[1] += phone * heard[last]
        same[2] += whole * still
        follow = chances[classes[-2] if len(classes) > 1 else 0][last]
        for one in likely:
            longer = coming.setdefault((*classes, one), [rank * follow[one], 0.0, 0.0])
            longer[1] += (blank if one == last else whole) * heard[one]
    best = heapq.nlargest(
        MOST_FOLLOWED, coming.items(), key=lambda item: (item[1][1] + item[1][2]) * item[1][0]
    )
    return {classes: _Begun(*now) for classes, now in best}


def _rank(classes: tuple[int, ...]) -> float:
    """How likely phones follow each other in a name, to its end; weighted."""
    chances, rank, one, two = _weighed(), 1.0, 0, 0
    for three in (*classes, 0):
        rank *= chances[one][two][three]
        one, two = two, three
    return rank


@cache
def _weighed() -> Sequence[Sequence[Sequence[float]]]:
    """How likely a phone follows two others, to the power of its weight."""
    weighed: list[list[list[float]]] = np.exp(PHONE_WEIGHT * phone_chances()).tolist()
    return weighed
