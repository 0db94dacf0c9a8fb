"""What a sentence that no rule allows seems to be about."""

import pytest

from hri.conversation.gist import Gist
from hri.core import paths
from hri.speech.grammar import load_grammar


@pytest.fixture(scope="module")
def gist():
    return Gist.of(load_grammar(paths.find("grammars", "companion")))


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("turn the lights on", "turn"),
        ("what is my name", "name"),
        ("is the battery dead", "battery"),
        ("make a scary sad face", "show"),
        ("fly to the moon", ""),
        ("i can not do that", ""),
        ("yes maybe", ""),
        ("", ""),
    ],
)
def test_it_is_the_rule_with_most_of_the_words_that_tell(gist, text, rule):
    assert gist.rule_of(text) == rule


def test_strange_words_are_those_of_no_command_in_order(gist):
    assert gist.strange("Glue me to the zeppelin, glue!") == ["glue", "zeppelin"]
    assert gist.strange("turn left now") == []
    assert Gist({}, frozenset(), frozenset()).rule_of("turn left") == ""
