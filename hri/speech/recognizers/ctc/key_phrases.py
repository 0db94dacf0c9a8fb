"""Phrases among words that nobody listed: how sure they are."""

from __future__ import annotations

from hri.speech.grammar.words import free_words
from hri.speech.recognizers.ctc.confidence import confidence_among_others, phrase_fit
from hri.speech.recognizers.ctc.lattice import Path
from hri.speech.recognizers.ctc.phone_graph import Floats, Indices

LONGEST_WORD, PAUSES = 25, 25
"""Frames of 20 ms that a free word takes at most, and the pauses around several of them."""


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
