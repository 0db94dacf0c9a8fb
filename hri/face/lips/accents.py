"""Which words of a speech are accented: brows and head move with those, not with every word.

Voices stress a syllable of nearly every word. What a phrase is about is the longest and loudest of
them, most often its last (the nuclear accent); a long phrase has more than one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from hri.face.lips.loudness import Loudness
from hri.face.lips.spans import VisemeSpan, is_pause

Values = NDArray[np.float64]

SPACING = 1.2
"""Seconds between two accents of a phrase at least."""
LONGEST = 0.3
"""Seconds; a vowel that is longer, such as at the end of a sentence, is no more accented."""
FINAL = 1.25
"""How much stronger the last stressed vowel of a phrase counts."""
RISE, FALL = 0.12, 0.3
"""Seconds in which brows go up before the middle of an accented vowel, and come down after it."""
FULL = 0.14
"""Seconds; an accented vowel as long as this lifts the brows fully."""


class Accents:
    """The accents over a speech."""

    def __init__(self, segments: Sequence[VisemeSpan], loudness: Loudness | None) -> None:
        """Of shapes in order; without loudness the longest vowels are accented."""
        chosen = list(_accented(segments, loudness))
        self._middles = np.array([_middle(vowel) for vowel in chosen])
        self._strengths = np.array([min(vowel.duration / FULL, 1.0) for vowel in chosen])

    def at(self, position: float) -> float:
        """How accented the voice is at a position, seconds; 0 to 1, smooth."""
        if not len(self._middles):
            return 0.0
        away = position - self._middles
        share = np.clip(1 - np.maximum(-away / RISE, away / FALL), 0, 1)
        return float((self._strengths * share * share * (3 - 2 * share)).max())


def _accented(segments: Sequence[VisemeSpan], loudness: Loudness | None) -> Iterator[VisemeSpan]:
    """The strongest vowels of each phrase, none too near to a stronger one of it."""
    for _, phrase in groupby(segments, key=is_pause):
        kept: list[VisemeSpan] = []
        stressed = [segment for segment in phrase if segment.stressed]
        strengths = [_strength(vowel, loudness) for vowel in stressed]
        strengths[-1:] = [FINAL * strength for strength in strengths[-1:]]
        for number in np.argsort(-np.array(strengths), kind="stable"):
            vowel = stressed[number]
            if all(abs(_middle(vowel) - _middle(other)) >= SPACING for other in kept):
                kept.append(vowel)
        yield from kept


def _strength(vowel: VisemeSpan, loudness: Loudness | None) -> float:
    louder = 1.0 if loudness is None else float(loudness.at(np.array([_middle(vowel)]))[0])
    return min(vowel.duration, LONGEST) * louder


def _middle(vowel: VisemeSpan) -> float:
    return (vowel.start + vowel.end) / 2
