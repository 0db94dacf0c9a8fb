"""Words that are written alike and said in several ways are told apart by the words around them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.speech.pronunciation.heteronyms import heteronyms, said
from hri.speech.pronunciation.lexicon import read_phones
from hri.speech.pronunciation.phones import without_stress
from hri.speech.pronunciation.word_classes import (
    BEFORE,
    PARTS_OF_SPEECH,
    _listed,
    class_of,
    votes,
)

SENTENCES = Path(__file__).with_name("heteronyms.tsv")


def likened(phones) -> str:
    """Phones as they tell readings apart: weak vowels and the two of "er" are one."""
    sounds = " ".join(phone.replace("0", "").replace("2", "") for phone in phones)
    for written, alike in ((r"\b(AH|IH) R\b", "ER"), (r"\b(AH|IH)\b", "@"), (r"\bAO", "AA")):
        sounds = re.sub(written, alike, sounds)
    return re.sub(r"@ (?=[LN]\b)", "", sounds)


def sentences() -> list[tuple[str, list[str], int]]:
    """Phones, the words and marks of each sentence, and the place of the word meant."""
    found = []
    for line in SENTENCES.read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            phones, text = line.split("\t")
            words = re.findall(r"\*?\w+(?:'\w+)*\*?|[^\w\s*]", text)
            place = next(n for n, word in enumerate(words) if "*" in word)
            found.append((phones, [word.strip("*") for word in words], place))
    return found


def is_right(expected: str, phones) -> bool:
    if "1" not in expected:
        phones = without_stress(phones)
    return likened(phones) == likened(expected.split())


def test_there_are_enough_sentences():
    told = sentences()
    assert len(told) >= 400
    assert len({words[place].lower() for _, words, place in told}) >= 100


def test_they_are_told_apart_without_a_tagger():
    wrong = [
        f"{' '.join(words)}: {words[place]} {' '.join(said(words, place))}"
        for expected, words, place in sentences()
        if not is_right(expected, said(words, place))
    ]
    assert len(wrong) <= 0.05 * len(sentences()), "\n".join(wrong)


def test_every_reading_is_said_somewhere_and_differs_from_the_others():
    for word, readings in heteronyms().items():
        for reading in readings:
            assert read_phones(" ".join(reading.phones)) == reading.phones, word
            assert sum(phone.endswith("1") for phone in reading.phones) == 1, word
            assert set(reading.parts_of_speech) <= {*PARTS_OF_SPEECH, "rare"}, word


COMMON = "the a I you record lead bass bow Polish used to will - ' . , have did live 7 it"
words = st.sampled_from([*COMMON.split(" "), "\N{RIGHT SINGLE QUOTATION MARK}s"])


@given(st.lists(words | st.text(min_size=1, max_size=5), min_size=1, max_size=12), st.data())
def test_any_words_may_stand_around_any_word(words, data):
    place = data.draw(st.integers(0, len(words) - 1))
    phones = said(words, place)
    known = heteronyms().get(words[place], ()) or heteronyms().get(words[place].lower(), ())
    assert phones in {reading.phones for reading in known} | {()}
    assert bool(phones) == bool(known)
    assert set(votes([word.lower() for word in words], place)) == set(PARTS_OF_SPEECH)


@pytest.mark.parametrize(
    ("word", "name"),
    [("", "end"), (".", "end"), ("the", "article"), ("quickly", "adverb"), ("dogs", "plural")],
)
def test_words_have_classes(word, name):
    assert class_of(word) == name


def test_each_word_has_one_class():
    listed = [word for name, words in _listed().items() if name in BEFORE for word in words]
    assert sorted(listed) == sorted(set(listed))
    assert {name for name in _listed() if not name.startswith("(")} <= {*BEFORE}
