from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.decoder import decoded
from hri.speech.recognizers.ctc.phone_graph import compile
from hri.speech.recognizers.ctc.rival_words import Rivals
from hri.speech.recognizers.ctc.search import Search
from tests.speech.recognizers.word_graphs import spelled, word_graph

NO, GO, ANY, WORDS = 0, 1, 2, ("no", "go", "<any>")
PHRASES = [(0, 3, NO, 0.0), (0, 3, GO, 0.0), (0, 1, NO, 0.0), (1, 3, ANY, 0.0)]
"""The sentences "no", "go" and "no <any>"."""
NO_GO = ("blank", "N", "N", "OW", "OW", "blank", "G", "G", "OW", "OW", "blank")


def hear_no_go(arcs):
    graph = dataclasses.replace(word_graph(arcs, 4), words=WORDS)
    log_probabilities = spelled(*NO_GO)
    blank = CLASSES.index("blank")
    log_probabilities[:, blank] = np.maximum(log_probabilities[:, blank], -3.0)
    lexicon = load_lexicon()
    return decoded(Search(compile(graph, lexicon)), Rivals(lexicon), log_probabilities)


@pytest.mark.parametrize("weight", [-4.0, -10.0])
def test_two_phrases_that_make_a_sentence_are_that_sentence(weight):
    """Though the whole is less likely than one of them among other words."""
    found = hear_no_go([*PHRASES, (0, 2, NO, weight), (2, 3, GO, 0.0)])
    assert found.text == "no go"
    assert [word.text for word in found.words] == ["no", "go"]
    assert found.confidence > 0.9
    assert not found.alternatives


def test_two_phrases_that_make_none_are_both_reported():
    found = hear_no_go(PHRASES)
    assert found.text == "no <any>"
    assert [other.text for other in found.alternatives] == ["go"]
