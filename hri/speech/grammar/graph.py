"""The word graph of a grammar: its automaton without meaning, small enough to search in sound.

Silent arcs that say nothing are taken out, beginnings and endings that two ways share are merged.
What a sentence is worth, the product of the weights on its best way, stays as it was or grows
where two ways of the same words are merged.

The meaning is found in the words afterwards, by `matching.parse`. Arcs that kept it could not be
merged: a search of 10,000 names would take 19 ms instead of 12, and to parse one takes 0.02 ms.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections import Counter

import numpy as np

from hri.core.collection import without_collection
from hri.hal.word_graph import SILENT, WordGraph
from hri.speech.grammar.automaton import FINAL, START, Automaton
from hri.speech.grammar.words import free_words

FREE_COST = 7.0
"""Natural log: what free words in a row cost, or whole commands would be taken for them."""

Arc = tuple[str | None, int, float]
"""Word, target and weight."""


def word_graph(automaton: Automaton) -> WordGraph:
    """The sentences of an automaton as an engine wants them."""
    with without_collection():
        return _Reduction(automaton).graph()


class _Reduction:
    """The arcs of each node, which shrink step by step."""

    def __init__(self, automaton: Automaton) -> None:
        self._entries = automaton.entries
        arcs = list(zip(automaton.words, automaton.targets, automaton.weights, strict=True))
        first = automaton.first
        self._leaving = [arcs[begin:end] for begin, end in itertools.pairwise(first)]
        begins = {*automaton.entries.values()}
        hubs = [
            node
            for node, leaving in enumerate(self._leaving)
            if any(target in begins for _, target, _ in leaving)
        ]
        self._kept = {START, FINAL, *begins, *hubs}
        """Nodes that stay themselves."""
        order = self._order()
        self._skip_silence(order)
        self._pull_back(order)
        self._merge_beginnings()
        self._merge_endings(self._order())

    def _skip_silence(self, order: list[int]) -> None:
        """A node with only one silent arc is the node behind that arc."""
        instead = list(range(len(self._leaving)))
        for node in reversed(order):
            leaving = self._leaving[node]
            if node not in self._kept and len(leaving) == 1 and leaving[0][0] is None:
                instead[node] = instead[leaving[0][1]]
                self._leaving[node] = []
        for node in order:
            while instead[instead[node]] != instead[node]:  # Loops are not in order.
                instead[node] = instead[instead[node]]
        self._redirect(instead, order)

    def _pull_back(self, order: list[int]) -> None:
        """A node that only one silent arc leads to is the node before that arc."""
        entered = self._entered()
        for node in reversed(order):
            pulled: list[Arc] = []
            for word, target, weight in self._leaving[node]:
                if word is None and entered[target] == 1 and target not in self._kept:
                    pulled += _scaled(self._leaving[target], weight)
                    self._leaving[target] = []
                else:
                    pulled.append((word, target, weight))
            self._leaving[node] = pulled

    def _merge_beginnings(self) -> None:
        """Two arcs of a node with the same word become one where nothing else leads behind them."""
        entered = self._entered()
        seen, pending = {START}, [START]
        while pending:
            node = pending.pop()
            alike: dict[tuple[str | None, int], list[Arc]] = {}
            for arc in self._leaving[node]:
                word, target, _ = arc
                is_free = entered[target] == 1 and target not in self._kept
                alike.setdefault((word, -1 if is_free else target), []).append(arc)
            self._leaving[node] = [self._merged(arcs) for arcs in alike.values()]
            further = {target for _, target, _ in self._leaving[node]} - seen
            seen |= further
            pending += sorted(further)

    def _merged(self, arcs: list[Arc]) -> Arc:
        """One arc for those of one word; what leaves their targets leaves the first of these."""
        word, kept, _ = arcs[0]
        share = functools.reduce(_either, (weight for _, _, weight in arcs))
        if any(target != kept for _, target, _ in arcs):
            leaving: list[Arc] = []
            for _, target, weight in arcs:
                leaving += _scaled(self._leaving[target], weight - share)
                self._leaving[target] = []
            self._leaving[kept] = leaving
        return word, kept, share

    def _merge_endings(self, order: list[int]) -> None:
        """Nodes that the same arcs leave are one."""
        instead = list(range(len(self._leaving)))
        same: dict[frozenset[Arc], int] = {}
        for node in reversed(order):
            arcs = _united(
                [(word, instead[to], weight) for word, to, weight in self._leaving[node]]
            )
            self._leaving[node] = arcs
            if node not in self._kept:
                key = frozenset((word, to, round(weight, 5)) for word, to, weight in arcs)
                instead[node] = same.setdefault(key, node)
        self._redirect(instead, order)

    def _redirect(self, instead: list[int], order: list[int]) -> None:
        """Let every arc lead to the node that stands instead of its target."""
        for node in order:
            self._leaving[node] = _united(
                [(word, instead[to], weight) for word, to, weight in self._leaving[node]]
            )

    def _entered(self) -> Counter[int]:
        """How many arcs lead to each node."""
        return Counter(target for leaving in self._leaving for _, target, _ in leaving)

    def _order(self) -> list[int]:
        """The nodes that can be reached, each before those behind it wherever there is no loop."""
        done: list[int] = []
        seen = {START}
        stack = [(START, iter(self._leaving[START]))]
        while stack:
            node, arcs = stack[-1]
            for _, target, _ in arcs:
                if target not in seen:
                    seen.add(target)
                    stack.append((target, iter(self._leaving[target])))
                    break
            else:
                stack.pop()
                done.append(node)
        return done[::-1]

    def graph(self) -> WordGraph:
        order = self._order()
        names = {node: number for number, node in enumerate(order)}
        names.setdefault(FINAL, len(names))
        arcs = [
            (names[node], names[target], word, min(weight, 0.0) - _cost(word))
            for node in order
            for word, target, weight in self._leaving[node]
        ]
        words = tuple(sorted({word for _, _, word, _ in arcs if word is not None}))
        numbers: dict[str | None, int] = {word: number for number, word in enumerate(words)}
        numbers[None] = SILENT
        return WordGraph(
            size=len(names),
            start=names[START],
            final=names[FINAL],
            sources=np.array([source for source, _, _, _ in arcs], np.int32),
            targets=np.array([target for _, target, _, _ in arcs], np.int32),
            labels=np.array([numbers[word] for _, _, word, _ in arcs], np.int32),
            weights=np.array([weight for _, _, _, weight in arcs], np.float32),
            words=words,
            entries={rule: names[node] for rule, node in self._entries.items()},
        )


def _cost(word: str | None) -> float:
    return FREE_COST if word is not None and free_words(word) is not None else 0.0


def _scaled(arcs: list[Arc], share: float) -> list[Arc]:
    """The arcs when those before them are worth `share` more, in logarithms."""
    return [(word, target, weight + share) for word, target, weight in arcs]


def _united(arcs: list[Arc]) -> list[Arc]:
    """The arcs of a node, those with the same word and target made one."""
    if len(arcs) < 2:
        return arcs
    merged: dict[tuple[str | None, int], float] = {}
    for word, target, weight in arcs:
        before = merged.get((word, target))
        merged[word, target] = weight if before is None else _either(before, weight)
    return [(word, target, weight) for (word, target), weight in merged.items()]


def _either(one: float, other: float) -> float:
    """The logarithm of the sum of two shares."""
    return max(one, other) + math.log1p(math.exp(-abs(one - other)))
