"""Aligns phones in the training speech: `python align.py speech.npz`.

Where the text of a clip is known, its words are laid along what the engine's network hears in the
clean sound; where it is not, or does not fit, what the network hears is taken for the truth.
Adds to the file: the classes of the phones of all clips, the sample at which each begins, counted
from the beginning of its clip, and where the phones of each clip end.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.hal.word_graph import WordGraph
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.recognizers.ctc.confidence import scores_of
from hri.speech.recognizers.ctc.conformer import load_network
from hri.speech.recognizers.ctc.lattice import Walk
from hri.speech.recognizers.ctc.phone_graph import compile
from hri.speech.recognizers.ctc.search import Search
from hri.speech.recognizers.ctc.word_habits import Habits

Phones = list[tuple[int, int]]
"""Classes, and the frames in which they begin."""

FRAME = 320
"""Samples."""
MOST_COST = 1.2
"""How much worse the text may fit than anything else: natural log, for each of its phones."""


def heard(posteriors: NDArray[np.float32]) -> Phones:
    """The likeliest class of each frame [frames, classes], without blanks and what goes on."""
    best = posteriors.argmax(axis=1)
    begins = np.flatnonzero((np.diff(best, prepend=0) != 0) & (best > 0))
    return [(int(best[frame]), int(frame)) for frame in begins]


def spoken(text: str, posteriors: NDArray[np.float32]) -> Phones | None:
    """The phones of a text where they fit log probabilities [frames, classes] best.

    None where they fit badly: then something else was said.
    """
    try:
        search = Search(compile(in_order(text.split()), habits()))
    except HriError:
        return None
    search.advance(scores_of(posteriors))
    paths = Walk(search.trellis).sentences(1, 0.0)
    if not paths:
        return None
    found: Phones = []
    for span in paths[0].spans:
        before = None
        for frame, state in enumerate(span.states, span.start):
            if state >= 0 and state != before:
                found.append((int(search.graph.phones[state]), frame))
            before = state
    return found if -paths[0].score < MOST_COST * len(found) else None


def in_order(words: list[str]) -> WordGraph:
    """One sentence."""
    count = len(words)
    return WordGraph(
        size=count + 1,
        start=0,
        final=count,
        sources=np.arange(count, dtype=np.int32),
        targets=np.arange(1, count + 1, dtype=np.int32),
        labels=np.arange(count, dtype=np.int32),
        weights=np.zeros(count, np.float32),
        words=tuple(words),
        entries={"said": 0},
    )


@cache
def habits() -> Habits:
    """How words may be pronounced, and how the network hears them."""
    return Habits(load_lexicon())


network_of = cache(load_network)


def phones_of(text: str, clip: NDArray[np.int16]) -> tuple[Phones, bool]:
    """The transcript of a clip, and whether the text is known."""
    posteriors = network_of().posteriors(clip)
    found = spoken(text, posteriors) if text else None
    return (heard(posteriors), False) if found is None else (found, True)


def main() -> None:
    """Align all clips and write the file again."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    args = parser.parse_args()
    stored = dict(np.load(args.file))
    clips = np.split(stored["clips"], stored["ends"][:-1])
    with ProcessPoolExecutor() as pool:
        results = list(pool.map(phones_of, stored["texts"].tolist(), clips, chunksize=16))
    phones = [phone for found, _ in results for phone in found]
    stored["phones"] = np.array([phone for phone, _ in phones], np.int32)
    stored["starts"] = np.array([frame * FRAME for _, frame in phones], np.int32)
    stored["phone_ends"] = np.cumsum([len(found) for found, _ in results])
    np.savez(args.file, **stored)
    texts = sum(is_of_text for _, is_of_text in results)
    known = int((stored["texts"] != "").sum())
    print(f"{args.file}: {len(phones)} phones; {texts} of {known} texts fit")


if __name__ == "__main__":
    main()
