from __future__ import annotations

from itertools import groupby, product

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.known_words import known_words, remembered_words
from tests.speech.recognizers.word_graphs import HEARD, SOUNDS, Sounds

PLAIN = ("go", "goal", "no", "a", "add", "gogo")


def in_all_ways(rows, phones):
    """The sum over all sequences of classes that are these phones, pauses before them too."""
    total = 0.0
    for frames in product(HEARD, repeat=len(rows)):
        heard = tuple(CLASSES[one] for one, _ in groupby(frames) if one)
        if heard == phones:
            total += float(np.prod(rows[np.arange(len(rows)), list(frames)]))
    return total


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 5))
def test_each_word_is_the_sum_over_all_ways_to_say_it(seed, frames):
    rows = np.random.default_rng(seed).uniform(0, 1, (frames, len(CLASSES)))
    come = np.concatenate([[1.0], rows[:, 0].cumprod()])
    gone = np.eye(frames + 1)[frames]
    known = known_words(PLAIN, Sounds())
    with np.errstate(divide="ignore"):
        wanted = [np.log(in_all_ways(rows, sound)) for sound in known.sounds]
    assert known.heard(rows, come, gone) - known.priors == pytest.approx(wanted, rel=1e-6)


def test_words_that_nobody_can_say_are_left_out():
    assert known_words(["go", "zorg", "go zorg", "go no"], Sounds()).texts == ("go", "go no")


def test_what_people_taught_is_likelier_than_a_long_list():
    listed = known_words(PLAIN, Sounds())
    taught = remembered_words(
        [("zorg", ("Z", "AO", "R", "G")), ("go", ("G", "AA"))], lambda word: SOUNDS.get(word, ())
    )
    assert min(taught.priors) > max(listed.priors[: len(SOUNDS)])
    assert dict(zip(taught.sounds, taught.texts, strict=True)) == {
        ("Z", "AO", "R", "G"): "zorg",
        ("G", "AA"): "go",
        ("G", "OW"): "go",
    }


def test_no_words_are_heard_as_none():
    nothing = remembered_words([], SOUNDS.__getitem__)
    assert len(nothing.heard(np.ones((3, len(CLASSES))), np.ones(4), np.ones(4))) == 0
