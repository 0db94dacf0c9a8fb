"""Sentences that show people what can be said."""

import pytest

from hri.conversation.examples import different, example_of, nearest_sentence, sayings
from hri.core import paths
from hri.speech.grammar import load_grammar, parse


@pytest.fixture(scope="module")
def grammar():
    return load_grammar(paths.find("grammars", "companion"))


def test_each_command_has_sentences_that_are_understood_as_it(grammar):
    shown = sayings(grammar)
    unshown = grammar.marked("answer") | grammar.marked("after") | grammar.marked("typed")
    rules = {*grammar.public_rules} - unshown - {"in_danger", "being_hurt", "emergency"}
    assert {*shown} <= rules
    # What people say of themselves and of the robot is not shown.
    assert {*shown} >= {rule for rule in rules if not grammar.rules[rule].topics}
    for rule, sentences in shown.items():
        assert 1 <= len(sentences) <= 3
        now = {*grammar.public_rules} - unshown
        assert {parse(grammar, text, now).rule for text in sentences} == {rule}


@pytest.fixture
def moods(tmp_path):
    file = tmp_path / "moods.jsgf"
    file.write_text(
        "#JSGF V1.0;\ngrammar moods;\npublic <low> = i want to be dead | my life is bad;\n"
        "public <rude> = you are bad | go away bad robot;\npublic <may> = you may move again;\n"
    )
    return load_grammar(file)


def test_no_one_is_told_to_say_something_sad_of_themselves_or_rude_of_the_robot(moods):
    assert sayings(moods) == {"rude": ["go away bad robot"], "may": ["you may move again"]}
    assert nearest_sentence(moods, "i want to be fed") == ""
    assert nearest_sentence(moods, "the battery is dead") == ""


def test_an_example_is_no_sentence_among_other_words(grammar):
    assert example_of(grammar, "how_are_you") == "how are you"
    assert example_of(grammar, "turn") == "turn left"


def test_courtesies_make_no_sentence_another_one(grammar):
    found = list(different(grammar, "eyes"))
    assert found[0] == "close your eyes"
    assert not [text for text in found if text.startswith("close your eyes ")]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("turn lef", "turn left"),
        ("Tell us the time", "what is the time"),
        ("turn the lights on", "turn on the lights"),
        ("purple elephants sing", ""),
    ],
)
def test_the_nearest_sentence_is_alike_or_about_the_same(grammar, text, sentence):
    assert nearest_sentence(grammar, text) == sentence
