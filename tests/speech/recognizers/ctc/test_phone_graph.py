"""The states of a grammar are few, and a grammar that cannot be one says so."""

from __future__ import annotations

import dataclasses

import pytest

from hri.core.errors import HriError
from hri.speech.recognizers.ctc import phone_graph
from hri.speech.recognizers.ctc.phone_graph import compile
from tests.speech.recognizers.word_graphs import WORDS, Sounds, sentence_graph, word_graph


def test_words_that_begin_alike_share_their_phones() -> None:
    graph = compile(sentence_graph("go", "goal", "gogo"), Sounds())
    assert graph.size == 5  # G OW L, and G OW again.
    assert len(graph.exit_states) == 3


def test_every_pronunciation_ends_the_word() -> None:
    graph = compile(sentence_graph("a"), Sounds())
    assert graph.size == 2
    assert {graph.words[word] for word in graph.exit_words} == {"a"}


def test_a_phone_that_is_said_twice_is_known_for_it() -> None:
    graph = compile(sentence_graph("add", "go"), Sounds())
    (state,) = graph.doubled
    assert graph.phones[state] == graph.phones[graph.parents[state]]


def test_silent_ways_are_passed_by_their_best_weight() -> None:
    go, no = WORDS.index("go"), WORDS.index("no")
    arcs = [(0, 1, go, 0.0), (1, 3, -1, -3.0), (1, 2, -1, -1.0), (2, 3, -1, -1.0), (3, 4, no, 0.0)]
    graph = compile(word_graph(arcs, 5), Sounds())
    assert graph.link_weights.tolist() == [-2.0, 0.0]


def test_a_word_that_nobody_can_pronounce_is_refused() -> None:
    unknown = dataclasses.replace(sentence_graph("go"), words=("xyzzy",) * len(WORDS))
    with pytest.raises(HriError, match="xyzzy"):
        compile(unknown, Sounds())


def test_a_grammar_without_words_is_refused() -> None:
    with pytest.raises(HriError, match="no words"):
        compile(word_graph([(0, 1, -1, 0.0), (1, 2, -1, 0.0)], 3), Sounds())


def test_a_grammar_that_is_too_large_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(phone_graph, "MOST_STATES", 3)
    with pytest.raises(HriError, match="more than 3 states"):
        compile(sentence_graph("go goal", "no add"), Sounds())
