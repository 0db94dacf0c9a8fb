"""How likely some sentences are, over all ways to say them in a sound.

The search finds the best way to say a sentence, one phone in each frame. In noise the sound does
not show where phones begin, and many ways are as good as the best: their sum (A. Graves et al.,
"Connectionist temporal classification", ICML 2006, section 4.1) decides between sentences better.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hri.hal.word_graph import WordGraph
from hri.speech.recognizers.ctc.classes import BLANK
from hri.speech.recognizers.ctc.phone_graph import Floats, PhoneGraph, Pronouncing, compile

Doubles = NDArray[np.float64]

NEVER = -1e30
"""Natural log of what cannot be."""


def likelihoods(
    scores: Floats, sentences: Sequence[Sequence[str]], lexicon: Pronouncing
) -> Doubles:
    """Natural log of the sum over all ways to say each sentence; NEVER for one that is too long.

    `scores` [frames, classes] are what the search adds up. Raises HriError for a word that nobody
    can pronounce.
    """
    graph = compile(_side_by_side(sentences), lexicon)
    # The ends of the sentences have the highest numbers, so the last groups of exits lead there.
    return _along_all(graph, scores)[-len(sentences) :]


def _along_all(graph: PhoneGraph, scores: Floats) -> Doubles:
    """Natural log of the sum of all paths into each group of exits.

    As `Search` goes on from frame to frame, but adding up, and probabilities for their logarithms.
    """
    size, linked = graph.size, len(graph.link_groups)
    link_weights, exit_weights = np.exp(graph.link_weights), np.exp(graph.exit_weights)
    doubled_parents = graph.parents[graph.doubled]
    opening = np.zeros(graph.places)
    for entry in graph.entries.values():
        opening[entry.places] = np.exp(entry.weights)
    phone, blank, groups = np.zeros(size), np.zeros(size), np.zeros(len(graph.exit_groups))
    onward = np.concatenate([np.zeros(size), opening])
    scale = 0.0
    for row in np.exp(scores.astype(np.float64)):
        coming = onward.take(graph.parents)
        coming[graph.doubled] = blank.take(doubled_parents)
        blank = onward[:size] * row[BLANK]
        phone = (phone + coming) * row.take(graph.phones)
        opening = opening * row[BLANK]
        states = phone + blank
        exits = states.take(graph.exit_states) * exit_weights
        groups = np.add.reduceat(exits, graph.exit_groups)
        links = groups.take(graph.link_sources) * link_weights
        arrived = opening.copy()
        arrived[:linked] += np.add.reduceat(links, graph.link_groups)
        most = max(float(states.max()), float(arrived.max()))
        scale += float(np.log(most))
        phone, blank, opening, groups = phone / most, blank / most, opening / most, groups / most
        onward = np.concatenate([states, arrived]) / most
    with np.errstate(divide="ignore"):
        return np.maximum(np.log(groups) + scale, NEVER)


def _side_by_side(sentences: Sequence[Sequence[str]]) -> WordGraph:
    """Each sentence from a common start to its own end, and silently to a common end."""
    words = tuple(dict.fromkeys(word for sentence in sentences for word in sentence))
    number_of = {word: number for number, word in enumerate(words)}
    inner = sum(len(sentence) - 1 for sentence in sentences)
    ends = [2 + inner + number for number in range(len(sentences))]
    arcs: list[tuple[int, int, int]] = []
    free = 2
    for sentence, end in zip(sentences, ends, strict=True):
        place = 0
        for word in sentence[:-1]:
            arcs.append((place, free, number_of[word]))
            place, free = free, free + 1
        arcs += [(place, end, number_of[sentence[-1]]), (end, 1, -1)]
    sources, targets, labels = np.array(sorted(arcs), np.int32).T
    return WordGraph(
        size=2 + inner + len(sentences),
        start=0,
        final=1,
        sources=sources,
        targets=targets,
        labels=labels,
        weights=np.zeros(len(arcs), np.float32),
        words=words,
        entries={"any": 0},
    )
