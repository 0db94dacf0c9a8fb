from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from hri.speech.pronunciation.lexicon import Lexicon, load_lexicon, read_phones
from hri.speech.synthesizers.espeak_text import mnemonics, plain, reading


@pytest.fixture
def lexicon(tmp_path) -> Lexicon:
    path = tmp_path / "names.txt"
    path.write_text("sola  S OW1 L AH0\nmeiji  M EY JH IY\n", encoding="utf-8")
    return load_lexicon(path)


def test_names_are_spelt_out_and_the_rest_is_left_alone(lexicon):
    read = reading("Is Sola here?", lexicon)

    assert read.text == "Is  [[s|'oU|l|@]]  here?"
    assert read.has_phonemes
    assert "Is Sola here?"[read.origins[read.text.index("'oU")]] == "S"
    assert "Is Sola here?"[read.origins[read.text.index("here")]] == "h"


def test_the_possessive_of_a_name_is_known(lexicon):
    assert reading("Sola's", lexicon).text.strip() == "[[s|'oU|l|@|z]]"
    assert reading("Sola\N{RIGHT SINGLE QUOTATION MARK}s", lexicon).has_phonemes


def test_brackets_of_the_author_spell_nothing(lexicon):
    assert not reading("[[h@loU]] you", lexicon).has_phonemes
    assert reading("[[h@loU]] Sola", lexicon).text.count("[[") == 1


def test_a_stress_that_is_not_written_falls_on_the_first_strong_vowel():
    assert mnemonics(read_phones("M ER IY N AH")) == "m|3|'i:|n|@"
    assert mnemonics(read_phones("F IH L IH P")) == "f|'I|l|I|p"
    assert mnemonics(read_phones("AE2 L AH0 K S AE1 N D ER0")) == ",a|l|@|k|s|'a|n|d|3"


@given(st.text())
def test_no_text_gives_the_library_orders(text):
    cleaned = plain(text)

    assert len(cleaned) == len(text)
    cleaned.encode()
    assert not any(ord(letter) < 32 for letter in cleaned)


words = st.sampled_from(["sola", "Sola's", "[[", "]]", "(", ".", "\n", "hello", "meiji,", "\x01"])


@given(st.lists(words).map(" ".join))
def test_each_character_read_stands_for_one_that_was_written(text):
    own = {"sola": (read_phones("S OW1 L AH0"),), "meiji": (read_phones("M EY JH IY"),)}
    read = reading(text, Lexicon(own, load_lexicon()._dictionary))

    assert len(read.origins) == len(read.text)
    assert list(read.origins) == sorted(read.origins)
    assert all(origin < len(text) for origin in read.origins)
    assert read.text.count("[[") == read.text.count("]]") or not read.has_phonemes
