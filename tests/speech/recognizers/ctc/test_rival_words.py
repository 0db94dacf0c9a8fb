"""Common words and its own in any order: what a sentence of the grammar is held against."""

from __future__ import annotations

import numpy as np
import pytest

from hri.hal.word_graph import WordGraph
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.phone_graph import compile
from hri.speech.recognizers.ctc.rival_words import WORD_COST, Rivals, common_words
from hri.speech.recognizers.ctc.search import Search
from hri.speech.recognizers.ctc.word_habits import Habits, heard_otherwise


@pytest.fixture(scope="module")
def lexicon():
    return load_lexicon()


@pytest.fixture(scope="module")
def rivals(lexicon):
    return Rivals(lexicon)


def heard(phones):
    """Scores of sound in which these phones are perfectly clear, with blanks around them."""
    classes = [0, *(index for phone in phones for index in (CLASSES.index(phone), 0))]
    scores = np.full((len(classes), len(CLASSES)), -7.0, np.float32)
    scores[np.arange(len(classes)), classes] = 0.0
    return scores


def test_common_words_cost_their_number_and_nothing_more(rivals, lexicon):
    words = ("turn", "the", "light")
    phones = [phone for word in words for phone in lexicon.pronunciations(word)[0]]

    assert rivals.score(heard(phones), ()) == pytest.approx(-len(words) * WORD_COST)


def test_a_rare_word_of_the_sentence_is_one_of_the_words(rivals, lexicon):
    words = ("stroke", "the", "giraffe")
    scores = heard([phone for word in words for phone in lexicon.pronunciations(word)[0]])

    assert rivals.score(scores, ["feed", "the", "giraffe"]) > rivals.score(scores, ()) + WORD_COST
    assert rivals.score(scores, words) == pytest.approx(-len(words) * WORD_COST)


def test_what_is_no_word_costs_more(rivals):
    assert rivals.score(heard(["ZH", "OY", "ZH", "OY"]), ()) < -4 * WORD_COST


def test_pieces_do_not_depend_on_each_other(rivals):
    scores = heard(["S", "T", "AA", "P"])
    first = rivals.score(scores, ())
    rivals.score(heard(["N", "OW"]), ["giraffe"])

    assert rivals.score(scores, ()) == first


def test_every_common_word_is_in_the_dictionary(lexicon):
    assert len(common_words()) > 400
    assert [word for word in common_words() if word not in lexicon] == []


def test_what_the_network_makes_of_a_word_is_heard_as_the_word(lexicon):
    graph = WordGraph(
        size=2,
        start=0,
        final=1,
        sources=np.array([0], np.int32),
        targets=np.array([1], np.int32),
        labels=np.array([0], np.int32),
        weights=np.zeros(1, np.float32),
        words=("yes",),
        entries={"answer": 0},
    )

    def score(pronouncing):
        search = Search(compile(graph, pronouncing))
        search.advance(heard(["EY", "S"]))
        return search.best()

    assert score(Habits(lexicon)) == pytest.approx(0.0)
    assert score(lexicon) < -5.0


def test_habits_are_other_than_the_dictionary(lexicon):
    for word, ways in heard_otherwise().items():
        known = {tuple(phones) for phones in lexicon.pronunciations(word)}
        assert not known & {tuple(phones) for phones in ways}, word
        assert all(phone in CLASSES for phones in ways for phone in phones), word
