"""Phrases among words that nobody listed: how sure they are, and what else those words hold."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from hri.hal.recognizer import Alternative
from hri.speech.grammar.words import free_words, said
from hri.speech.recognizers.ctc.confidence import confidence_among_others, phrase_fit, scores_of
from hri.speech.recognizers.ctc.lattice import Path, Walk
from hri.speech.recognizers.ctc.phone_graph import Floats, Indices
from hri.speech.recognizers.ctc.search import Search

LONGEST_WORD, PAUSES = 25, 25
"""Frames of 20 ms that a free word takes at most, and the pauses around several of them."""
ACCEPTED = 0.5
"""Confidence from which a second phrase counts as said."""


def has_free(path: Path) -> bool:
    """Whether any words of a sentence are free."""
    return any(free_words(word) is not None for word in path.words)


def is_too_long(path: Path) -> bool:
    """Whether free words last longer than as many as there may be."""
    return any(
        (free := free_words(word)) is not None
        and span.end - span.start > free[1] * LONGEST_WORD + PAUSES
        for word, span in zip(path.words, path.spans, strict=True)
    )


def confidence_in_phrase(
    path: Path, log_probabilities: Floats, phones: Indices, noise: float
) -> float:
    """0 to 1: the chance that the listed words of a path were said among others.

    `log_probabilities` [frames, classes] are those of the network, `phones` the class of each state
    of the graph; `noise` is how noisy it was, 0 to 1.
    """
    if is_too_long(path):
        return 0.0
    return confidence_among_others(phrase_fit(path, log_probabilities, phones), noise)


def said_beside(
    best: Path,
    search: Search,
    log_probabilities: Floats,
    rules: Collection[str] | None,
    noise: float,
) -> Iterator[Alternative]:
    """Phrases that the free words of the best path hold, of as many listed words as its own at
    least, and of one.

    `search` is used for it.
    """
    least = max(1, _listed_words(best))
    for word, span in zip(best.words, best.spans, strict=True):
        if free_words(word) is None:
            continue
        part = log_probabilities[span.start : span.end]
        search.begin(rules)
        search.advance(scores_of(part))
        for path in Walk(search.trellis).sentences(1, 0.0):
            sure = confidence_in_phrase(path, part, search.graph.phones, noise)
            if _listed_words(path) >= least and sure >= ACCEPTED:
                yield Alternative(said(path.words), sure)


def _listed_words(path: Path) -> int:
    return sum(free_words(word) is None for word in path.words)
