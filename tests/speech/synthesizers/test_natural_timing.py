"""How long the parts of a sentence last, at any pace."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.speech.synthesizers.natural_timing import timing

SYMBOLS = "əmə, əmə"
STARTS = np.arange(len(SYMBOLS) + 1) * 10.0
VOICE = np.zeros(80)
PAUSED = np.where((np.arange(80) >= 32) & (np.arange(80) < 38), -80.0, 0.0)


@given(st.floats(0.3, 4.0))
def test_the_sound_takes_as_long_as_it_is_asked_to(factor):
    made = timing(SYMBOLS, STARTS, VOICE, factor, [])
    assert len(made.places) == pytest.approx(80 * factor, abs=1)
    assert (np.diff(made.places) >= 0).all()
    assert made.edges[-1] == pytest.approx(80 * factor)


def test_vowels_are_drawn_out_more_than_consonants():
    edges = timing(SYMBOLS, STARTS, VOICE, 2.0, []).edges
    vowel, consonant = edges[10] - edges[0], edges[20] - edges[10]
    assert vowel > 2.0 * 10 > consonant > 10


@pytest.mark.parametrize("frames", [4, 30])
def test_a_silence_becomes_the_pause_that_is_asked_for(frames):
    made = timing(SYMBOLS, STARTS, PAUSED, 1.0, [(4, frames)])
    silence = (made.places > 31.5) & (made.places < 37.5)
    assert silence.sum() == pytest.approx(frames, abs=2)
    assert not made.silent.any()


def test_where_there_is_no_silence_one_is_put_in():
    made = timing(SYMBOLS, STARTS, VOICE, 1.0, [(4, 12)])
    assert made.silent.sum() == 12
    assert len(made.places) == 92


@given(
    st.lists(st.floats(-100, 0), min_size=1, max_size=90),
    st.floats(0.3, 4.0),
    st.lists(st.tuples(st.integers(0, 8), st.integers(0, 60)), max_size=4),
)
def test_any_sentence_has_a_place_for_each_frame(loudness, factor, pauses):
    made = timing(SYMBOLS, STARTS, np.array(loudness), factor, pauses)
    assert len(made.places) == len(made.silent)
    assert ((made.places >= 0) & (made.places <= len(loudness) - 1)).all()
    assert (np.diff(made.edges) >= 0).all()
