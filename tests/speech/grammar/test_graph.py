from __future__ import annotations

import math
import time
from itertools import product

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

from hri.core.errors import AuthoringError
from hri.hal.word_graph import SILENT, WordGraph
from hri.speech.grammar import Grammar, automaton, load_grammar, read_grammar
from hri.speech.grammar.grammar_size import too_large
from hri.speech.grammar.matching import parse
from tests.speech.grammar.oracle import WORDS, assume_written_out, grammars


def accepts(graph: WordGraph, words: tuple[str, ...]) -> bool:
    """Whether a path from the start to the end says these words."""
    return graph.final in _after(graph, words)


def _after(graph: WordGraph, words: tuple[str, ...]) -> set[int]:
    def silently(nodes: set[int]) -> set[int]:
        for _ in range(graph.size):
            more = {int(t) for s, t in silent if s in nodes} - nodes
            if not more:
                return nodes
            nodes = nodes | more
        raise AssertionError("a silent circle")

    arcs = list(zip(graph.sources, graph.targets, graph.labels, strict=True))
    silent = [(s, t) for s, t, label in arcs if label == SILENT]
    nodes = silently({graph.start})
    for word in words:
        nodes = silently(
            {int(t) for s, t, n in arcs if s in nodes and n >= 0 and graph.words[n] == word}
        )
    return nodes


def has_silent_circle(graph: WordGraph) -> bool:
    """Whether taking away, again and again, what no silent arc enters leaves anything."""
    is_left = graph.labels == SILENT
    while is_left.any():
        entered = np.zeros(graph.size, bool)
        entered[graph.targets[is_left]] = True
        stays = is_left & entered[graph.sources]
        if (stays == is_left).all():
            return True
        is_left = stays
    return False


def graph_of(grammar: Grammar) -> WordGraph:
    assume_written_out(grammar)
    return grammar.graph()


@given(grammars())
@settings(max_examples=80, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
def test_the_graph_accepts_what_the_matcher_accepts(grammar):
    graph = graph_of(grammar)

    for length in (1, 2, 3):
        for words in product(WORDS, repeat=length):
            assert accepts(graph, words) == (parse(grammar, " ".join(words)) is not None)
    assert not accepts(graph, ())


@given(grammars())
@settings(max_examples=80, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
def test_every_graph_keeps_its_promises(grammar):
    graph = graph_of(grammar)
    arcs = len(graph.sources)

    assert len(graph.targets) == len(graph.labels) == len(graph.weights) == arcs
    assert not has_silent_circle(graph)
    assert (np.diff(graph.sources) >= 0).all()
    assert not (graph.sources == graph.final).any()
    assert not (graph.targets == graph.start).any()
    assert len(set(graph.words)) == len(graph.words)
    assert set(graph.labels[graph.labels >= 0]) == set(range(len(graph.words)))
    for node in set(graph.sources):
        leaving = graph.weights[graph.sources == node]
        assert np.exp(leaving.astype(float)).sum() == pytest.approx(1.0, abs=1e-4)
    assert set(graph.entries) <= set(grammar.public_rules)
    begins = np.isin(graph.targets, list(graph.entries.values()))
    assert (graph.labels[begins] == SILENT).all()
    assert sorted(graph.targets[begins]) == sorted(graph.entries.values())


def test_every_listed_sentence_is_in_the_graph(companion):
    graph = companion.graph()

    # A rule has free words in each sentence, which are for the keyboard.
    typed = companion.marked("typed") | {"my_people"}
    spoken = set(companion.public_rules) - typed
    parses = [parse(companion, text) for text in companion.sentences(40)]
    sentences = [one.text for one in parses if one.rule in spoken and not one.free]
    assert all(accepts(graph, tuple(text.split())) for text in sentences)
    assert set(graph.entries) == spoken
    assert companion.graph() is graph


def test_beginnings_and_endings_are_shared(write):
    people = " | ".join(
        f"{first} {last}" for first in ("ann", "bob", "cy") for last in ("li", "wu")
    )

    graph = load_grammar(write(f"public <call> = call ({people}) now;")).graph()

    assert sorted(graph.words[label] for label in graph.labels if label >= 0) == [
        "ann", "bob", "call", "cy", "li", "now", "wu",
    ]  # fmt: skip


def test_what_is_said_around_many_rules_is_there_once(tmp_path):
    path = tmp_path / "test.jsgf"
    path.write_text(
        "#JSGF V1.0;\n/** @before <nice>\n * @after <late>\n */\ngrammar test;\n"
        "public <a> = x; public <b> = y; public <c> = z; <nice> = please; <late> = now;"
    )

    graph = load_grammar(path).graph()

    assert sorted(graph.words[label] for label in graph.labels if label >= 0) == [
        "now", "please", "x", "y", "z",
    ]  # fmt: skip


def test_weights_become_logarithms(write):
    graph = load_grammar(write("public <a> = /3/ x | /1/ y | /0/ z;")).graph()

    weights = {
        graph.words[n]: w for n, w in zip(graph.labels, graph.weights, strict=True) if n >= 0
    }
    assert weights == pytest.approx({"x": math.log(0.75), "y": math.log(0.25)})


def test_shared_beginnings_keep_the_worth_of_sentences(write):
    graph = load_grammar(write("public <a> = /3/ x y | /1/ x z;")).graph()

    weights = {
        graph.words[n]: w for n, w in zip(graph.labels, graph.weights, strict=True) if n >= 0
    }
    assert weights == pytest.approx({"x": 0.0, "y": math.log(0.75), "z": math.log(0.25)}, abs=1e-6)


def test_right_recursion_is_a_loop(write):
    graph = load_grammar(write("public <a> = x <a> | y;")).graph()

    assert accepts(graph, ("x",) * 50 + ("y",))
    assert graph.size < 8


def test_a_rule_inside_itself_is_written_out_a_few_times(write):
    graph = load_grammar(write("public <a> = open <a> close | y;")).graph()

    assert accepts(graph, ("open",) * 5 + ("y",) + ("close",) * 5)
    assert not accepts(graph, ("open",) * 9 + ("y",) + ("close",) * 9)
    assert not accepts(graph, ("open", "open", "y", "close"))


def test_sums_of_products_in_parentheses_stay_small(write):
    rules = """public <sum> = <product> plus <sum> | <product>;
    <product> = <factor> times <product> | <factor>;
    <factor> = open <sum> close | one | two;"""
    grammar = load_grammar(write(rules))

    assert len(grammar.automaton.targets) < 100_000
    assert parse(grammar, "one times open two plus open one times two close close plus one")


@given(grammars())
@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
def test_every_sentence_of_an_expansion_is_understood(grammar):
    graph_of(grammar)

    assert all(parse(grammar, text) is not None for text in grammar.sentences(40))


@pytest.mark.parametrize("beginnings", [300, 1])
def test_ten_thousand_names_are_written_out_at_once(beginnings, write):
    names = " | ".join(f"first{n % beginnings} last{n} {{name={n}}}" for n in range(10_000))
    grammar = load_grammar(write(f"public <call> = (call | phone) <name>;\n<name> = {names};"))

    start = time.process_time()
    graph = grammar.graph()
    assert time.process_time() - start < 1.5
    assert len(graph.sources) < 10_500


def test_a_grammar_that_explodes_is_refused(write, monkeypatch):
    monkeypatch.setattr(automaton, "MOST_ARCS", 20_000)
    rules = "".join(f"<r{n}> = <r{n + 1}> x <r{n + 1}> y;\n" for n in range(40))
    grammar = load_grammar(write(f"public <a> = <r0>;\n{rules}<r40> = z;"))

    with pytest.raises(AuthoringError, match=r"3:1: <a> written out takes more than 20,000"):
        grammar.graph()


def test_left_recursion_is_refused(write):
    grammar, _ = read_grammar(write("public <a> = <a> x | y;"))

    with pytest.raises(AuthoringError, match="<a> leads back to itself before a word is said"):
        grammar.graph()


@given(grammars())
@settings(max_examples=60)
def test_what_is_counted_beforehand_is_not_more_than_is_written(grammar):
    assume_written_out(grammar)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(automaton, "too_large", lambda grammar, most: None)
        arcs = build_arcs(grammar)
    assert too_large(grammar, arcs) is None


def build_arcs(grammar) -> int:
    """How many arcs are written, those that lead nowhere included."""
    builder = automaton._Builder(grammar, frozenset())
    builder.build()
    return len(builder._arcs.sources) + builder._contexts


@pytest.mark.parametrize(
    "use",
    ["<a{}> <a{}>", "one <a{}> [two] <a{}> three", "<a{}>* <a{}>", "<a{}> {{x}} | <a{}> {{y}}"],
)
def test_a_small_grammar_that_explodes_is_refused_at_once(use, write):
    """Thirty rules, each twice in the one before: a billion steps."""
    rules = [f"<a{i}> = {use.format(i + 1, i + 1)};" for i in range(30)]
    grammar = load_grammar(write("public " + "\n".join(rules) + "\n<a30> = one | two;"))
    begun = time.process_time()
    with pytest.raises(AuthoringError, match="<a0> written out takes more than 300,000 steps"):
        grammar.graph()
    assert time.process_time() - begun < 1.0
