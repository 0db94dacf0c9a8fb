"""Which of the sentences that fit best was said."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.speech.grammar.words import free_words, slot_name
from hri.speech.recognizers.ctc.classes import BLANK
from hri.speech.recognizers.ctc.lattice import Path, Walk
from hri.speech.recognizers.ctc.likelihood import likelihoods
from hri.speech.recognizers.ctc.phone_graph import Floats, Pronouncing
from hri.speech.recognizers.ctc.search import Search

MOST_REPORTED = 8
"""Sentences that are reported: the best and its alternatives."""
MOST_COMPARED = 24
"""Sentences that are compared by all ways to say them: those with the best single ways.

In babble the right one is often not among the first eight of them: of 150 orders 6 dB above it,
8, 16, 24 and 32 decode 74, 76, 77 and 77 % right.
"""
BEAM = 12.0
"""Natural log; sentences whose best way is worse than the best by more are dropped."""

WHOLE = 4.0
"""Natural log: how much worse a sentence may be than the same one among free words: a breath before
it or behind it is not a word."""

AS_GOOD = 1.5
"""Natural log: how much worse listed words behind a free slot may be than the slot to the end:
"please" is not spelled by its sound."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A sentence that may have been said."""

    path: Path
    score: float
    """Natural log, of the grammar's weights and of all ways to say it; the higher, the likelier."""


def ranked(search: Search, scores: Floats, lexicon: Pronouncing) -> list[Candidate]:
    """The sentences that fit a whole piece of speech, the likeliest first; none where none fits.

    The search has advanced by the `scores` [frames, classes].
    """
    paths = Walk(search.trellis).sentences(MOST_COMPARED, BEAM)
    if not paths:
        return []
    sums = likelihoods(scores, [path.words for path in paths], lexicon)
    phones = search.graph.phones
    found = [
        Candidate(path, path.score - _along(path, scores, phones) + float(total))
        for path, total in zip(paths, sums, strict=True)
    ]
    best = sorted(found, key=lambda candidate: -candidate.score)[:MOST_REPORTED]
    return _end_first(best) if slot_name(best[0].path.words[-1]) else _whole_first(best)


def _whole_first(found: list[Candidate]) -> list[Candidate]:
    """Candidates, the best first; where that is near to the same sentence without free words, that
    one instead of all that have such words around it.
    """
    best = found[0]
    listed = _listed(best)
    if len(listed) == len(best.path.words):
        return found
    near = (one for one in found if one.path.words == listed and one.score > best.score - WHOLE)
    whole = next(near, None)
    if whole is None:
        return found
    return [whole, *(one for one in found if _listed(one) != listed)]


def _end_first(found: list[Candidate]) -> list[Candidate]:
    """Candidates, of which the best ends with a free slot; where one that ends with listed words
    behind it is as good, that one instead.
    """
    best, *others = found
    count = len(best.path.words)
    ended = [
        one
        for one in others
        if one.path.words[:count] == best.path.words and one.score > best.score - AS_GOOD
    ]
    if not ended:
        return found
    return [ended[0], *(one for one in others if one is not ended[0])]


def _listed(candidate: Candidate) -> tuple[str, ...]:
    return tuple(word for word in candidate.path.words if free_words(word) is None)


def _along(path: Path, scores: Floats, phones: NDArray[np.integer]) -> float:
    """What scores [frames, classes] add up to along a path, without the grammar's weights."""
    classes = np.full(len(scores), BLANK)
    for span in path.spans:
        states = np.array(span.states)
        classes[span.start : span.end] = np.where(states >= 0, phones[states], BLANK)
    return float(scores[np.arange(len(scores)), classes].sum(dtype=np.float64))
