"""Small graphs of words, their pronunciations, and random sound, for tests of the search."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.hal.word_graph import WordGraph
from hri.speech.recognizers.ctc.classes import CLASSES

SOUNDS: Mapping[str, tuple[tuple[str, ...], ...]] = {
    "go": (("G", "OW"),),
    "goal": (("G", "OW", "L"),),
    "no": (("N", "OW"),),
    "a": (("AH",), ("EY",)),
    "add": (("AE", "D", "D"),),
    "gogo": (("G", "OW", "G", "OW"),),
}
WORDS = tuple(SOUNDS)
HEARD = [CLASSES.index(name) for name in ("blank", "G", "OW", "L", "N", "AH", "EY", "AE", "D")]


class Sounds:
    """The lexicon of these words."""

    def pronunciations(self, word: str) -> tuple[tuple[str, ...], ...]:
        if word not in SOUNDS:
            raise HriError(f'nobody knows how "{word}" sounds')
        return SOUNDS[word]


def word_graph(
    arcs: list[tuple[int, int, int, float]], size: int, entries: Mapping[str, int] = {"all": 0}
) -> WordGraph:
    """Arcs (source, target, word or -1, weight); node 0 is start, the last one final."""
    sources, targets, labels, weights = zip(*sorted(arcs), strict=True)
    return WordGraph(
        size=size,
        start=0,
        final=size - 1,
        sources=np.array(sources, np.int32),
        targets=np.array(targets, np.int32),
        labels=np.array(labels, np.int32),
        weights=np.array(weights, np.float32),
        words=WORDS,
        entries=entries,
    )


def sentence_graph(*sentences: str) -> WordGraph:
    """A graph of these sentences, side by side."""
    arcs = [(0, 1, -1, 0.0)]
    size = 2 + sum(len(sentence.split()) - 1 for sentence in sentences) + 1
    node = 2
    for sentence in sentences:
        source, *rest = 1, *sentence.split()
        for index, word in enumerate(rest):
            target = size - 1 if index == len(rest) - 1 else node
            arcs.append((source, target, WORDS.index(word), 0.0))
            source = target
            node += target == node
    return word_graph(arcs, size)


def random_scores(seed: int, frames: int) -> NDArray[np.float32]:
    """Sound in which the phones of these words may be and others are not."""
    random = np.random.default_rng(seed)
    scores = np.full((frames, len(CLASSES)), -6.0, np.float32)
    scores[:, HEARD] = random.uniform(-5.0, 0.0, (frames, len(HEARD)))
    return scores


def spelled(*classes: str) -> NDArray[np.float32]:
    """Log probabilities of sound that is clearly these classes, one a frame."""
    probabilities = np.full((len(classes), len(CLASSES)), 0.001, np.float32)
    for frame, name in enumerate(classes):
        probabilities[frame, CLASSES.index(name)] = 0.95
    return np.log(probabilities)
