from __future__ import annotations

from hypothesis import given, settings, strategies as st

from hri.speech.recognizers.ctc.confidence import scores_of
from hri.speech.recognizers.ctc.lattice import Walk
from hri.speech.recognizers.ctc.phone_graph import compile
from hri.speech.recognizers.ctc.search import Search
from hri.speech.recognizers.ctc.word_evidence import word_chances
from tests.speech.recognizers.word_graphs import Sounds, spelled, word_graph

SAID = ("G", "OW", "blank", "G", "OW", "blank", "G", "OW")


def chances(heard):
    """Of the three words of the only sentence."""
    search = Search(
        compile(word_graph([(0, 1, 0, 0.0), (1, 2, 0, 0.0), (2, 3, 0, 0.0)], 4), Sounds())
    )
    search.begin({"all"})
    search.advance(scores_of(heard))
    path = Walk(search.trellis).sentences(1, 0.0)[0]
    return word_chances(path, heard, search.graph.phones)


def test_a_word_that_was_not_said_is_unlikely_and_the_words_beside_it_are_not():
    clear = chances(spelled(*SAID))
    assert min(clear) > 0.9

    first, second, third = chances(spelled("G", "OW", "blank", "M", "IY", "blank", "G", "OW"))
    assert second < 0.5 < min(first, third)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.sampled_from(("G", "OW", "M", "blank", "S")), min_size=12, max_size=30))
def test_chances_are_chances_whatever_was_said(phones):
    assert all(0.0 <= chance <= 1.0 for chance in chances(spelled(*phones)))
