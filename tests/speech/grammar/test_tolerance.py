from __future__ import annotations

import gc
import random
import time

import pytest
from hypothesis import assume, given, settings, strategies as st

from hri.speech.grammar import load_grammar
from hri.speech.grammar.expansion import random_sentence
from hri.speech.grammar.matching import parse
from hri.speech.grammar.tolerance import HESITATIONS, LITTLE_WORDS, MOST_COST, nearest
from hri.speech.grammar.words import ANY

RULES = """
public <go> = go (forward | back) [<count> meters] | take me to the (kitchen | garden);
public <stop> = stop [now];
public <answer> = yes please | not now;
<count> = one {n=1} | two {n=2} | twenty {n=20} | twenty two {n=22};
"""


@pytest.fixture
def robot(write):
    return load_grammar(write(RULES))


@pytest.mark.parametrize(
    ("text", "sentence", "edits", "cost"),
    [
        ("go forward", "go forward", "", 0.0),
        ("um go forward please", "go forward", "+um +please", 0.4),
        ("go go forward", "go forward", "+go", 0.5),
        ("go uh go forward", "go forward", "+uh +go", 0.6),
        ("take me to kitchen", "take me to the kitchen", "-the", 0.4),
        ("take me the garden", "take me to the garden", "-to", 0.6),
        ("well take me to garden", "take me to the garden", "+well -the", 0.8),
        ("Hey, stop now now!", "stop now", "+hey +now", 0.8),
        ("go forward twenty and two meters", "go forward twenty two meters", "+and", 0.6),
        ("yes", "yes please", "-please", 0.5),
    ],
)
def test_little_words_come_and_go_at_a_cost(robot, text, sentence, edits, cost):
    found = nearest(robot, text)

    assert found.parse.text == sentence
    assert " ".join(map(str, found.edits)) == edits
    assert found.cost == pytest.approx(cost)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "um",
        "please",
        "the the the",
        "now",
        "not",
        "forward",
        "go",
        "go forward meters",
        "go forward home",
        "take me to",
        "um uh well hey so okay now then go forward",
    ],
)
def test_words_that_carry_meaning_are_never_forgiven(robot, text):
    assert nearest(robot, text) is None


def test_a_hesitation_is_never_put_in(write):
    assert nearest(load_grammar(write("public <yes> = [robot] mm hmm;")), "robot") is None


def test_a_little_word_that_stands_elsewhere_is_not_forgiven(write):
    grammar = load_grammar(write("public <yes> = that is right;"))

    assert nearest(grammar, "is right").parse.text == "that is right"
    assert nearest(grammar, "is that right") is None


def test_a_free_slot_is_filled_by_what_was_said_alone(write):
    grammar = load_grammar(write("public <remind> = remind me to <deed.spoken 1-6>;"))
    assert nearest(grammar, "remind me") is None


def test_the_cheapest_edits_win(write):
    grammar = load_grammar(write("public <a> = show the face;\npublic <b> = show some face;"))

    assert nearest(grammar, "show face").parse.rule == "a"


def test_only_the_rules_that_are_asked_for_count(robot):
    assert nearest(robot, "um stop", rules={"stop"}).parse.rule == "stop"
    assert nearest(robot, "um stop", rules={"go"}) is None


def test_no_answer_no_number_and_no_direction_is_a_little_word(robot):
    telling = "yes no not never one two ten left right forward back up down stop go off on"

    assert not LITTLE_WORDS.keys() & set(telling.split())


@given(st.integers(0, 10**9), st.integers(0, 20))
@settings(max_examples=100, deadline=None)
def test_a_hesitation_anywhere_changes_nothing(companion, seed, place):
    words = random_sentence(companion, random.Random(seed)).split()
    assume(not LITTLE_WORDS.keys() >= {*words} and ANY not in words)
    words.insert(place, "um")
    assume(parse(companion, " ".join(words)) is None)

    found = nearest(companion, " ".join(words))

    (edit,) = found.edits  # of a sentence that has some itself it may be another one
    assert edit.kind == "+"
    assert edit.word in {*HESITATIONS} & {*words}
    assert found.parse.tags == parse(companion, found.parse.text).tags
    assert found.cost <= MOST_COST


@given(st.lists(st.sampled_from([*list(LITTLE_WORDS)[::4], "go", "turn", "left"]), max_size=60))
@settings(max_examples=100, deadline=None)
def test_any_heap_of_words_is_answered_in_time(companion, words):
    gc.disable()  # The garbage of other tests is not what is measured.
    try:
        start = time.process_time()
        found = nearest(companion, " ".join(words))
        assert time.process_time() - start < 1.0
    finally:
        gc.enable()
    if found is not None:
        assert parse(companion, found.parse.text) is not None
