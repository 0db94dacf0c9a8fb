"""How long each part of a sentence of the natural voice lasts, at any pace, with pauses by rank.

The network counts in units of 25 ms, so its own rate goes by steps, and it pauses as it happens. It
is asked once, for its usual pace; then its frames are drawn out or together: vowels more than
consonants, as people do (D. Klatt, "Linguistic uses of segmental duration in English", JASA 59,
1976), and the silence at the end of a phrase to what its sign asks for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.speech.synthesizers.natural_melody import ACCENT_SLOWER
from hri.speech.synthesizers.natural_symbols import VOWEL_SYMBOLS

Frames = NDArray[np.float64]

CONSONANTS = 0.6
"""Exponent of the factor for consonants."""
SILENT_DB = 36.0
"""Below the loudest frame, from which on a frame is silence."""
DYING_DB = 20.0
"""Below the loudest frame, from which on the end of a sentence dies away, as fast at any pace."""
LEAST_SILENCE = 2
"""Frames of silence that can be drawn out; where there are fewer, silence is put in."""
AROUND = 6
"""Frames around the end of a phrase in which its silence is looked for."""


@dataclass(frozen=True, slots=True)
class Timing:
    """Where the frames of a sentence come from, and where they go."""

    places: Frames
    """Of each frame that is heard, its place among the frames of the network."""
    silent: NDArray[np.bool_]
    """Which of the frames that are heard are silence that was put in."""
    edges: Frames
    """Of each frame of the network, and of the end of the last, where it begins, in frames."""

    def at(self, place: NDArray[np.float64]) -> Frames:
        """Where places among the frames of the network are heard, in frames."""
        return np.interp(place, np.arange(len(self.edges)), self.edges)


def timing(
    symbols: str,
    starts: Frames,
    loudness: Frames,
    factor: float,
    pauses: Sequence[tuple[int, int]],
    weights: Frames | None = None,
) -> Timing:
    """Frames drawn out by `factor`, above 0.

    `starts` are the places at which the symbols begin, in frames, and that at which the last one
    ends; `loudness` is in decibels, by frame; `pauses` are the number of the symbol that a phrase
    ends before, and how many frames of silence follow there; `weights`, -1 to 1 by frame, make
    what has weight longer, and the rest keeps its time.
    """
    count = len(loudness)
    is_silent = loudness < loudness.max() - SILENT_DB
    stretch = _stretch(symbols, starts, ~is_silent, factor)
    if weights is not None:
        stretch = stretch * (1.0 + ACCENT_SLOWER * weights)
    added = np.zeros(count)
    for symbol, frames in pauses:
        begin, end = _silence(is_silent, starts, symbol)
        if end - begin >= LEAST_SILENCE:
            stretch[begin:end] = frames / (end - begin)
        else:
            added[begin] = frames
    loud = np.flatnonzero(loudness > loudness.max() - DYING_DB)
    stretch[loud[-1] + 1 :] = np.minimum(stretch[loud[-1] + 1 :], 1.0)
    edges = np.concatenate([[0.0], np.cumsum(stretch + added)])
    heard = np.arange(round(edges[-1])) + 0.5
    frame = np.clip(np.searchsorted(edges, heard, side="right") - 1, 0, count - 1)
    within = heard - edges[frame]
    places = frame + np.minimum(within / np.maximum(stretch[frame], 1e-9), 1.0) - 0.5
    return Timing(np.clip(places, 0.0, count - 1.0), within > stretch[frame], edges)


def _stretch(symbols: str, starts: Frames, is_heard: NDArray[np.bool_], factor: float) -> Frames:
    """By how much each frame is drawn out, so that the sound is by the factor on the whole."""
    is_vowel = np.zeros(len(is_heard), bool)
    for symbol, begin, end in zip(symbols, starts[:-1], starts[1:], strict=True):
        if symbol in VOWEL_SYMBOLS:
            is_vowel[max(round(begin), 0) : max(round(end), 0)] = True
    vowels, consonants = int((is_vowel & is_heard).sum()), int((~is_vowel & is_heard).sum())
    slower = factor**CONSONANTS
    rest = factor * (vowels + consonants) - slower * consonants
    drawn = rest / vowels if vowels and rest > 0 else factor
    stretch = np.where(is_vowel, drawn, slower if vowels and rest > 0 else factor)
    return np.where(is_heard, stretch, slower)


def _silence(is_silent: NDArray[np.bool_], starts: Frames, symbol: int) -> tuple[int, int]:
    """The longest silence at the end of a phrase, as its frames; an empty one where it would be."""
    before = max(round(starts[max(symbol - 2, 0)]), 0)
    after = min(round(starts[min(symbol + 1, len(starts) - 1)]) + AROUND, len(is_silent))
    here = min(max(round(starts[symbol]), 0), len(is_silent) - 1)
    best, begin = (here, here), None
    for place in range(before, after + 1):
        is_quiet = place < after and bool(is_silent[place])
        if is_quiet and begin is None:
            begin = place
        elif not is_quiet and begin is not None:
            if place - begin > best[1] - best[0]:
                best = begin, place
            begin = None
    return best
