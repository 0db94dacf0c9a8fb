from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.speech.recognizers.ctc.likelihood import likelihoods
from hri.speech.recognizers.ctc.phone_graph import compile
from hri.speech.recognizers.ctc.ranking import MOST_REPORTED, ranked
from hri.speech.recognizers.ctc.search import Search
from tests.speech.recognizers.word_graphs import WORDS, Sounds, random_scores, word_graph

TWO_OF_FOUR = {(word, after): word - after for word in range(4) for after in range(4)}
"""Sixteen sentences of two words, with their weights."""


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32), st.integers(8, 12))
def test_the_likeliest_of_more_sentences_than_are_reported_comes_first(seed, frames):
    arcs = [(0, 1 + word, word, float(word)) for word in range(4)]
    arcs += [(1 + word, 5, after, -float(after)) for word, after in TWO_OF_FOUR]
    scores = random_scores(seed, frames)
    search = Search(compile(word_graph(arcs, 6), Sounds()))
    search.begin({"all"})
    search.advance(scores)
    found = ranked(search, scores, Sounds())

    said = [(WORDS[word], WORDS[after]) for word, after in TWO_OF_FOUR]
    totals = likelihoods(scores, said, Sounds()) + np.array(list(TWO_OF_FOUR.values()))
    best = np.argsort(-totals)[:MOST_REPORTED]
    assert [one.path.words for one in found] == [said[number] for number in best]
    assert [one.score for one in found] == pytest.approx(totals[best], abs=1e-3)
