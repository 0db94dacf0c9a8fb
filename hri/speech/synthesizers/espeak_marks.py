"""Converts events of espeak-ng to the times of phonemes, words and sentences."""

from __future__ import annotations

import math
import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Sequence

from hri.core.signals import Phoneme, Samples, Span, Speech
from hri.speech.synthesizers.espeak_library import Event, Mark

_STRESS = "',"
_PAUSE = "_"
"""What the names of pauses begin with."""


def timed_speech(
    text: str, origins: Sequence[int], samples: Samples, rate: int, marks: Sequence[Mark]
) -> Speech:
    """The speech with all its times.

    The marks count characters of what the library read; `origins` says of each of those which
    character of the text it stands for.
    """
    phonemes = tuple(_phonemes(marks, rate, len(samples) / rate))
    words, sentences = (_begun(text, kind, origins, marks) for kind in (Event.WORD, Event.SENTENCE))
    return Speech(
        text,
        samples,
        rate,
        phonemes,
        tuple(_spans(text, words, phonemes, rate)),
        tuple(_spans(text, sentences, phonemes, rate)),
    )


def _phonemes(marks: Iterable[Mark], rate: int, duration: float) -> Iterator[Phoneme]:
    """The phonemes; each lasts until the next begins, pauses included."""
    sounds = [mark for mark in marks if mark.kind == Event.PHONEME]
    starts = [mark.sample / rate for mark in sounds]
    for mark, start, end in zip(sounds, starts, [*starts[1:], duration], strict=False):
        if name := mark.name.strip(_STRESS):
            yield Phoneme(name, start, max(0.0, end - start), mark.name[0] in _STRESS)


def _begun(
    text: str, kind: Event, origins: Sequence[int], marks: Iterable[Mark]
) -> list[tuple[int, int]]:
    """The words of the text at which something of a kind begins to be spoken: (character, sample).

    The library marks parts of words ("3.5"), and passes over words that melt into others ("I am").
    """
    starts = [match.start() for match in re.finditer(r"\S+", text)]
    begun: list[tuple[int, int]] = []
    for mark in marks:
        if mark.kind == kind and starts:
            origin = origins[min(mark.position, len(origins) - 1)]
            start = starts[max(0, bisect_right(starts, origin) - 1)]
            if not begun or start > begun[-1][0]:
                begun.append((start if begun else starts[0], mark.sample))
    return begun


def _spans(
    text: str, begun: Sequence[tuple[int, int]], phonemes: Sequence[Phoneme], rate: int
) -> Iterator[Span]:
    """Each goes on until the next begins, the pause before that left out."""
    spoken = [phoneme for phoneme in phonemes if not phoneme.name.startswith(_PAUSE)]
    starts = [phoneme.start for phoneme in spoken]
    following = [*begun[1:], (len(text), None)]
    for (position, sample), (end, limit) in zip(begun, following, strict=False):
        start = sample / rate
        latest = math.inf if limit is None else limit / rate
        count = bisect_left(starts, latest)
        until = spoken[count - 1].start + spoken[count - 1].duration if count else start
        yield Span(text[position:end].strip(), position, start, min(max(start, until), latest))
