from __future__ import annotations

import math
import random
import time

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import AuthoringError
from hri.speech.grammar import load_grammar, read_grammar
from hri.speech.grammar.expansion import count_sentences, count_ways, random_sentence
from hri.speech.grammar.matching import parse


def test_many_sentences_are_drawn_from_a_long_list_at_once(write, tmp_path):
    (tmp_path / "names.txt").write_text("\n".join(f"name {n}" for n in range(20_000)))
    grammar = load_grammar(write('import "names.txt" as <name>;\npublic <a> = call <name>;'))
    chance = random.Random(0)
    random_sentence(grammar, chance)

    start = time.process_time()
    drawn = {random_sentence(grammar, chance) for _ in range(1000)}
    assert time.process_time() - start < 1.0
    assert len(drawn) > 900


@pytest.mark.parametrize(
    ("rules", "sentences"),
    [
        ("public <a> = x (y | z) [w];", ["x y", "x y w", "x z", "x z w"]),
        ("public <a> = x | y;\npublic <b> = z | w;", ["x", "z", "y", "w"]),
        ("public <a> = x+;", ["x", "x x"]),
        ("public <a> = x* y;", ["y", "x y", "x x y"]),
        ("public <a> = x | /0/ y | z <VOID>;", ["x"]),
        ("public <a> = [x] [x];", ["x", "x x"]),
        ("public <a> = x [<a>];", ["x", "x x", "x x x", "x x x x", "x x x x x"]),
    ],
)
def test_sentences_come_in_the_order_of_writing(write, rules, sentences):
    assert list(load_grammar(write(rules)).sentences(100)) == sentences


@pytest.mark.parametrize(
    ("rules", "ways", "different"),
    [
        ("public <a> = x (y | z) [w];", 4, 4),
        ("public <a> = <b> <b>;\n<b> = x | y | z;", 9, 9),
        ("public <a> = [x] [x];", 4, 2),
        ("public <a> = x | x;\npublic <b> = x;", 3, 1),
        ("public <a> = x | /0/ y;", 1, 1),
        ("public <a> = x | y <VOID> z;", 1, 1),
        ("public <a> = x | y <VOID> <a>;", 1, 1),
        ("public <a> = x <VOID>* y;", 1, 1),
        ("public <a> = x+;", math.inf, None),
        ("public <a> = x [<a>];", math.inf, None),
        ("public <a> = x <b>;\n<b> = y [<c>];\n<c> = z [<b>];", math.inf, None),
    ],
)
def test_ways_are_counted_exactly(write, rules, ways, different):
    grammar = load_grammar(write(rules))

    assert count_ways(grammar) == ways
    assert count_sentences(grammar) == different


def test_large_numbers_of_ways_are_whole_numbers(write):
    rules = "public <a> = x " + "[y] " * 200 + ";\npublic <b> = " + "<c> " * 2000 + ";\n"
    grammar = load_grammar(write(rules + "<c> = x | y | z | w | v;"))

    assert count_ways(grammar, ["a"]) == 2**200
    assert count_ways(grammar, ["b"]) == math.inf
    assert count_sentences(grammar) is None


def test_doubling_rules_neither_hang_nor_fill_the_memory(write):
    rules = "".join(f"<r{n}> = <r{n + 1}> <r{n + 1}>;\n" for n in range(100))
    grammar = load_grammar(write(f"public <a> = <r0>;\npublic <b> = go;\n{rules}<r100> = x | y;"))

    assert count_ways(grammar) == math.inf
    assert list(grammar.sentences(10)) == ["go"]
    with pytest.raises(AuthoringError, match="sentences of more than"):
        random_sentence(grammar, random.Random(1), ["a"])


def test_a_million_ways_to_say_the_same_are_given_up(write):
    grammar = load_grammar(write("public <a> = x " + "[y] " * 40 + ";"))

    assert "x" in list(grammar.sentences(100))


def test_deep_and_wide_rules_are_told_to_their_end(write):
    links = "".join(f"<r{n}> = <r{n + 1}>;\n" for n in range(2000))
    words = " ".join(f"w{n}" for n in range(5000))
    wide = " | ".join(f"v{n}" for n in range(5000))
    grammar = load_grammar(
        write(f"public <a> = <r0> | {wide};\n{links}<r2000> = end;\npublic <b> = {words};")
    )

    assert count_ways(grammar) == 5002
    assert len(list(grammar.sentences(10_000))) == 5002


def test_chance_follows_the_weights_and_the_seed(write):
    grammar = load_grammar(write("public <a> = /3/ x | y | /0/ z;"))
    drawn = [random_sentence(grammar, random.Random(seed)) for seed in range(1000)]

    assert drawn == [random_sentence(grammar, random.Random(seed)) for seed in range(1000)]
    assert set(drawn) == {"x", "y"}
    assert 680 < drawn.count("x") < 820


@given(st.integers(0, 10**9))
@settings(max_examples=100, deadline=None)
def test_recursion_by_chance_ends_in_a_sentence(tmp_path_factory, seed):
    path = tmp_path_factory.getbasetemp() / "recursive.jsgf"
    rules = "public <a> = x [and <b>];\n<b> = (y | (z | <a>)+) [<a>];\n"
    path.write_text(f"#JSGF V1.0;\ngrammar r;\n{rules}")
    grammar = load_grammar(path)

    assert parse(grammar, random_sentence(grammar, random.Random(seed))) is not None


def test_a_chosen_rule_is_drawn_from(companion):
    drawn = {random_sentence(companion, random.Random(seed), ["stop"]) for seed in range(50)}

    assert {parse(companion, text).rule for text in drawn} == {"stop"}


def test_a_grammar_without_public_rules_has_no_sentence_to_draw(write):
    grammar, _ = read_grammar(write("<a> = go | stop;"))
    with pytest.raises(AuthoringError, match="no public rule"):
        random_sentence(grammar, random.Random(1))
    assert grammar.sample(5) == []


def test_a_few_sentences_of_thousands_of_commands_come_at_once(write):
    rules = (f"public <r{number}> = word{number} now;" for number in range(4000))
    grammar = load_grammar(write("\n".join(rules)))
    assert len(list(grammar.sentences(1))) == 1  # heights are worked out once

    start = time.process_time()
    assert all(len(list(grammar.sentences(1))) == 1 for _ in range(100))
    assert time.process_time() - start < 1.5
