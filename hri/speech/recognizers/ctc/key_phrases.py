"""Phrases among words that nobody listed: how sure they are, and what else those words hold."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from hri.speech.grammar.words import free_words
from hri.speech.recognizers.ctc.confidence import confidence_among_others, phrase_fit, scores_of
from hri.speech.recognizers.ctc.lattice import Path, Walk
from hri.speech.recognizers.ctc.phone_graph import Floats, Indices
from hri.speech.recognizers.ctc.ranking import Candidate
from hri.speech.recognizers.ctc.search import Search

LONGEST_WORD, PAUSES = 25, 25
"""Frames of 20 ms that a free word takes at most, and the pauses around several of them."""
ACCEPTED = 0.5
"""Confidence from which a second phrase counts as said."""


@dataclass(frozen=True, slots=True)
class Beside:
    """A phrase that free words of a sentence hold."""

    path: Path
    confidence: float
    """0 to 1: the chance that it was said."""
    whole: tuple[str, ...]
    """The sentence with it where those free words were."""


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
) -> Iterator[Beside]:
    """Phrases that the free words of the best path hold. `search` is used for it."""
    for place, (word, span) in enumerate(zip(best.words, best.spans, strict=True)):
        if free_words(word) is None:
            continue
        part = log_probabilities[span.start : span.end]
        search.begin(rules)
        search.advance(scores_of(part))
        for path in Walk(search.trellis).sentences(1, 0.0):
            sure = confidence_in_phrase(path, part, search.graph.phones, noise)
            if _listed(path) and sure >= ACCEPTED:
                whole = (*best.words[:place], *path.words, *best.words[place + 1 :])
                yield Beside(path, sure, whole)


def joined(
    found: list[Candidate], sure: float, beside: list[Beside]
) -> tuple[list[Candidate], float, list[Beside]]:
    """The sentences again, the confidence in the likeliest, and the phrases said besides.

    Two phrases that make a sentence of the grammar are that sentence: "monday" and "at eight" among
    other words are "monday at eight", though the whole sounds unlike it. Else a phrase counts that
    has as many listed words as the likeliest at least. `found` are the sentences, the likeliest
    first, and `sure` is the confidence in that one.
    """
    for one in beside:
        whole = next((other for other in found if other.path.words == one.whole), None)
        if whole is not None:
            rest = [other for other in found if not set(_listed(other.path)) <= set(one.whole)]
            found, sure = [whole, *rest], min(sure, one.confidence)
            beside = [other for other in beside if other is not one]
            break
    least = len(_listed(found[0].path))
    return found, sure, [one for one in beside if len(_listed(one.path)) >= least]


def _listed(path: Path) -> list[str]:
    return [word for word in path.words if free_words(word) is None]
