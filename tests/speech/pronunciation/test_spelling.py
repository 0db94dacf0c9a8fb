from __future__ import annotations

import pytest

from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.pronunciation.spelling import meant, near, split, vocabulary


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("forwrd", "forward"),
        ("freind", "friend"),
        ("zorblax", ""),
        ("x", ""),
    ],
)
def test_a_slip_of_the_fingers_is_mended(word, meant):
    assert near(word, load_lexicon()) == meant


@pytest.mark.parametrize(
    ("word", "words"),
    [
        ("kichen", "kitchen"),  # not Kinchen, a name
        ("bathrom", "bathroom"),  # not two words
        ("adn", "and"),
        ("hte", "the"),
        ("dont", "don't"),
        ("tommorow", "tomorrow"),  # two slips
        ("telefone", "telephone"),
        ("turnleft", "turn left"),
        ("turn_on", "turn on"),
        ("muller", "mueller"),  # no common word is like it
        ("zorblax", ""),
        ("a" * 5000, ""),
        ("", ""),
    ],
)
def test_common_words_are_meant_before_names(word, words):
    assert meant(word, load_lexicon()) == words


def test_all_common_words_are_known():
    lexicon = load_lexicon()
    assert len(vocabulary()) > 10_000
    assert all(word in lexicon for word in vocabulary())


@pytest.mark.parametrize(
    ("word", "parts"),
    [
        ("robotarm", "robot arm"),
        ("turn_on", "turn on"),
        ("turn_zorblax", ""),
        ("_", ""),
        ("zorblax", ""),
        ("a" * 5000, ""),
    ],
)
def test_words_written_as_one_are_parted(word, parts):
    assert split(word, load_lexicon()) == parts
