"""Numbers, signs and abbreviations are read as an American says them."""

# ruff: noqa: RUF001 - signs of texts are meant.
import re
import time
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.speech.notation.reading import read_aloud, spoken
from hri.speech.notation.sentences import sentences

READINGS = Path(__file__).parent / "readings.txt"


def table():
    """For each kind the texts, and what is said for each."""
    kinds = {}
    for line in READINGS.read_text(encoding="utf-8").splitlines():
        if line.startswith("== "):
            kind = kinds.setdefault(line[3:], {})
        elif " | " in line:
            written, _, read = line.partition(" | ")
            kind[written] = read
    return kinds


def words(text):
    return re.sub(r"[^\w']+", " ", text).lower().strip(" '").split()


@pytest.mark.parametrize("kind", table())
def test_it_is_read_as_an_american_says_it(kind):
    texts = table()[kind]
    assert {text: words(read_aloud(text)) for text in texts} == {
        text: words(read) for text, read in texts.items()
    }


def test_the_table_has_many_lines_of_every_kind():
    kinds = table()
    assert len(kinds) >= 28
    assert sum(map(len, kinds.values())) >= 1000


@pytest.mark.parametrize(
    "text",
    [
        "Hello there.",
        "My mother may know where all the yellow lemons are, in the morning.",
        "Well-known facts (and others) don't change; do they?",
        '"Yes," she said... "I will!"',
        "Zoë and José are here - at last.",
        "A cat sat in May.",
    ],
)
def test_plain_words_stay_as_they_are(text):
    assert read_aloud(text) == text


@given(st.text(max_size=300))
def test_every_character_that_is_said_stands_for_a_written_one(text):
    said = spoken(text)
    assert len(said.text) == len(said.origins)
    assert list(said.origins) == sorted(said.origins)
    assert all(0 <= origin < len(text) for origin in said.origins)
    assert len(said.text) <= 60 * len(text) + 60


PIECES = st.sampled_from(
    [
        *(
            "$",
            "€",
            "-",
            "–",
            ".",
            ",",
            ":",
            "/",
            "'",
            '"',
            "#",
            "%",
            "°",
            "²",
            "⁻",
            "½",
            "①",
            "⁸",
            "@",
            "&",
            "*",
        ),
        *("x", "X", "=", "+", "(", ")", "0", "1", "12", "911", "1984", "10,000", "3.5", "km", "mL"),
        *("Dr.", "St.", "vs.", "Jan.", "Mon", "pm", "a.m.", "IV", "CO2", "v1.2", "www.", "http://"),
        *("a@b.c", "😀", " ", "\n", "Ω", "192.168.1.1", "5'11", "e.g.", "7:30", "s", "th"),
    ]
)


@given(st.lists(PIECES, max_size=30).map("".join))
def test_no_mix_of_signs_ends_it(text):
    said = spoken(text)
    assert not any(character.isdecimal() for character in said.text)
    assert list(said.origins) == sorted(said.origins)


SIGNS = [
    *("a.", "1/", "a@", "www.", "-", "+1 ", "0", "(555) ", "#", "$", "$1-", "1:", "1,", "1.", "a/"),
    *("A-1", "IV ", "x", '"', "'", "/", "~/", "1 1/2 ", "A.", "H2", "😀", "é", "1e", "٣", "=="),
    *("Mon-", "Jan. ", "5'", "http://", "a_", "v1.", "²", "Dr. ", "!", ". ", "\n", "call 1 ", "1-"),
]


@pytest.mark.parametrize("sign", SIGNS)
def test_long_texts_of_one_sign_take_little_time(sign):
    assert seconds_for(sign, 3_000) < 2


@pytest.mark.slow
@pytest.mark.parametrize("sign", ["1/", "0", "!", ". "])
def test_very_long_texts_take_no_more_for_each_character(sign):
    assert seconds_for(sign, 100_000) < 36


def seconds_for(sign, length):
    """What a text of one sign takes of a core."""
    text = (sign * length)[:length]
    begun = time.process_time()
    spoken(text)
    list(sentences(text))
    return time.process_time() - begun
