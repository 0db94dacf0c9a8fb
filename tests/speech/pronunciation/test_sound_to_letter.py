from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.speech.pronunciation.letter_to_sound import guesses
from hri.speech.pronunciation.phones import PHONES, VOWELS, distance
from hri.speech.pronunciation.sound_to_letter import phone_chances, spellings

WORDS = st.lists(st.sampled_from(PHONES), max_size=15)


@pytest.mark.parametrize(
    ("phones", "spelling"),
    [
        ("Z AO R V IH N", "zorvin"),
        ("AE N AH", "anna"),
        ("M IH R OW L IH N", "mirolin"),
        ("Y AO R V IH K", "yorvik"),
    ],
)
def test_a_word_is_spelled_as_people_would(phones, spelling):
    assert spelling in spellings(phones.split(), 3)


@given(WORDS)
def test_any_sounds_have_spellings_and_they_are_letters(phones):
    found = spellings(phones, 4)
    assert bool(found) == bool(phones)
    assert len(set(found)) == len(found) <= 4
    assert all(text.isalpha() and text.isascii() and text.islower() for text in found)
    assert spellings(phones, 1) == found[:1]


@pytest.mark.parametrize("phones", ["T EH R IY N AH", "B OW D AH V AE N", "S K AA L D IY"])
def test_a_voice_that_reads_the_letters_says_nearly_the_sounds(phones):
    said = phones.split()
    read = [list(guess) for text in spellings(said, 3) for guess in guesses(text)]
    alike = [one for one in read if len(one) == len(said)]
    assert min(sum(map(distance, said, one)) for one in alike) <= 1.0


def test_phones_follow_each_other_as_in_names():
    chances = phone_chances()
    assert chances.shape == (len(PHONES) + 1,) * 3
    assert np.exp(chances).sum(axis=2) == pytest.approx(1.0, abs=0.05)
    number = {phone: place for place, phone in enumerate(PHONES, start=1)}
    begun = chances[0, 0]
    assert begun[number["M"]] > begun[number["NG"]]
    after_s_t = chances[number["S"], number["T"]]
    assert max(after_s_t[number[one]] for one in VOWELS) > after_s_t[number["ZH"]]
