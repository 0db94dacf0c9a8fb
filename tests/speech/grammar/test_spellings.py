"""Digits and contractions count as the words that they stand for."""

import pytest

from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import parse, refusal
from hri.speech.grammar.tolerance import nearest


@pytest.fixture(scope="module")
def companion():
    return load_grammar("companion")


@pytest.fixture
def grammar(tmp_path):
    def grammar(rules):
        (tmp_path / "own.jsgf").write_text(f"#JSGF V1.0;\ngrammar own;\n{rules}\n")
        return load_grammar(tmp_path / "own.jsgf")

    return grammar


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("go forward 10 meters", "go forward ten meters"),
        ("turn left 45°", "turn left forty five degrees"),
        ("go back 120 centimeters", "go back one hundred twenty centimeters"),
        ("what's the time", "what is the time"),
        ("how's your battery", "how is your battery"),
        ("you're great", "you are great"),
        ("i don't like you", "i don't like you"),
        ("what\N{RIGHT SINGLE QUOTATION MARK}s your name", "what's your name"),
    ],
)
def test_a_typed_text_is_what_it_stands_for(companion, typed, meant):
    found = parse(companion, typed)
    assert found is not None
    assert found == parse(companion, meant)


def test_what_is_written_out_is_what_a_grammar_contracts(grammar):
    own = grammar("public <a> = i'd like tea | what's up;")
    assert parse(own, "I would like tea").text == "i'd like tea"
    assert parse(own, "I had like tea").text == "i'd like tea"
    assert parse(own, "what is up").text == "what's up"


def test_of_two_meanings_the_one_that_fits_counts(grammar):
    own = grammar("public <a> = i would go; public <b> = i had gone;")
    assert parse(own, "i'd go").rule == "a"
    assert parse(own, "i'd gone").rule == "b"


def test_little_words_are_forgiven_beside_digits(companion):
    assert nearest(companion, "um go forward 2 meters").parse.tags == {"distance": 2.0}


def test_a_refused_text_is_followed_as_far_as_it_goes(companion):
    refused = refusal(companion, "go forward 2 parsecs")
    assert (refused.understood, refused.word) == ("go forward two", "parsecs")


@pytest.mark.parametrize(
    "text", ["go forward 1000000 meters", "'s", "1", "i'd i'd i'd i'd i'd i'd"]
)
def test_what_stands_for_nothing_is_refused_as_before(companion, text):
    assert parse(companion, text) is None
    assert nearest(companion, text) is None
