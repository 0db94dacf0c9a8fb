"""What else could have been said: the commonest words of English and the sentence's own.

The fit of a sentence alone does not show whether it was said: in noise, and
by a voice that the network is not used to, nothing fits well. But then other words fit as badly.
So the sentence is held against the best that a few hundred common words, and its own, can make of
the same sound in any order: what was said is better than that or nearly as good, and something that
was not said is far worse, however loud the noise is. Without its own words among them, the rare
word that it shares with what was really said would speak for all of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from importlib.resources import files

import numpy as np

from hri.hal.word_graph import WordGraph
from hri.speech.recognizers.ctc.phone_graph import Floats, Pronouncing, compile
from hri.speech.recognizers.ctc.search import Search

WORD_COST = 3.0
"""Natural log: what each word costs, or many short ones would fit anything."""


class Rivals:
    """Scores of the best words in any order: 1.5 ms of one core, and 0.7 ms for each second."""

    def __init__(self, lexicon: Pronouncing) -> None:
        self._lexicon = lexicon
        self._common = {word: lexicon.pronunciations(word) for word in common_words()}

    def score(self, scores: Floats, sentence: Iterable[str]) -> float:
        """Score of the best sequence of common words and of words of the sentence.

        For a piece of speech, scores [frames, classes]. Raises HriError for a word that nobody can
        pronounce.
        """
        words = tuple(dict.fromkeys((*self._common, *sentence)))
        search = Search(compile(_any_order(words), self))
        search.advance(scores)
        return search.best()

    def pronunciations(self, word: str) -> Sequence[Sequence[str]]:
        """Those of the lexicon, which takes some time, those of common words at once."""
        known = self._common.get(word)
        return self._lexicon.pronunciations(word) if known is None else known


def common_words() -> tuple[str, ...]:
    """The words of `common_words.txt`, none of them twice."""
    text = files(__package__).joinpath("common_words.txt").read_text(encoding="utf-8")
    return tuple(dict.fromkeys(text.split()))


def _any_order(words: tuple[str, ...]) -> WordGraph:
    """A loop: 0, before a word, to 1, after it, and silently back."""
    count = len(words)
    return WordGraph(
        size=3,
        start=0,
        final=2,
        sources=np.array([0] * count + [1, 1], np.int32),
        targets=np.array([1] * count + [0, 2], np.int32),
        labels=np.array([*range(count), -1, -1], np.int32),
        weights=np.array([-WORD_COST] * count + [0.0, 0.0], np.float32),
        words=words,
        entries={"any": 0},
    )
