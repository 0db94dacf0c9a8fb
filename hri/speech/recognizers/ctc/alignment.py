"""When each sound of a speech is said: forced alignment by the phone network.

The likeliest path through the words of a known text (CTC segmentation: L. Kuerzinger et al., SPECOM
2020), or the likeliest phones where the text is unknown. The network shows a phone as a peak that
comes some 60 ms after the phone begins. By how much depends on the phone and on what is before it:
DELAYS and AFTER are medians over 297 sentences of three voices whose true times are known
(`benchmarks/speech/alignment.py` measures them).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Phoneme, Samples
from hri.hal.word_graph import WordGraph
from hri.speech.pronunciation.phones import VOWELS
from hri.speech.recognizers.ctc.classes import BLANK, CLASSES
from hri.speech.recognizers.ctc.confidence import FLOOR
from hri.speech.recognizers.ctc.conformer import FRAME
from hri.speech.recognizers.ctc.lattice import Walk
from hri.speech.recognizers.ctc.phone_graph import Floats, Indices, Pronouncing, compile
from hri.speech.recognizers.ctc.search import Search
from hri.speech.synthesizers.espeak_text import MNEMONICS

DELAYS = {
    "AA": 71, "AE": 62, "AH": 60, "AO": 72, "AW": 75, "AY": 74, "B": 67, "CH": 34, "D": 42,
    "DH": 70, "EH": 67, "ER": 56, "EY": 70, "F": 75, "G": 53, "HH": 75, "IH": 61, "IY": 65,
    "JH": 62, "K": 42, "L": 53, "M": 63, "N": 53, "NG": 52, "OW": 71, "OY": 73, "P": 45, "R": 52,
    "S": 67, "SH": 76, "T": 40, "TH": 64, "UH": 61, "UW": 57, "V": 47, "W": 69, "Y": 40, "Z": 54,
    "ZH": 53,
}  # fmt: skip
"""Milliseconds from the begin of a phone to its peak."""
AFTER = {"pause": 3, "vowel": -2, "stop": 4, "fricative": 6, "sonorant": -8}
"""Milliseconds more, by what is before it."""
STOPS = frozenset(("B", "D", "G", "K", "P", "T"))
SONORANTS = frozenset(("L", "M", "N", "NG", "R", "W", "Y"))
PAUSE = "_:"
"""How espeak-ng, whose names all voices give to their phonemes, calls a pause."""
QUIET_DB = -35.0
"""Below the loudest 10 ms: a pause between two words, or after the last one."""
SHORTEST_PAUSE = 0.06
SHORTEST_PHONE = 0.02
"""Seconds."""
_LEVEL_STEP = 0.01
_CLEAR = np.log(0.3)
"""Probability from which a peak counts where the text is unknown."""
_LESS_BLANK = 1.0
"""Natural log that blanks lose there: the network gives too many of them. With BLANK_BIAS, which
suits a search, some sounds would be heard as three phones."""


@dataclass(frozen=True, slots=True)
class Peak:
    """A phone, where the network hears it best."""

    phone: str
    """Of the CMU dictionary, without stress."""
    word: int
    """Number of its word; 0 where the text is unknown."""
    time: float
    """Seconds."""


def forced(
    log_probabilities: Floats, words: Sequence[str], lexicon: Pronouncing
) -> tuple[list[Peak], float]:
    """The peaks of the phones of known words, and how well they fit, 0 (perfectly) down to FLOOR.

    `log_probabilities` [frames, CLASSES]. No peaks where there are too few frames for the words.
    """
    if not words or not len(log_probabilities):
        return [], FLOOR
    scores: Floats = np.logaddexp(log_probabilities, np.float32(FLOOR))
    search = Search(compile(_sentence(words), lexicon))
    search.advance(scores)
    paths = Walk(search.trellis).sentences(1, 1.0)
    if not paths:
        return [], FLOOR
    phones, found, clarity = search.graph.phones, [], []
    for number, span in enumerate(paths[0].spans):
        for state, frames in _runs(span.states, span.start):
            chances = np.exp(log_probabilities[frames, phones[state]])
            time = float(chances @ frames / chances.sum()) * FRAME
            found.append(Peak(CLASSES[phones[state]], number, time))
            clarity.append(float(scores[frames, phones[state]].max()))
    return found, float(np.mean(clarity))


def free(log_probabilities: Floats) -> list[Peak]:
    """The peaks of the likeliest phones, where the text is unknown."""
    less = np.zeros(len(CLASSES), np.float32)
    less[BLANK] = _LESS_BLANK
    best = (log_probabilities - less).argmax(axis=1)
    found = []
    for index, frames in _runs(best, 0):
        heard = log_probabilities[frames, index]
        if index and heard.max() > _CLEAR:
            found.append(Peak(CLASSES[index], 0, float(frames[heard.argmax()]) * FRAME))
    return found


def _runs(states: Sequence[int] | NDArray[np.intp], start: int) -> Iterator[tuple[int, Indices]]:
    """Each state that is not negative, with the frames that follow each other in it."""
    values = np.asarray(states)
    edges = [0, *(np.flatnonzero(np.diff(values)) + 1).tolist(), len(values)]
    for begin, end in pairwise(edges):
        if end > begin and values[begin] >= 0:
            yield int(values[begin]), np.arange(start + begin, start + end)


def _sentence(words: Sequence[str]) -> WordGraph:
    """The graph of one sentence."""
    known = tuple(dict.fromkeys(words))
    count = len(words)
    return WordGraph(
        size=count + 2,
        start=0,
        final=count + 1,
        sources=np.arange(count + 1, dtype=np.int32),
        targets=np.arange(1, count + 2, dtype=np.int32),
        labels=np.array([-1, *(known.index(word) for word in words)], np.int32),
        weights=np.zeros(count + 1, np.float32),
        words=known,
        entries={"sentence": 1},
    )


@dataclass(frozen=True, slots=True)
class Placed:
    """A phone in time."""

    phone: str
    word: int
    start: float
    """Seconds."""
    end: float


def placed(peaks: Sequence[Peak], samples: Samples, rate: int) -> list[Placed]:
    """From where to where each phone sounds; it ends where the next one begins, or in a pause."""
    quiet = _pauses(samples, rate)
    starts: list[float] = []
    for number, peak in enumerate(peaks):
        before = peaks[number - 1] if number else None
        start = max(peak.time - _delay(peak, before, quiet), 0.0)
        starts.append(max(start, starts[-1] + SHORTEST_PHONE) if starts else start)
    ends = [*starts[1:], len(samples) / rate][: len(starts)]
    return [
        Placed(peak.phone, peak.word, start, _sounding_until(start, peak.time, after, quiet))
        for peak, start, after in zip(peaks, starts, ends, strict=True)
    ]


def phonemes(phones: Sequence[Placed], seconds: float) -> Iterator[Phoneme]:
    """The phonemes of a speech that lasts some seconds, with its pauses."""
    end = 0.0
    for one in phones:
        if one.start - end >= SHORTEST_PHONE:
            yield Phoneme(PAUSE, end, one.start - end)
        yield Phoneme(MNEMONICS[one.phone], one.start, one.end - one.start)
        end = one.end
    if seconds - end >= SHORTEST_PHONE:
        yield Phoneme(PAUSE, end, seconds - end)


def _delay(peak: Peak, before: Peak | None, quiet: Sequence[tuple[float, float]]) -> float:
    """Seconds from the begin of a phone to its peak."""
    is_after_pause = before is None or any(
        before.time < begin and end < peak.time + _LEVEL_STEP for begin, end in quiet
    )
    kind = "pause" if before is None or is_after_pause else _kind(before.phone)
    return (DELAYS[peak.phone] + AFTER[kind]) / 1000


def _kind(phone: str) -> str:
    if phone in VOWELS:
        return "vowel"
    if phone in STOPS:
        return "stop"
    return "sonorant" if phone in SONORANTS else "fricative"


def _sounding_until(
    start: float, peak: float, after: float, quiet: Sequence[tuple[float, float]]
) -> float:
    """Where a phone ends: at the next one, unless a pause begins before that."""
    pauses = (begin for begin, _ in quiet if peak <= begin < after)
    return max(next(pauses, after), start + SHORTEST_PHONE)


def _pauses(samples: Samples, rate: int) -> list[tuple[float, float]]:
    """Where it is quiet for long enough to be a pause: [begin, end), seconds."""
    step = round(_LEVEL_STEP * rate)
    blocks = samples[: len(samples) // step * step].astype(np.float32).reshape(-1, step)
    level = np.sqrt((blocks**2).mean(axis=1))
    loud = level > level.max(initial=1.0) * 10 ** (QUIET_DB / 20)
    edges = [-1, *np.flatnonzero(loud).tolist(), len(level)]
    least = SHORTEST_PAUSE / _LEVEL_STEP
    return [
        ((before + 1) * _LEVEL_STEP, after * _LEVEL_STEP)
        for before, after in pairwise(edges)
        if after - before - 1 >= least
    ]
