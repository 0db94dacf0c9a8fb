"""What people say to the companion in other words than its grammar has."""

import tomllib

import pytest

from hri.robot.app import load_app
from hri.speech.grammar import load_grammar
from hri.speech.grammar.guessing import paraphrased
from hri.speech.grammar.paraphrases import NO_RULE

FOLDER = load_app("companion").folder
BOLD = ("come", "eyes", "find", "follow", "forget", "learn", "move", "release", "sleep", "turn")
"""Actions that nobody wants by a guess."""


@pytest.fixture(scope="module")
def grammar():
    return load_grammar("companion")


def sure_rules(grammar):
    """The rules that a text may be taken for."""
    for each in grammar.paraphrases:
        for rule, _ in each.heads:
            if rule != NO_RULE and rule not in each.vague:
                yield rule


def test_no_guess_moves_the_base_or_makes_up_a_value(grammar):
    with (FOLDER / "replies.toml").open("rb") as file:
        replies = tomllib.load(file)["reply"]
    rules = list(sure_rules(grammar))
    assert len(rules) > 200
    for rule in rules:
        assert not grammar.tag_names(rule), rule
        assert {"move", "turn", "come", "follow"}.isdisjoint(grammar.rules[rule].after), rule
        assert not grammar.rules[rule].marks & {"careful", "answer", "wake"}, rule
        assert replies.get(rule, {}).get("action") not in BOLD, rule


def test_each_rule_that_may_be_guessed_is_meant_by_its_own_lines(grammar):
    lines = {rule: [] for rule in sure_rules(grammar)}
    for each in grammar.paraphrases:
        for line in each.lines:
            if line.rule in lines:
                lines[line.rule].append(" ".join(line.words))
    for rule, texts in lines.items():
        meant = (paraphrased(grammar, text) for text in texts)
        assert any(found is not None and found.rule == rule for found in meant), rule


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("you guys ever get bored in here", "are_you_bored"),
        ("speak up dear i left my hearing aids upstairs", "louder"),
        ("nobody let me sit with them at lunch", "bullied"),
        ("hi i broke my leg", "illness"),
    ],
)
def test_what_nobody_wrote_down_is_understood(grammar, text, rule):
    assert not any(
        text.split() == list(line.words) for each in grammar.paraphrases for line in each.lines
    )
    assert paraphrased(grammar, text).rule == rule


@pytest.mark.parametrize(
    "text",
    [
        "the plumber put the new sink in on thursday",
        "could you roll on over here to me",
        "scoot a tad to your left side would you",
        "he told me to turn left at the church",
    ],
)
def test_what_says_something_else_or_would_move_it_is_not_guessed(grammar, text):
    assert paraphrased(grammar, text) is None
