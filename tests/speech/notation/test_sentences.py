"""A text is parted where its sentences end, and nowhere else."""

import pytest
from hypothesis import given, strategies as st

from hri.speech.notation.sentences import sentences


@pytest.mark.parametrize(
    "text",
    [
        "She lives on Elm Dr.| She is kind.",
        "Ask Dr. Smith.| He knows.",
        "The Lakers vs. Celtics game.",
        "It was 5 vs. 6 of them.",
        "On Nov. 24 we met.| It is No. 5.| Yes.",
        "It was in Nov.| We met.",
        "It is done.| 24 came.",
        "Is it?| Yes!| Good... and so on.",
        'He said "Stop."| Then he left.',
        "See p. 5 and pp. 7-9.",
        "We met at 7 p.m. on Elm St. near the park.",
        "We close at 7 p.m.| The door is open.",
        "The U.S. Navy left.| It was Acme Inc.| They know.",
        "J. K. Rowling wrote it.| I did.",
        "Martin Luther King Jr. Day is near.",
        "Use max. 5 kg.| Add sugar, salt, etc. and stir.",
        "We saw the Sun.| Mars is next.",
        "Come on Sat. 5 of May.",
        "One line\n|another line",
        "It costs 3.5 euros.| Visit example.org now.",
    ],
)
def test_sentences_end_where_people_end_them(text):
    parts = [part.strip() for part in text.split("|")]
    whole = text.replace("|", "")
    assert [whole[begin:end] for begin, end in sentences(whole)] == parts


@given(st.text(alphabet="aB. !?\n1", max_size=80))
def test_nothing_but_space_is_lost(text):
    parts = [text[begin:end] for begin, end in sentences(text)]
    assert "".join("".join(parts).split()) == "".join(text.split())
    assert all(part == part.strip() != "" for part in parts)
