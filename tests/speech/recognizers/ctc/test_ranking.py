from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.confidence import scores_of
from hri.speech.recognizers.ctc.likelihood import likelihoods
from hri.speech.recognizers.ctc.phone_graph import compile
from hri.speech.recognizers.ctc.ranking import MOST_REPORTED, ranked
from hri.speech.recognizers.ctc.search import Search
from tests.speech.recognizers.word_graphs import WORDS, Sounds, random_scores, spelled, word_graph

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


@pytest.mark.parametrize(("weight", "said"), [(8.0, ("go",)), (4.0, ("<any>", "go"))])
def test_a_breath_before_a_sentence_is_not_a_word(weight, said):
    """The whole sentence counts where it is hardly worse than the one with free words."""
    graph = dataclasses.replace(
        word_graph([(0, 1, -1, 0.0), (0, 2, 1, 0.0), (1, 3, 0, weight), (2, 3, 0, 0.0)], 4),
        words=("go", "<any>", *WORDS[2:]),
    )
    search = Search(compile(graph, Sounds()))
    heard = spelled(*["AH"] * 6, "blank", "G", "OW")
    heard[:, CLASSES.index("blank")] = np.maximum(heard[:, CLASSES.index("blank")], -0.1)
    scores = scores_of(heard)
    search.advance(scores)
    found = ranked(search, scores, Sounds())
    assert found[0].path.words == said


@pytest.mark.parametrize(
    ("weight", "said"), [(0.0, ("a", "<x.spoken>", "go")), (-9.0, ("a", "<x.spoken>"))]
)
def test_listed_words_behind_a_free_slot_are_none_of_it(weight, said):
    """Where they fit as well as more of the slot does."""
    graph = dataclasses.replace(
        word_graph([(0, 1, 3, 0.0), (1, 3, 1, 0.0), (1, 2, 1, 0.0), (2, 3, 0, weight)], 4),
        words=("go", "<x.spoken>", *WORDS[2:]),
    )
    search = Search(compile(graph, Sounds()))
    heard = spelled("AH", "blank", *["L", "blank"] * 2, "G", "OW")
    scores = scores_of(heard)
    search.advance(scores)
    found = ranked(search, scores, Sounds())
    assert found[0].path.words == said
    assert ("a", "<x.spoken>") not in [one.path.words for one in found[1:]]
