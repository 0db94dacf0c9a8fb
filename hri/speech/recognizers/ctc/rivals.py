"""What else could have been said: the commonest words of English, in any order.

Whether a sentence of a grammar was said cannot be told from how well it fits alone: in noise, and
by a voice that the network is not used to, nothing fits well. But then other words fit as badly.
So the sentence is held against the best that a few hundred common words can make of the same
sound: what was said is better than that or nearly as good, and something that was not said is
far worse, however loud the noise is.
"""

from __future__ import annotations

from importlib.resources import files

import numpy as np

from hri.hal.word_graph import WordGraph
from hri.speech.recognizers.ctc.phone_graph import Floats, Pronouncing, compile
from hri.speech.recognizers.ctc.search import Search

WORD_COST = 3.0
"""Natural log: what each word costs, or many short ones would fit anything."""


class Rivals:
    """Scores of the best common words. A second of sound takes 0.7 ms of one core."""

    def __init__(self, lexicon: Pronouncing) -> None:
        self._search = Search(compile(_any_order(common_words()), lexicon))

    def score(self, scores: Floats) -> float:
        """Score of the best sequence of words for a piece; scores [frames, classes]."""
        self._search.begin()
        self._search.advance(scores)
        return self._search.best()


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
