from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.lint.outside_sentences import (
    MOST_SENTENCES,
    outside,
    read_sentences,
    taken_for,
)
from hri.speech.pronunciation.lexicon import load_lexicon

HOUSE = Path(__file__).resolve().parents[4] / "benchmarks" / "speech" / "house.jsgf"


@pytest.fixture(scope="module")
def lexicon():
    return load_lexicon()


@pytest.fixture(scope="module")
def small(tmp_path_factory) -> Grammar:
    path = tmp_path_factory.mktemp("grammars") / "small.jsgf"
    path.write_text(
        "#JSGF V1.0;\ngrammar small;\n"
        "public <go> = [please] go to the (right {side=right} | left {side=left} | kitchen);\n"
        "public <count> = count (one | two)+;\n"
        "public <name> = my name is <name.spoken>;\n",
        encoding="utf-8",
    )
    return load_grammar(path)


def test_a_sentence_is_taken_for_the_nearest_one(lexicon):
    (taken,) = taken_for(load_grammar(HOUSE), ["Bring this juice to Leila!"], lexicon)

    assert taken.said == "bring this juice to leila"
    assert taken.reading.text == "bring this juice to leo"
    assert taken.difference == ("leila", "leo")
    assert taken.sets == {"person": "leo"}
    assert 0.0 < taken.distance < 0.12


def test_what_is_allowed_and_what_is_far_are_not_taken(small, lexicon):
    allowed = ["please go to the right", "", "my name is siobhan", "count one two two one"]
    assert outside(small, [*allowed, "go to the light", "Go to the light."]) == ["go to the light"]
    assert taken_for(small, [*allowed, "who composed this waltz"], lexicon) == []


def test_the_nearest_comes_first(small, lexicon):
    said = ["go to the light", "goat to the kitchen", "count one two do one"]
    found = taken_for(small, said, lexicon, farthest=0.5)

    assert [taken.distance for taken in found] == sorted(taken.distance for taken in found)
    heard = {taken.said: taken.reading.text for taken in found}
    assert heard == {
        "go to the light": "go to the right",
        "goat to the kitchen": "go to the kitchen",
        "count one two do one": "count one two two one",
    }


@given(
    st.lists(
        st.sampled_from(["go", "to", "the", "right", "light", "count", "one", "wine", "two"]),
        min_size=1,
    )
)
def test_no_sentence_of_the_grammar_is_nearer(small, lexicon, words):
    """Against all sentences of up to three rounds, compared one by one."""
    text = " ".join(words[:6])
    inside = [text for text in small.sentences(60) if "<" not in text]
    alone = {one: _cost(text, one, lexicon) for one in inside}

    for taken in taken_for(small, [text], lexicon, farthest=2.0):
        assert taken.distance <= min(alone.values()) + 1e-3
        assert taken.distance == pytest.approx(_cost(text, taken.reading.text, lexicon), abs=1e-3)


def _cost(said: str, heard: str, lexicon) -> float:
    """Levenshtein's distance of two sentences, over the phones of the first."""
    from hri.speech.pronunciation.phones import DROPPED, distance

    one, other = (
        [phone for word in text.split() for phone in lexicon.pronunciations(word)[0]]
        for text in (said, heard)
    )
    row = [DROPPED * place for place in range(len(other) + 1)]
    for phone in one:
        before, row = row, [row[0] + DROPPED]
        for place, against in enumerate(other):
            dropped = min(before[place + 1], row[place]) + DROPPED
            row.append(min(before[place] + distance(phone, against), dropped))
    return row[-1] / len(one)


def test_a_file_has_a_sentence_a_line(tmp_path):
    path = tmp_path / "outside.txt"
    path.write_text("# what else they say\n\ngo away\n  sing it \n", encoding="utf-8")
    assert read_sentences(path) == ["go away", "  sing it "]

    path.write_text("sing\n" * (MOST_SENTENCES + 1), encoding="utf-8")
    with pytest.raises(AuthoringError, match=r"outside\.txt:1001:1: more than 1000 sentences - "):
        read_sentences(path)
