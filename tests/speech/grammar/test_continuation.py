"""Whether more words may change what a sentence means."""

import pytest

from hri.speech.grammar import load_grammar
from hri.speech.grammar.continuation import may_go_on
from hri.speech.grammar.matching import parse

SHOP = """
public <order> = (a | the) <size> coffee [with milk {milk=true}] [<thanks>] | tea [now];
public <count> = one | one two {more=true} | <any> three;
public <shut> = close [the] shop | tea shop;
<size> = small | large {size=2};
/** @aside */
<thanks> = thank you {thanks=1};
"""


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("the small coffee", True),  # milk is another tag
        ("the small coffee with milk", False),  # thanks are said aside
        ("the small coffee with milk thank you", False),
        ("close shop", False),
        ("tea", True),  # <shut> goes on with it
        ("tea now", False),
        ("one", True),
        ("one two", False),
    ],
)
def test_words_that_change_the_rule_or_the_tags_may_follow(write, text, expected):
    grammar = load_grammar(write(SHOP))

    assert may_go_on(grammar, parse(grammar, text).rule, text, text) is expected


def test_words_that_follow_those_of_a_free_slot_may_change_it(write):
    rules = """
    public <call> = call <who.spoken> [again {again=true}];
    public <find> = find <what.spoken> [please];
    """
    grammar = load_grammar(write(rules))
    for who in ("anna", "anna maria", "call"):
        assert may_go_on(grammar, "call", f"call {who}", f"call {who}")
    assert not may_go_on(grammar, "find", "find my old cup", "find my old cup")


def test_free_words_change_nothing(write):
    rules = """
    /** @anywhere */
    public <bye> = see you later;
    /** @anywhere */
    public <hello> = good evening;
    """
    grammar = load_grammar(write(rules))

    assert not may_go_on(grammar, "hello", "good evening", "good evening")


@pytest.mark.parametrize(("text", "expected"), [("hello robot", True), ("bye robot", False)])
def test_what_may_stand_before_another_command_may_go_on(write, text, expected):
    rules = """
    public <greet> = hello <me>;
    public <leave> = bye <me>;
    public <turn> = [<polite>] turn left;
    <me> = robot;
    /** @aside */
    <polite> = hello <me> | please;
    """
    grammar = load_grammar(write(rules))

    assert may_go_on(grammar, parse(grammar, text).rule, text, text) is expected
