from __future__ import annotations

import pytest

from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.pronunciation.spelling import near, split


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
