from __future__ import annotations

import itertools

import pytest
from hypothesis import given, strategies as st

from hri.speech.pronunciation.phones import IPA, PHONES, distance, in_ipa

phones = st.sampled_from(PHONES)


def test_there_are_the_39_phones_of_the_dictionary():
    assert len(PHONES) == 39
    assert list(PHONES) == sorted(IPA)


@given(phones, phones)
def test_the_distance_of_phones_is_the_same_both_ways_and_zero_only_to_itself(one, other):
    assert distance(one, other) == distance(other, one)
    assert 0.0 <= distance(one, other) <= 1.0
    assert (distance(one, other) == 0.0) == (one == other)


@pytest.mark.parametrize(
    ("near", "far"),
    [
        (("S", "F"), ("S", "M")),
        (("P", "B"), ("P", "R")),
        (("M", "N"), ("M", "K")),
        (("IY", "IH"), ("IY", "AA")),
        (("AA", "AO"), ("AA", "UW")),
        (("ER", "R"), ("ER", "S")),
    ],
)
def test_phones_made_alike_are_nearer(near, far):
    assert distance(*near) < distance(*far)


def test_a_vowel_is_no_consonant():
    assert distance("AA", "K") == 1.0


def test_no_two_phones_sound_the_same():
    assert min(distance(*pair) for pair in itertools.combinations(PHONES, 2)) > 0.01


def test_phones_are_told_in_the_international_alphabet():
    assert in_ipa(("R", "OW", "B", "AA", "T")) == "\N{LATIN SMALL LETTER TURNED R}o\u028ab\u0251t"
