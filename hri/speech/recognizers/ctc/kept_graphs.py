"""Compiled grammars that are kept: one that comes back, as after a question, costs no work."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

from hri.hal.word_graph import WordGraph
from hri.speech.grammar.words import free_words
from hri.speech.recognizers.ctc.phone_graph import PhoneGraph, Pronouncing, compile

MOST_KEPT = 8
"""Compiled grammars; that of the companion has 1 MB."""

Sounds = tuple[tuple[str, ...], ...]
"""The pronunciations of a word."""


@dataclass(frozen=True, slots=True)
class _Content:
    """All that a compiled grammar depends on."""

    arrays: tuple[bytes, ...]
    numbers: tuple[int, ...]
    words: tuple[str, ...]
    entries: tuple[tuple[str, int], ...]
    expected: frozenset[str]
    sounds: tuple[tuple[str, Sounds], ...]
    graph: WordGraph = field(compare=False)


def compiled(graph: WordGraph, lexicon: Pronouncing) -> PhoneGraph:
    """As `compile`, or what that made of the same graph and the same pronunciations before."""
    arrays = (graph.sources, graph.targets, graph.labels, graph.weights)
    used = dict.fromkeys(graph.labels[graph.labels >= 0].tolist())
    return _compiled(
        _Content(
            tuple(array.tobytes() for array in arrays),
            (graph.size, graph.start, graph.final),
            graph.words,
            tuple(graph.entries.items()),
            graph.expected,
            tuple((graph.words[label], _sounds(graph.words[label], lexicon)) for label in used),
            graph,
        )
    )


def _sounds(word: str, lexicon: Pronouncing) -> Sounds:
    is_free = free_words(word) is not None
    return () if is_free else tuple(tuple(phones) for phones in lexicon.pronunciations(word))


@lru_cache(maxsize=MOST_KEPT)
def _compiled(content: _Content) -> PhoneGraph:
    return compile(content.graph, _Listed(dict(content.sounds)))


class _Listed:
    """The pronunciations that were looked up."""

    def __init__(self, sounds: Mapping[str, Sounds]) -> None:
        self._sounds = sounds

    def pronunciations(self, word: str) -> Sequence[Sequence[str]]:
        return self._sounds[word]
