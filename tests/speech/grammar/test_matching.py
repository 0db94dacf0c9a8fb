from __future__ import annotations

import random
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hri.speech.grammar import load_grammar, read_grammar
from hri.speech.grammar.expansion import random_sentence
from hri.speech.grammar.matching import parse


@pytest.mark.parametrize(
    ("sentence", "rule", "tags"),
    [
        ("go forward ten meters", "move", {"distance": 10.0}),
        ("Go forward, ten meters!", "move", {"distance": 10.0}),
        ("go forward", "move", {"distance": 0.5}),
        ("back up a bit", "move", {"distance": -0.3}),
        ("go back twenty five centimeters", "move", {"distance": -0.25}),
        ("please drive ahead two and a half meters", "move", {"distance": 2.5}),
        ("move ahead one hundred and five feet", "move", {"distance": 32.004}),
        ("turn left ninety degrees", "turn", {"angle": 90.0}),
        ("turn right", "turn", {"angle": -90.0}),
        ("turn right a hundred and eighty degrees", "turn", {"angle": -180.0}),
        ("turn around", "turn", {"angle": 180.0}),
        ("show me a scared face", "show", {"emotion": "afraid"}),
        ("why are you so sad", "why", {"emotion": "sad"}),
        ("stop", "stop", {}),
    ],
)
def test_the_companion_understands(companion, sentence, rule, tags):
    found = parse(companion, sentence)

    assert (found.rule, found.tags) == (rule, tags)


@pytest.mark.parametrize(
    "sentence", ["", "...", "go", "forward ten meters", "go forward ten", "stop talking to me"]
)
def test_what_is_outside_means_nothing(companion, sentence):
    assert parse(companion, sentence) is None


@given(st.integers(0, 10**9))
@settings(max_examples=200, deadline=None)
def test_every_sentence_of_a_grammar_parses_back(companion, seed):
    sentence = random_sentence(companion, random.Random(seed))

    found = parse(companion, sentence)

    assert found is not None
    assert found.text == sentence


def test_listed_sentences_differ_and_parse_back(companion):
    sentences = list(companion.sentences(500))

    assert len(set(sentences)) == 500
    assert all(parse(companion, sentence) is not None for sentence in sentences)
    assert {parse(companion, sentence).rule for sentence in sentences} == set(
        companion.public_rules
    )


@pytest.mark.parametrize(
    ("rules", "said", "unsaid"),
    [
        ("public <a> = x*;", ["x", "x x x"], ["y", "x y"]),
        ("public <a> = x+ y;", ["x y", "x x y"], ["y", "x"]),
        ("public <a> = [x] x;", ["x", "x x"], ["x x x"]),
        ("public <a> = (x | x y) y;", ["x y", "x y y"], ["x"]),
        ("public <a> = x <a> | y;", ["y", "x x x y"], ["x", "y y"]),
        ("public <a> = ([x] [y])+ z;", ["z", "x z", "y x y z"], ["x"]),
        ("public <a> = x | <VOID> y;", ["x"], ["y"]),
    ],
)
def test_structure_is_kept(write, rules, said, unsaid):
    grammar = load_grammar(write(rules))

    assert all(parse(grammar, text) is not None for text in said)
    assert all(parse(grammar, text) is None for text in unsaid)


def test_what_explodes_elsewhere_takes_no_time_here(write):
    grammar = load_grammar(write("public <a> = ((x*)* | (x | x x)+)* y;"))

    start = time.perf_counter()
    assert parse(grammar, "x " * 150) is None
    assert time.perf_counter() - start < 2.0


def test_left_recursion_does_not_hang_the_matcher(write):
    grammar, _ = read_grammar(write("public <a> = <a> x | y;"))

    assert parse(grammar, "y").rule == "a"


def test_right_recursion_of_two_hundred_words(write):
    grammar = load_grammar(write("public <a> = x <a> | y {end};"))

    assert parse(grammar, "x " * 199 + "y").tags == {"end": True}
    assert parse(grammar, "x " * 200 + "y") is None


def test_the_first_written_reading_wins(write):
    grammar = load_grammar(write("public <a> = hi {n=1} | hi {n=2};\npublic <b> = hi;"))

    assert (parse(grammar, "hi").rule, parse(grammar, "hi").tags) == ("a", {"n": 1.0})


def test_the_vocabulary_is_told(companion):
    assert {"distance", "angle", "emotion"} == companion.tag_names()
    assert {"forward", "ninety"} <= companion.words()
    assert list(companion.sentences_of("turn", 2)) == ["turn left", "turn left a little"]


def test_the_flat_form_has_one_public_rule_and_no_tags(companion):
    flat = companion.flat_jsgf()

    assert flat.count("public") == 1
    assert not set('{}"') & set(flat)
    assert "import" not in flat
