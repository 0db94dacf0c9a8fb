"""The search is exact: it agrees with trying every sentence in every way."""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection

import numpy as np
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from hri.hal.word_graph import WordGraph
from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.lattice import Walk
from hri.speech.recognizers.ctc.phone_graph import compile
from hri.speech.recognizers.ctc.search import Search
from tests.speech.recognizers.word_graphs import (
    SOUNDS,
    WORDS,
    Sounds,
    random_scores,
    sentence_graph,
    spelled,
    word_graph,
)


def all_sentences(
    graph: WordGraph, longest: int, rules: Collection[str]
) -> dict[tuple[int, ...], float]:
    """Every sentence up to a length, with the weight of its best way; all rules are as likely."""
    barred = {node for rule, node in graph.entries.items() if rule not in rules}
    every = zip(graph.sources, graph.targets, graph.labels, graph.weights, strict=True)
    arcs = [arc for arc in every if arc[1] not in barred]
    even = math.log(len(graph.entries))
    found: dict[tuple[int, ...], float] = {}
    waiting: list[tuple[int, tuple[int, ...], float]] = [(graph.start, (), 0.0)]
    while waiting:
        node, words, weight = waiting.pop()
        if node == graph.final and words:
            found[words] = max(found.get(words, -np.inf), weight + even)
        for source, target, label, more in arcs:
            said = words if label < 0 else (*words, int(label))
            if source == node and len(said) <= longest:
                waiting.append((int(target), said, weight + float(more)))
    return found


def score_of_words(words: tuple[int, ...], scores: NDArray[np.float32]) -> float:
    """Score of a sentence, by the plain recursion over all its states, in every pronunciation."""
    best = -np.inf
    for said in itertools.product(*(SOUNDS[WORDS[word]] for word in words)):
        classes, needs_blank = [0], [False]
        for phones in said:
            for index, phone in enumerate(phones):
                classes += [CLASSES.index(phone), 0]
                needs_blank += [index > 0 and phone == phones[index - 1], False]
        states = np.full(len(classes), -np.inf)
        for frame, row in enumerate(scores):
            before = states
            states = np.full(len(classes), -np.inf)
            for state, phone_class in enumerate(classes):
                ways = [before[state]]
                if frame == 0 and state < 2:
                    ways.append(0.0)
                if state > 0:
                    ways.append(before[state - 1])
                if state > 1 and phone_class and not needs_blank[state]:
                    ways.append(before[state - 2])
                states[state] = max(ways) + row[phone_class]
        best = max(best, states[-1], states[-2])
    return best


@st.composite
def word_graphs(draw: st.DrawFn) -> WordGraph:
    size = draw(st.integers(3, 5))
    arcs = [(0, 1, -1, 0.0)]
    for _ in range(draw(st.integers(1, 7))):
        source = draw(st.integers(0, size - 2))
        label = draw(st.integers(-1, len(WORDS) - 1))
        lowest = source + 1 if label < 0 else max(1, source)
        target = draw(st.integers(lowest, size - 1))
        arcs.append((source, target, label, draw(st.sampled_from([0.0, -0.5, -2.0]))))
    arcs.append((1, size - 1, draw(st.integers(0, len(WORDS) - 1)), -1.0))
    return word_graph(arcs, size)


@st.composite
def framed_graphs(draw: st.DrawFn) -> WordGraph:
    """Words that may be said before two of three rules, and words behind these two."""

    def words(source: int, target: int) -> list[tuple[int, int, int, float]]:
        count = draw(st.integers(1, 2))
        labels = [draw(st.integers(0, len(WORDS) - 1)) for _ in range(count)]
        weights = [draw(st.sampled_from([0.0, -0.5, -2.0])) for _ in labels]
        arcs = zip(labels, weights, strict=True)
        return [(source, target, label, weight) for label, weight in arcs]

    # 0 is the start, 1 leads to the hub 2; 3 and 4 are the rules behind it, 5 the one without.
    even = -np.log(3.0)
    arcs = [(0, 1, -1, -0.7), (0, 2, -1, -0.1), (6, 7, -1, -0.1)]
    arcs += [(2, 3, -1, even), (2, 4, -1, even), (0, 5, -1, even)]
    arcs += words(1, 2) + words(3, 6) + words(4, 6) + words(5, 7) + words(6, 7)
    return word_graph(list({arc[:3]: arc for arc in arcs}.values()), 8, {"a": 3, "b": 4, "c": 5})


@settings(max_examples=120, deadline=None)
@given(
    word_graphs() | framed_graphs(),
    st.sets(st.sampled_from(["a", "b"])),
    st.integers(0, 2**32 - 1),
    st.integers(1, 7),
)
def test_the_best_sentences_are_those_of_trying_everything(
    graph: WordGraph, idle: set[str], seed: int, frames: int
) -> None:
    rules = graph.entries.keys() - idle
    scores = random_scores(seed, frames)
    expected = sorted(
        (
            (weight + score_of_words(words, scores), words)
            for words, weight in all_sentences(graph, 5, rules).items()
        ),
        reverse=True,
    )
    expected = [(score, words) for score, words in expected if score > -1e6]
    search = Search(compile(graph, Sounds()))
    search.begin(rules)
    search.advance(scores[: frames // 2])
    search.advance(scores[frames // 2 :])
    paths = Walk(search.trellis).sentences(3, 100.0)
    assert bool(paths) == bool(expected)
    if paths:
        best, score = paths[0], expected[0][0]
        assert abs(best.score - score) < 1e-3
        ties = [words for other, words in expected if abs(other - score) < 1e-3]
        assert best.words in [tuple(WORDS[word] for word in words) for words in ties]
        scores_of = {tuple(WORDS[w] for w in words): score for score, words in expected}
        for path in paths:
            assert path.score <= scores_of[path.words] + 1e-3


@given(st.integers(0, 2**32 - 1), st.lists(st.integers(0, 12), min_size=1, max_size=4))
def test_chunks_change_nothing(seed: int, chunks: list[int]) -> None:
    graph = compile(sentence_graph("go a goal", "no no", "add gogo"), Sounds())
    scores = random_scores(seed, sum(chunks) + 1)
    whole, parts = Search(graph), Search(graph)
    whole.advance(scores)
    for first, count in zip(np.cumsum([0, *chunks]), [*chunks, 1], strict=True):
        parts.advance(scores[first : first + count])
    found, same = (Walk(search.trellis).sentences(5, 50.0) for search in (whole, parts))
    assert found == same


def test_the_words_so_far_are_there_while_it_goes_on() -> None:
    search = Search(compile(sentence_graph("go no", "goal"), Sounds()))
    assert search.partial() == ()
    heard = []
    for row in spelled("blank", "G", "blank", "OW", "blank", "N", "OW"):
        search.advance(row[None])
        heard.append(search.partial())
    assert heard[1] == ()
    assert heard[3] == ("go",)
    assert heard[-1] == ("go", "no")


def test_only_the_rules_that_are_active_are_heard() -> None:
    arcs = [(0, 1, -1, 0.0), (0, 2, -1, 0.0)]
    arcs += [(1, 3, WORDS.index("go"), 0.0), (2, 3, WORDS.index("no"), 0.0)]
    search = Search(compile(word_graph(arcs, 4, {"early": 1, "late": 2}), Sounds()))
    for rules, expected in ((None, ("go",)), ({"late"}, ("no",)), (set(), None)):
        search.begin(rules)
        search.advance(spelled("blank", "G", "OW"))
        paths = Walk(search.trellis).sentences(1, 0.0)
        assert (paths[0].words if paths else None) == expected
        assert search.partial() == (expected or ())


def test_a_long_piece_of_speech_has_room() -> None:
    search = Search(compile(sentence_graph("go", "no"), Sounds()))
    search.advance(spelled(*["blank"] * 700, "N", "OW", *["blank"] * 300))
    (best,) = Walk(search.trellis).sentences(1, 0.0)
    assert best.words == ("no",)
    assert best.spans[0].start == 700
