from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from hri.speech.pronunciation.scripts import in_latin


@pytest.mark.parametrize(
    ("written", "latin"),
    [
        ("Анна", "Anna"),
        ("Дмитрий", "Dmitry"),
        ("Мария", "Maria"),
        ("Юлия", "Yulia"),
        ("Сергей", "Sergey"),
        ("Χρήστος", "Christos"),
        ("Γιώργος", "Giorgos"),
        ("さくら", "Sakura"),
        ("しょうた", "Shouta"),
        ("きょうこ", "Kyouko"),
        ("はっとり", "Hattori"),
        ("ケンジー", "Kenji"),
        ("김", "Gim"),
        ("민수", "Minsu"),
        ("山田", "山田"),
        ("っ ー ь", "っ ー ь"),  # signs that have no sound alone
        ("José", "José"),
        ("Hi, Анна's (Иван)!", "Hi, Anna's (Ivan)!"),
    ],
)
def test_names_are_spelled_in_latin_letters(written, latin):
    assert in_latin(written) == latin


letters = st.sampled_from("аьйёΓγάっゃーがン김山é\u0301\u0308 a-")


@given(st.text(letters | st.characters(), max_size=20))
def test_any_text_keeps_its_words(text):
    assert len(in_latin(text).split()) == len(text.split())


@given(st.text(st.characters(max_codepoint=0x24F), max_size=20))
def test_latin_texts_stay(text):
    assert in_latin(text) == text
