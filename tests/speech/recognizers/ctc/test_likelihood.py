from __future__ import annotations

from itertools import groupby, product

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.likelihood import NEVER, likelihoods

SOUNDS = {"see": [("S", "IY")], "as": [("AE", "Z"), ("Z",)], "odd": [("AA", "AA", "D")]}
HEARD = ("blank", "S", "IY", "AE", "Z", "AA", "D")


class Lexicon:
    def pronunciations(self, word):
        return SOUNDS[word]


def sum_over_all_ways(scores, sentence):
    """Every sequence of classes whose phones are the sentence's."""
    wanted = [sum(way, ()) for way in product(*(SOUNDS[word] for word in sentence))]
    total = 0.0
    for frames in product(HEARD, repeat=len(scores)):
        phones = tuple(phone for phone, _ in groupby(frames) if phone != "blank")
        score = sum(row[CLASSES.index(c)] for row, c in zip(scores, frames, strict=True))
        total += wanted.count(phones) * np.exp(score)
    return np.log(total) if total else NEVER


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 4))
def test_it_is_the_sum_over_all_ways_to_say_a_sentence(seed, frames):
    scores = np.random.default_rng(seed).normal(-2, 2, (frames, len(CLASSES))).astype(np.float32)
    sentences = [("see",), ("as", "see"), ("odd",)]
    found = likelihoods(scores, sentences, Lexicon())
    assert found == pytest.approx([sum_over_all_ways(scores, one) for one in sentences], abs=1e-3)


def test_a_sentence_that_is_too_long_for_the_sound_cannot_be():
    scores = np.zeros((2, len(CLASSES)), np.float32)
    assert likelihoods(scores, [("odd",)], Lexicon())[0] == NEVER


def test_a_long_sound_neither_overflows_nor_vanishes():
    scores = np.full((1000, len(CLASSES)), -7.0, np.float32)
    scores[:, 0] = -0.1
    (found,) = likelihoods(scores, [("see", "as", "odd")], Lexicon())
    assert -200.0 < found < -100.0
