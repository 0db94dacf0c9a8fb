from __future__ import annotations

import pytest
from hypothesis import given, settings, strategies as st

from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import parse
from hri.speech.grammar.slot_values import VALUE, values_of

RULES = (
    "public <order> = bring me (a small {size=small} | a large {size=large}) <drink>\n"
    "  [with <drink> {second=$drink}];\n"
    "<drink> = (tea | ice tea {ice}) {drink=tea} | coffee {drink=coffee};\n"
    "public <stop> = stop;\n"
)


@pytest.fixture(scope="module")
def grammar(tmp_path_factory):
    path = tmp_path_factory.mktemp("values") / "order.jsgf"
    path.write_text(f"#JSGF V1.0;\ngrammar order;\n{RULES}", encoding="utf-8")
    return load_grammar(path)


def test_a_value_is_said_by_itself_and_nothing_else_is(grammar):
    sizes = values_of(grammar, "order", "size")
    assert sizes.public_rules == (VALUE,)
    assert [*sizes.sentences(9)] == ["small", "large"]
    assert parse(sizes, "stop") is None
    assert parse(values_of(grammar, "order", "second"), "coffee").tags == {"second": "coffee"}


def test_where_nothing_gives_a_value_there_is_nothing_to_say(grammar):
    assert values_of(grammar, "stop", "size").public_rules == ()


@settings(max_examples=40, deadline=None)
@given(st.data())
def test_each_value_is_one_that_the_command_may_have(grammar, data):
    tag = data.draw(st.sampled_from(("size", "drink", "second")))
    values = values_of(grammar, "order", tag)
    text = data.draw(st.sampled_from([*values.sentences(20)]))
    allowed = {parse(grammar, one).tags.get(tag) for one in grammar.sentences_of("order", 200)}
    assert parse(values, text).tags[tag] in allowed


def test_the_value_of_a_free_slot_is_said_by_itself_or_with_its_words(tmp_path):
    path = tmp_path / "call.jsgf"
    rules = "public <call> = call me <name.spoken 1-2>; public <stop> = stop;"
    path.write_text(f"#JSGF V1.0;\ngrammar call;\n{rules}", encoding="utf-8")
    names = values_of(load_grammar(path), "call", "name")
    assert parse(names, "zorvin").tags == {"name": "zorvin"}
    assert parse(names, "call me zorvin").tags == {"name": "zorvin"}
    assert parse(names, "me zorvin").tags == {"name": "zorvin"}
