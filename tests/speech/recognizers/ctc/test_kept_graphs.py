"""A grammar that comes back is not compiled again; one in which anything changed is."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from hri.core.errors import HriError
from hri.speech.recognizers.ctc.kept_graphs import compiled
from hri.speech.recognizers.ctc.phone_graph import compile
from tests.speech.recognizers.word_graphs import WORDS, Sounds, sentence_graph


class OtherSounds(Sounds):
    def pronunciations(self, word: str) -> tuple[tuple[str, ...], ...]:
        return (*super().pronunciations(word), ("L", "EY"))


def test_the_same_content_is_the_same_graph() -> None:
    kept = compiled(sentence_graph("go", "a goal"), Sounds())
    assert compiled(sentence_graph("go", "a goal"), Sounds()) is kept
    made = compile(sentence_graph("go", "a goal"), Sounds())
    for name in ("phones", "parents", "exit_words", "exit_weights", "link_weights"):
        assert np.array_equal(getattr(kept, name), getattr(made, name))


def test_other_sentences_weights_rules_and_sounds_are_another_graph() -> None:
    graph = sentence_graph("go", "a goal")
    kept = compiled(graph, Sounds())
    others = [
        compiled(sentence_graph("go", "no goal"), Sounds()),
        compiled(dataclasses.replace(graph, weights=graph.weights - 1), Sounds()),
        compiled(dataclasses.replace(graph, entries={"other": 0}), Sounds()),
        compiled(dataclasses.replace(graph, expected=frozenset(["all"])), Sounds()),
        compiled(graph, OtherSounds()),
    ]
    assert len({id(one) for one in [kept, *others]}) == 6
    assert others[-1].size > kept.size


def test_a_word_that_nobody_can_pronounce_is_refused_each_time() -> None:
    unknown = dataclasses.replace(sentence_graph("go"), words=("xyzzy",) * len(WORDS))
    for _ in range(2):
        with pytest.raises(HriError, match="xyzzy"):
            compiled(unknown, Sounds())
