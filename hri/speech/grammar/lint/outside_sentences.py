"""What a grammar takes a sentence for that it does not allow: its own sentence nearest in sound.

A recognizer ends inside of the grammar, whatever was said. Here the sentence is its phones, and the
nearest way through the word graph is the one with the fewest changes: Levenshtein's table with a
graph in the place of one text (E. Myers and W. Miller, "Approximate Matching of Regular
Expressions", 1989), and the costs of `hri.speech.pronunciation.phones`. It is exact: no sentence of
the grammar is nearer, however many it has. Free words take anything and are left out.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import AuthoringError, Place
from hri.core.reading import read_text
from hri.hal.word_graph import SILENT, WordGraph
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.lint.confusion import (
    COSTS,
    LONGEST,
    difference,
    padded,
    phones_of,
)
from hri.speech.grammar.matching import Parse, parse
from hri.speech.grammar.tags import Value
from hri.speech.grammar.words import free_words, normalize
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.pronunciation.phones import DROPPED

FARTHEST_OUTSIDE = 0.12
"""Distance up to which an outside sentence is told. Of those spoken to a cafe and a house whose
grammars do not allow them, 61 % that are nearer were taken at once, and 10 % of the others."""
MOST_SENTENCES = 1000
"""In one file."""
_SAME = 1e-4
"""Costs that differ by less are the same."""
_BLOCK = 64
"""Sentences that are followed through the graph together."""

Phones = NDArray[np.int32]
Table = NDArray[np.float32]
"""The least cost of having said the first phones of each sentence. [sentences, phones + 1]"""

_TOO_MUCH = DROPPED * np.arange(LONGEST + 1, dtype=np.float32)
"""The cost of as many phones outside of words."""


@dataclass(frozen=True, slots=True)
class Taken:
    """A sentence from outside, and the one that it is taken for."""

    said: str
    """Its words, lower case, one space between."""
    reading: Parse
    distance: float
    """The cost of the changes over the phones of what was said: 0 is the same sound."""

    @property
    def difference(self) -> tuple[str, str]:
        """The words in which they differ, without those they share."""
        return difference(self.said, self.reading.text)

    @property
    def sets(self) -> dict[str, Value]:
        """The tags that get their values from words which were not said."""
        words = self.said.split(), self.reading.text.split()
        names: dict[str, None] = {}
        for kind, _, _, begin, end in SequenceMatcher(None, *words, False).get_opcodes():
            if kind != "equal":
                names |= dict.fromkeys(map(self.reading.tag_of, range(begin, end)))
        return {name: self.reading.tags[name] for name in names if name}


def read_sentences(path: Path) -> list[str]:
    """The lines of a file that are neither blank nor begin with "#".

    Raises HriError when it cannot be read, AuthoringError for too many sentences.
    """
    lines = enumerate(read_text(path, "file of sentences").splitlines(), start=1)
    said = [(number, line) for number, line in lines if line.strip() and line.lstrip()[0] != "#"]
    if len(said) > MOST_SENTENCES:
        what = f"more than {MOST_SENTENCES} sentences"
        raise AuthoringError(Place(path, said[MOST_SENTENCES][0]), what, "split the file")
    return [line for _, line in said]


def taken_for(
    grammar: Grammar, sentences: Sequence[str], lexicon: Lexicon, farthest: float = FARTHEST_OUTSIDE
) -> list[Taken]:
    """Those of the sentences that are not farther from one of the grammar, the nearest first.

    Each counts once; `outside` says which count. Raises HriError for a word that nobody knows to
    say.
    """
    found: list[Taken] = []
    search = _Search(grammar.graph(), lexicon)
    sentences = outside(grammar, sentences)
    for start in range(0, len(sentences), _BLOCK):
        block = sentences[start : start + _BLOCK]
        for said, (text, distance) in zip(block, search.nearest(block, farthest), strict=True):
            if reading := parse(grammar, text, grammar.spoken_rules):
                found.append(Taken(said, reading, distance))
    return sorted(found, key=lambda taken: taken.distance)


def outside(grammar: Grammar, sentences: Sequence[str]) -> list[str]:
    """The words of those sentences that the grammar does not allow, each once."""
    texts = dict.fromkeys(" ".join(normalize(sentence)) for sentence in sentences)
    return [text for text in texts if text and parse(grammar, text, grammar.spoken_rules) is None]


class _Search:
    """Looks for the nearest ways through a word graph."""

    def __init__(self, graph: WordGraph, lexicon: Lexicon) -> None:
        self._lexicon = lexicon
        self._start, self._final = graph.start, graph.final
        said = {
            number: phones_of((word,), lexicon)
            for number, word in enumerate(graph.words)
            if free_words(word) is None
        }
        said[SILENT] = np.array([], np.int32)
        labels = graph.labels.tolist()
        arcs = zip(graph.sources.tolist(), graph.targets.tolist(), labels, strict=True)
        self._arcs = [arc for arc in arcs if arc[2] in said]
        self._leaving: dict[int, list[int]] = {}
        for number, (source, _, _) in enumerate(self._arcs):
            self._leaving.setdefault(source, []).append(number)
        self._said, self._words = said, graph.words

    def nearest(self, texts: Sequence[str], farthest: float) -> Iterator[tuple[str, float]]:
        """The nearest sentence of the graph to each text, and its distance.

        The sentence is empty where none is near enough.
        """
        spoken, lengths = padded([phones_of(text.split(), self._lexicon) for text in texts])
        unlike = COSTS[:, spoken]
        tables, ways = self._followed(unlike, (farthest * lengths).astype(np.float32))
        for row, length in enumerate(lengths.tolist()):
            cost = float(tables[self._final][row, length]) if self._final in tables else math.inf
            own = unlike[:, row : row + 1, :length]
            words = self._traced(row, own, tables, ways) if cost < math.inf else []
            yield " ".join(words), cost / length

    def _followed(
        self, unlike: Table, most: NDArray[np.float32]
    ) -> tuple[dict[int, Table], dict[int, Phones]]:
        """The table of each node, and the arcs by which its costs came there.

        What costs a sentence more than its `most` is not followed and has no end.
        """
        _, count, places = unlike.shape
        tables = {self._start: np.tile(_TOO_MUCH[: places + 1], (count, 1))}
        ways: dict[int, Phones] = {}
        changed, pending = {self._start}, [self._start]
        while pending:
            node = heapq.heappop(pending)  # All before it is done, but for loops.
            changed.remove(node)
            for number in self._leaving.get(node, ()):
                _, target, label = self._arcs[number]
                costs = _behind(tables[node], self._said[label], unlike)
                if target not in tables:
                    tables[target] = np.full_like(costs, np.inf)
                    ways[target] = np.zeros(costs.shape, np.int32)
                is_less = (costs < tables[target] - _SAME) & (costs <= most[:, None])
                if is_less.any():
                    tables[target][is_less] = costs[is_less]
                    ways[target][is_less] = number
                    if target not in changed:
                        changed.add(target)
                        heapq.heappush(pending, target)
        return tables, ways

    def _traced(
        self, row: int, unlike: Table, tables: dict[int, Table], ways: dict[int, Phones]
    ) -> list[str]:
        """The words of the nearest way to the end of a sentence, which has that row in the
        tables.
        """
        words: list[str] = []
        node, end = self._final, unlike.shape[2]
        while node in ways:
            node, _, label = self._arcs[int(ways[node][row, end])]
            if label != SILENT:
                words.append(self._words[label])
                # What the word costs from each place on: the same table, read from its end.
                begin, before = _TOO_MUCH[None, : end + 1], unlike[:, :, :end][:, :, ::-1]
                costs = _behind(begin, self._said[label][::-1], before)[0, ::-1]
                end = int(np.argmin(tables[node][row, : end + 1] + costs))
        return words[::-1]


def _behind(table: Table, phones: Phones, unlike: Table) -> Table:
    """The table behind some more phones. `unlike`: how far each phone is from those of each
    sentence. [phones, sentences, places]
    """
    too_much = _TOO_MUCH[: table.shape[1]]
    for phone in phones.tolist():
        behind = table + np.float32(DROPPED)
        np.minimum(behind[:, 1:], table[:, :-1] + unlike[phone], out=behind[:, 1:])
        behind -= too_much
        table = np.minimum.accumulate(behind, axis=1) + too_much
    return table
