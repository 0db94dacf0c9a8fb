"""What a search leaves behind: its paths, found by walking back, the best and the nearly best."""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count
from typing import NamedTuple

import numpy as np

from hri.speech.recognizers.ctc.phone_graph import NOWHERE, Entry, Floats, Indices, PhoneGraph

_MASKS = tuple(128 >> bit for bit in range(8))
_ROOM = 256
"""Frames of results that room is made for at once."""
_ROUNDING = 0.05
"""By how much scores of one path, summed in different orders, may differ."""
MOST_STEPS = 2000
"""Words that are looked at for the sentences that are nearly as good as the best."""


class Trellis:
    """All that happened in a search, frame by frame: enough to walk back along any path."""

    def __init__(self, graph: PhoneGraph, entries: Sequence[Entry]) -> None:
        self.graph = graph
        self.frames = -1
        self._entries = _by_hub(entries)
        self._ways_into: dict[int, _Ways] = {}
        self._entered: list[bytes] = []
        self._resting: list[bytes] = []
        self._exits = np.empty((_ROOM, len(graph.exit_states)), np.float32)
        self._silence: list[float] = []
        self._groups = np.empty(len(graph.exit_groups), np.float32)

    def grow(self, states: Floats, silence: float, entered: bytes, resting: bytes) -> None:
        """A frame more: best score of each state, score of a blank; bits of states."""
        self.frames += 1
        if self.frames == len(self._exits):
            longer = np.empty((self.frames + _ROOM, self._exits.shape[1]), np.float32)
            longer[: self.frames] = self._exits
            self._exits = longer
        exits = self._exits[self.frames]
        states.take(self.graph.exit_states, out=exits, mode="clip")
        exits += self.graph.exit_weights
        self._silence.append((self._silence[-1] if self._silence else 0.0) + silence)
        self._entered.append(entered)
        self._resting.append(resting)

    def arrive(self, frame: int, out: Floats) -> None:
        """[places] Best score of being there after a number of frames: from a word, or to begin."""
        graph = self.graph
        out.fill(NOWHERE)
        if self._entries:
            out[graph.starts] = graph.start_weights + np.float32(self._silence[frame])
        np.maximum.reduceat(self._exits[frame], graph.exit_groups, out=self._groups)
        links = self._groups.take(graph.link_sources)
        links += graph.link_weights
        linked = out[: len(graph.link_groups)]
        np.maximum(linked, np.maximum.reduceat(links, graph.link_groups), out=linked)
        for hub, places, weights in self._entries:
            out[places] = np.maximum(out[places], out[hub] + weights)

    def beginning(self, place: int, frame: int) -> float:
        """Score of beginning a sentence at a place after a number of frames of silence."""
        return self._ways(place).opening + self._silence[frame]

    def ways_into(self, place: int, frame: int) -> tuple[Indices, Floats]:
        """Exits that lead into a place, and the scores of coming by them, after frames."""
        ways = self._ways(place)
        return ways.exits, self._exits[frame, ways.exits] + ways.weights

    def _ways(self, place: int) -> _Ways:
        known = self._ways_into.get(place)
        if known is None:
            known = self._ways_into[place] = self._find_ways(place)
        return known

    def _find_ways(self, place: int) -> _Ways:
        """Into the place itself, and into hubs that lead to it."""
        graph = self.graph
        before = [(place, np.float32(0.0))]
        for hub, places, weights in self._entries:
            before += [(hub, weight) for weight in weights[places == place]]
        into = [graph.exits_into(at) for at, _ in before]
        openings = [graph.start_weights[graph.starts == at] + more for at, more in before]
        weighted = [own + more for (_, own), (_, more) in zip(into, before, strict=True)]
        return _Ways(
            float(np.concatenate(openings).max(initial=NOWHERE)),
            np.concatenate([exits for exits, _ in into]),
            np.concatenate(weighted),
        )

    def entered(self, state: int, frame: int) -> bool:
        """Whether the phone of a state came from outside in the frame that made it `frame`."""
        return bool(self._entered[frame][state >> 3] & _MASKS[state & 7])

    def rests(self, state: int, frame: int) -> bool:
        """Whether the best path to a state ends in the blank after a number of frames."""
        return bool(self._resting[frame][state >> 3] & _MASKS[state & 7])


class _Ways(NamedTuple):
    """How a place is reached."""

    opening: float
    """Weight of beginning a sentence there."""
    exits: Indices
    weights: Floats
    """[exits]"""


def _by_hub(entries: Sequence[Entry]) -> list[Entry]:
    """One entry for each hub, each of its places once, by the best weight."""
    found = []
    for hub in sorted({entry.hub for entry in entries}):
        here = [entry for entry in entries if entry.hub == hub]
        places = np.concatenate([entry.places for entry in here])
        order = places.argsort(kind="stable")
        distinct, firsts = np.unique(places[order], return_index=True)
        weights = np.concatenate([entry.weights for entry in here])[order]
        found.append(Entry(hub, distinct, np.maximum.reduceat(weights, firsts)))
    return found


@dataclass(frozen=True, slots=True)
class WordSpan:
    """A word of a path, or a part of it."""

    place: int
    """Place of the graph where it began."""
    start: int
    """Frames before its first phone."""
    end: int
    """Frames up to its end, with the blanks after its last phone."""
    states: tuple[int, ...]
    """[end - start] The state of each frame; -1 - state for the blank after it."""


@dataclass(frozen=True, slots=True)
class Path:
    """A sentence: its words in order."""

    score: float
    words: tuple[str, ...]
    spans: tuple[WordSpan, ...]


class Walk:
    """Finds the paths of a search, from their ends to their beginnings."""

    def __init__(self, trellis: Trellis) -> None:
        self._trellis = trellis
        self._graph = trellis.graph
        self._doubled = set(trellis.graph.doubled.tolist())
        self._known: dict[tuple[int, int], WordSpan] = {}

    def span(self, state: int, end: int) -> WordSpan:
        """The best way to be in a state after `end` frames, back to the beginning of the word."""
        key = (state, end)
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = self._back(state, end)
        return known

    def _back(self, state: int, end: int) -> WordSpan:
        trellis, parents, size = self._trellis, self._graph.parents, self._graph.size
        visited: list[int] = []
        frame = end
        rests = trellis.rests(state, frame)
        while True:
            frame -= 1
            if rests:
                visited.append(-1 - state)
                rests = trellis.rests(state, frame)
                continue
            visited.append(state)
            if not trellis.entered(state, frame + 1):
                continue
            parent = int(parents[state])
            if parent >= size:
                return WordSpan(parent - size, frame, end, tuple(reversed(visited)))
            rests = state in self._doubled or trellis.rests(parent, frame)
            state = parent

    def begun(self, state: int, score: float) -> Path:
        """The best path to a state now, with the word that it is in where one ends there."""
        frame = self._trellis.frames
        ending = np.flatnonzero(self._graph.exit_states == state)
        span = self.span(state, frame)
        rest = _Rest(int(ending[0]), span, None) if len(ending) else None
        while True:
            exits, scores = self._trellis.ways_into(span.place, span.start)
            begin = self._trellis.beginning(span.place, span.start)
            if not len(exits) or begin >= scores.max():
                return _path(self._graph, score, rest)
            exit = int(exits[scores.argmax()])
            span = self.span(int(self._graph.exit_states[exit]), span.start)
            rest = _Rest(exit, span, rest)

    def sentences(self, most: int, beam: float) -> list[Path]:
        """The best path, and the best of each other sequence of words, best first.

        At most `most`, and none whose score is more than `beam` below the best. Empty when no
        sentence fits. A best-first search from the end; since the scores of the search itself
        say what the rest will cost, it hardly looks at anything that it does not return.
        """
        trellis, graph = self._trellis, self._graph
        found: dict[tuple[str, ...], Path] = {}
        order = count()
        # (-score, order, exit or None at the beginning, frame, what follows)
        waiting: list[tuple[float, int, int | None, int, _Rest | None]] = []

        def look(place: int, frame: int, rest_score: float, rest: _Rest | None) -> None:
            begin = trellis.beginning(place, frame) + rest_score
            if rest is not None and begin > floor:
                heapq.heappush(waiting, (-begin, next(order), None, frame, rest))
            exits, scores = trellis.ways_into(place, frame)
            scores = scores + np.float32(rest_score)
            near = np.flatnonzero(scores > floor)
            if len(near) > most:
                near = near[np.argpartition(-scores[near], most)[:most]]
            for exit, score in zip(exits[near].tolist(), scores[near].tolist(), strict=True):
                heapq.heappush(waiting, (-score, next(order), exit, frame, rest))

        floor = float(NOWHERE) / 2
        look(graph.final, trellis.frames, 0.0, None)
        if waiting:
            floor = max(floor, -waiting[0][0] - beam - _ROUNDING)
        for _ in range(MOST_STEPS):
            if not waiting or len(found) == most:
                break
            negative, _, exit, frame, rest = heapq.heappop(waiting)
            score = -negative
            if exit is None:
                path = _path(graph, score, rest)
                found.setdefault(path.words, path)
                continue
            span = self.span(int(graph.exit_states[exit]), frame)
            come = self._score_at(span.place, span.start)
            look(span.place, span.start, score - come, _Rest(exit, span, rest))
        return list(found.values())

    def _score_at(self, place: int, frame: int) -> float:
        _, scores = self._trellis.ways_into(place, frame)
        return max(self._trellis.beginning(place, frame), float(scores.max(initial=NOWHERE)))


@dataclass(frozen=True, slots=True)
class _Rest:
    """A path from some word to the end."""

    exit: int
    span: WordSpan
    rest: _Rest | None


def _path(graph: PhoneGraph, score: float, rest: _Rest | None) -> Path:
    words: list[str] = []
    spans: list[WordSpan] = []
    while rest is not None:
        words.append(graph.words[graph.exit_words[rest.exit]])
        spans.append(rest.span)
        rest = rest.rest
    return Path(score, tuple(words), tuple(spans))
