"""A grammar as arrays of phones: what the search walks through, one step a frame.

From every place of the grammar where words begin grows a tree of their pronunciations, so that
words that begin alike share their states, and a list of ten thousand names stays small.
"""

from __future__ import annotations

import math
from collections import defaultdict, deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.hal.word_graph import WordGraph
from hri.speech.grammar.words import free_words
from hri.speech.recognizers.ctc.classes import CLASSES, FREE

Indices = NDArray[np.intp]
Floats = NDArray[np.float32]

NOWHERE = np.float32(-1e30)
"""Score of what cannot be."""
MOST_STATES = 2_000_000
"""States, exits or links of a graph; a grammar that needs more is refused (a frame of the search
would take 20 ms)."""
LEAST_FREE = 5
"""Frames of a free word, 20 ms each."""
EXPECTED = 4.0
"""Natural log: how much likelier the sentences of an expected rule are. Of 129 ways to answer by
three voices, 125 clean and 109 at 12 dB of babble are understood with it, 122 and 98 without."""
_CLASS_OF = {name: index for index, name in enumerate(CLASSES)}


class Pronouncing(Protocol):
    """What knows how words sound (`hri.speech.pronunciation.lexicon.Lexicon` is one)."""

    def pronunciations(self, word: str) -> Sequence[Sequence[str]]: ...


class Entry(NamedTuple):
    """Where the own words of a public rule begin."""

    hub: int
    """The place that leads there."""
    places: Indices
    weights: Floats
    """[places] Of getting there from the hub."""


@dataclass(frozen=True, eq=False)
class PhoneGraph:
    """States 0..size-1 are phones of words; places are nodes of the grammar where words begin.

    The predecessor of state s is state `parents[s]`, or place `parents[s] - size` for the first
    phone of a word. Exits are the ends of words, in groups by the node of the grammar they lead
    to; links lead from those groups over silent arcs to places, in groups by place. Groups are
    given by the index of their first member. The last linked place is the end of sentences.

    Hubs are places, too: the start, and those behind what may be said before many rules. From them
    the entries lead to the own words of each public rule.
    """

    words: tuple[str, ...]
    size: int
    phones: Indices
    """[states] class of the network, or FREE."""
    parents: Indices
    """[states]"""
    doubled: Indices
    """States that repeat the phone of their parent: CTC wants a blank between the two."""
    exit_states: Indices
    exit_words: Indices
    exit_weights: Floats
    exit_groups: Indices
    link_sources: Indices
    """[links] group of exits."""
    link_weights: Floats
    link_groups: Indices
    """[linked places] The linked places come first."""
    places: int
    starts: Indices
    """The places that need nothing said before: hubs, and where words begin that lead to some."""
    start_weights: Floats
    """[starts]"""
    entries: Mapping[str, Entry]
    """Of the public rules."""
    expected: frozenset[int]
    """Places where expected rules begin: EXPECTED is in their weights."""
    _into: dict[int, tuple[Indices, Floats]] = field(default_factory=dict, repr=False)

    @property
    def final(self) -> int:
        """Place where sentences end."""
        return len(self.link_groups) - 1

    def head_start(self, places: Iterable[int]) -> float:
        """Natural log: what a sentence is worth whose words begin at places, because its rule is
        expected.
        """
        return 0.0 if self.expected.isdisjoint(places) else EXPECTED

    def exits_into(self, place: int) -> tuple[Indices, Floats]:
        """Exits that lead into a place, each with the weight of its link."""
        known = self._into.get(place)
        if known is None:
            known = self._into[place] = self._find_exits(place)
        return known

    def _find_exits(self, place: int) -> tuple[Indices, Floats]:
        first, end = _range(self.link_groups, place, len(self.link_sources))
        exits: list[Indices] = [np.empty(0, np.intp)]
        weights: list[Floats] = [np.empty(0, np.float32)]
        for link in range(first, end):
            group = int(self.link_sources[link])
            members = np.arange(*_range(self.exit_groups, group, len(self.exit_states)))
            exits.append(members)
            weights.append(np.full(len(members), self.link_weights[link], np.float32))
        return np.concatenate(exits), np.concatenate(weights)


def compile(graph: WordGraph, lexicon: Pronouncing) -> PhoneGraph:
    """The states of all pronunciations of a grammar's words.

    Raises HriError for a word that nobody can pronounce and for a grammar that is too large.
    """
    spoken = graph.labels >= 0
    begins = set(graph.sources[spoken].tolist())
    leads = _leads(graph)
    hubs = {graph.start, *(hub for hub, _ in leads.values())}
    reach = _reach(graph, begins | {graph.final, *hubs})
    arrived = sorted(set(graph.targets[spoken].tolist()))
    linked = sorted({place for node in arrived for place in reach[node]} - {graph.final})
    order = [*linked, graph.final, *sorted({*begins, *hubs} - set(linked))]
    place_of = {node: index for index, node in enumerate(order)}

    forest = _Forest()
    exits = _grow(forest, graph, lexicon, place_of, {node: i for i, node in enumerate(arrived)})
    size = len(forest.phones)
    parents = np.array(forest.parents, np.intp)
    parents[parents < 0] = size - 1 - parents[parents < 0]
    phones = np.array(forest.phones, np.intp)
    inner = np.flatnonzero(parents < size)

    if not exits:
        raise HriError("the grammar has no words - write a public rule with something to say")
    exits.sort()
    exit_groups, exit_states, exit_words, exit_weights = _columns(exits)
    links = sorted(
        (place_of[node], group, weight)
        for group, source in enumerate(arrived)
        for node, weight in reach[source].items()
    )
    link_places, link_sources, link_weights = _columns(links)
    starts, start_weights = _opened(reach[graph.start], place_of)
    entries = {}
    for rule, (hub, weight) in leads.items():
        places, weights = _opened(reach[graph.entries[rule]], place_of)
        if rule in graph.expected:
            weight += EXPECTED
        entries[rule] = Entry(place_of[hub], places, weights + np.float32(weight))
    return PhoneGraph(
        words=graph.words,
        size=size,
        phones=phones,
        parents=parents,
        doubled=inner[(phones[inner] == phones[parents[inner]]) & (phones[inner] != FREE)],
        exit_states=exit_states.astype(np.intp),
        exit_words=exit_words.astype(np.intp),
        exit_weights=exit_weights.astype(np.float32),
        exit_groups=_firsts(exit_groups),
        link_sources=link_sources.astype(np.intp),
        link_weights=link_weights.astype(np.float32),
        link_groups=_firsts(link_places),
        places=len(order),
        starts=starts,
        start_weights=start_weights,
        entries=entries,
        expected=frozenset(
            place for rule in graph.expected for place in entries[rule].places.tolist()
        ),
    )


def _leads(graph: WordGraph) -> dict[str, tuple[int, float]]:
    """For each public rule, the hub that leads to its own words, and the weight of doing so.

    Which rules count changes from sentence to sentence, so that all are equally likely.
    """
    silent = np.flatnonzero(graph.labels < 0)
    into = {
        target: (source, weight + math.log(len(graph.entries)))
        for source, target, weight in zip(
            graph.sources[silent].tolist(),
            graph.targets[silent].tolist(),
            graph.weights[silent].tolist(),
            strict=True,
        )
    }
    return {rule: into.get(node, (graph.start, 0.0)) for rule, node in graph.entries.items()}


class _Forest:
    """Trees of phones; the roots hang from places, place p as parent -1 - p."""

    def __init__(self) -> None:
        self.phones: list[int] = []
        self.parents: list[int] = []
        self._children: dict[tuple[int, int], int] = {}

    def grow(self, place: int, phones: Sequence[int]) -> int:
        """Lay a word into the tree of a place; the state of its last phone."""
        state = -1 - place
        for phone in phones:
            key = (state, phone)
            child = self._children.get(key)
            if child is None:
                child = self._children[key] = len(self.phones)
                self.phones.append(phone)
                self.parents.append(state)
            state = child
        return state


def _grow(
    forest: _Forest,
    graph: WordGraph,
    lexicon: Pronouncing,
    place_of: Mapping[int, int],
    group_of: Mapping[int, int],
) -> list[tuple[int, int, int, float]]:
    """Lay all words into the forest; (group, state, word, weight) of every way to end one."""
    sounds: dict[int, list[list[int]]] = {}
    exits: list[tuple[int, int, int, float]] = []
    arcs = zip(
        graph.sources.tolist(),
        graph.targets.tolist(),
        graph.labels.tolist(),
        graph.weights.tolist(),
        strict=True,
    )
    for source, target, label, weight in arcs:
        if label < 0:
            continue
        if label not in sounds:
            sounds[label] = _sounds_of(graph.words[label], lexicon)
        for phones in sounds[label]:
            state = forest.grow(place_of[source], phones)
            exits.append((group_of[target], state, label, weight))
        if len(exits) > MOST_STATES or len(forest.phones) > MOST_STATES:
            raise _too_large()
    return exits


def _sounds_of(word: str, lexicon: Pronouncing) -> list[list[int]]:
    """The classes of each pronunciation of a word, or of free words."""
    if (free := free_words(word)) is not None:
        return [[FREE] * (free[0] * LEAST_FREE)]
    return [[_CLASS_OF[phone] for phone in phones] for phones in lexicon.pronunciations(word)]


def _reach(graph: WordGraph, wanted: set[int]) -> dict[int, dict[int, float]]:
    """For every node, which wanted nodes silent arcs lead to (itself too), by the best weight; but
    not from a hub on to the rules.
    """
    begins = np.isin(graph.targets, list(graph.entries.values()))
    silent = np.flatnonzero((graph.labels < 0) & ~begins)
    onward: dict[int, list[tuple[int, float]]] = defaultdict(list)
    before: dict[int, list[int]] = defaultdict(list)
    for source, target, weight in zip(
        graph.sources[silent].tolist(),
        graph.targets[silent].tolist(),
        graph.weights[silent].tolist(),
        strict=True,
    ):
        onward[source].append((target, weight))
        before[target].append(source)
    reach = {node: ({node: 0.0} if node in wanted else {}) for node in range(graph.size)}
    missing = {node: len(targets) for node, targets in onward.items()}
    ready = deque(node for node in range(graph.size) if node not in missing)
    links = 0
    while ready:
        node = ready.popleft()
        best = reach[node]
        for target, weight in onward[node]:
            for place, rest in reach[target].items():
                best[place] = max(best.get(place, -np.inf), weight + rest)
        links += len(best)
        if links > MOST_STATES:
            raise _too_large()
        for source in before[node]:
            missing[source] -= 1
            if missing[source] == 0:
                ready.append(source)
    return reach


def _too_large() -> HriError:
    return HriError(
        f"the grammar needs more than {MOST_STATES} states of the recognizer"
        " - have fewer words that may follow each other in fewer places"
    )


def _columns(rows: Sequence[tuple[float, ...]]) -> list[NDArray[Any]]:
    return [np.array(column) for column in zip(*rows, strict=True)]


def _firsts(groups: NDArray[Any]) -> Indices:
    """Index of the first member of each group in a sorted array of group numbers."""
    return np.flatnonzero(np.diff(groups, prepend=-1)).astype(np.intp)


def _range(firsts: Indices, group: int, size: int) -> tuple[int, int]:
    """First member of a group and the one after its last; nothing for one that is not there."""
    if group >= len(firsts):
        return 0, 0
    end = int(firsts[group + 1]) if group + 1 < len(firsts) else size
    return int(firsts[group]), end


def _opened(reached: Mapping[int, float], place_of: Mapping[int, int]) -> tuple[Indices, Floats]:
    """The places of nodes, and their weights."""
    places = [place_of[node] for node in reached]
    return np.array(places, np.intp), np.array(list(reached.values()), np.float32)
