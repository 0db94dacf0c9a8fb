"""A command that stands in a longer sentence."""

import pytest
from hypothesis import given, strategies as st

from hri.speech.grammar import load_grammar, parse
from hri.speech.grammar.excerpt import excerpt

GRAMMAR = """#JSGF V1.0;
grammar small;

public <turn> = turn around | turn (left | right);

/** @answer */
public <yes> = yes please;

/** @topic chat */
public <tired> = i'm [so] tired;
"""


@pytest.fixture(scope="module")
def grammar(tmp_path_factory):
    file = tmp_path_factory.mktemp("grammar") / "small.jsgf"
    file.write_text(GRAMMAR)
    return load_grammar(file)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("turn around, i want to see your back", "turn around"),
        ("okay, buddy, turn left", "turn left"),
        ("turn left turn left turn left", "turn left"),
        ("turn around because i'm tired", "turn around"),
        ("i can't go on, i'm just so tired", "i'm tired"),
        ("it is late and i'm tired you know", "i'm tired"),
    ],
)
def test_what_stands_between_the_borders_of_clauses_counts(grammar, text, part):
    assert excerpt(grammar, text).text == part


@pytest.mark.parametrize(
    "text",
    [
        "turn around when i say so",
        "turn left i mean stop",
        "turn left don't",
        "turn around slowly",
        "he said turn around",
        "you never turn around",
        "i would never turn left",
        "don't turn around",
        "please don't you ever turn left",
        "yes please you are kind",
        "turn it around",
        "tired",
        "",
    ],
)
def test_what_the_rest_may_change_does_not_count(grammar, text):
    assert excerpt(grammar, text) is None


def test_only_rules_that_count_now_are_looked_for(grammar):
    assert excerpt(grammar, "turn left, buddy", rules=["tired"]) is None


WORDS = ("turn", "left", "around", "i'm", "tired", "so", "and", "don't", "not", "you", "buddy")


@given(st.lists(st.sampled_from(WORDS), max_size=12))
def test_a_part_is_a_sentence_and_no_denied_order_is_one(grammar, words):
    found = excerpt(grammar, " ".join(words))
    if found is None:
        return
    assert parse(grammar, found.text) is not None
    if found.rule == "turn":
        before = words[: words.index("turn")]
        assert not {"don't", "not", "you"} & set(before)
