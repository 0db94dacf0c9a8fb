"""From the sounds of a voice to the shapes of the lips, as a function of the time played.

Each sound pulls the lips to its viseme with a dominance that dies away around it; the shape at any
time is the weighted mean (Cohen & Massaro 1993). P, B, M and F, V are then closed for certain:
whatever their neighbors want, the lips meet.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Phoneme, Speech
from hri.face.envelope import EnvelopeTrack
from hri.face.vocabulary import VISEMES

SINGLE = {
    "sil": "_ _: _:: _! _| ; ?",
    "PP": "p b m m-",
    "FF": "f v v#",
    "TH": "T D",
    "DD": "t t# t2 d d# d[ t[ *",
    "kk": "k g N x ? c q C Q",
    "CH": "tS dZ S Z S; Z;",
    "SS": "s z z# z/2",
    "nn": "n n- l l/ l/2 l/3 l^ L @L N- n^",
    "RR": "r r/ r- 3 3: R",
    "aa": "a a2 a# a#2 aa A A: A~ 0 02 0# V &",
    "E": "E E# E2 e: e# e E~",
    "ih": "I I2 I# I2# i i: j Y y",
    "oh": "O O2 O: o o: O~ oU# 2 9 W",
    "ou": "U u u: w w#",
}
"""Mnemonics of espeak-ng by viseme (its English tables, with some of German and French)."""

DOUBLE = {
    "aI": "aa ih", "aU": "aa ou", "eI": "E ih", "oU": "oh ou", "OI": "oh ih",
    "i@": "ih E", "e@": "E E", "U@": "ou E", "aI@": "aa E", "aU@": "aa E",
    "A@": "aa RR", "O@": "oh RR", "o@": "oh RR", "IR": "ih RR", "VR": "aa RR",
    "i@3": "ih RR", "e@3": "E RR", "U@3": "ou RR", "aI3": "aa RR", "aU3": "aa RR",
}  # fmt: skip
"""Sounds that glide from one viseme to another."""

SCHWAS = ("@", "@2", "@5", "@#", "@-", "-", "I#", "a#")
"""Reduced vowels, hardly opened."""
SPLIT = 0.6
"""Share of a gliding sound that its first viseme gets (Rhubarb Lip Sync)."""

DOMINANCE = {
    "sil": 0.7, "PP": 1.0, "FF": 1.0, "TH": 0.6, "DD": 0.35, "kk": 0.3, "CH": 0.9, "SS": 0.6,
    "nn": 0.4, "RR": 0.5, "aa": 0.8, "E": 0.7, "ih": 0.7, "oh": 0.9, "ou": 0.9,
}  # fmt: skip
"""How hard a viseme pulls (Cohen & Massaro's amplitudes, as measured notes of lips suggest)."""
FADE = 30.0
"""A sound's dominance falls by e every 1 / FADE seconds away from it."""
ROUND_LEAD = 0.05
"""Seconds by which rounded lips set out early."""
ROUNDED = ("CH", "oh", "ou")

CLOSED = ("PP", "FF")
CLOSURE = 0.06
"""Seconds that lips stay together at least: more than one frame."""
RAMP = 0.045
"""Seconds in which they come together and part."""
LEAD = 0.01
"""Seconds by which they meet before the sound."""

_VISEME = {name: viseme for viseme, names in SINGLE.items() for name in names.split()}
_INDEX = {viseme: number for number, viseme in enumerate(VISEMES)}


class LipTrack(Protocol):
    """The lips over a whole speech."""

    def weights(self, position: float) -> dict[str, float]:
        """Weights of visemes, 0 to 1.2, after so many seconds of the speech; none at rest."""
        ...


def lip_track(speech: Speech) -> LipTrack:
    """The track of a speech: by its phonemes, or by loudness and brightness without them."""
    if speech.phonemes:
        return PhonemeTrack(speech.phonemes)
    return EnvelopeTrack(speech.samples, speech.rate)


@dataclass(frozen=True, slots=True)
class Segment:
    """A viseme that the lips head for over some time."""

    viseme: str
    start: float
    end: float
    strength: float = 1.0


class PhonemeTrack:
    """Lips that follow phoneme times."""

    def __init__(self, phonemes: tuple[Phoneme, ...]) -> None:
        segments = list(segments_of(phonemes))
        self.segments = segments
        self._closures = [_closure(segment) for segment in segments if segment.viseme in CLOSED]
        rest = [
            Segment("sil", -1e9, segments[0].start - 0.05),
            Segment("sil", segments[-1].end + 0.02, 1e9),
        ]
        pulling = [*segments, *rest]
        self._start = np.array([s.start - ROUND_LEAD * (s.viseme in ROUNDED) for s in pulling])
        self._end = np.array([segment.end for segment in pulling])
        self._dominance = np.array([DOMINANCE[segment.viseme] for segment in pulling])
        self._strength = np.array([segment.strength for segment in pulling])
        self._viseme = np.array([_INDEX[segment.viseme] for segment in pulling])

    def weights(self, position: float) -> dict[str, float]:
        away = np.maximum(np.maximum(self._start - position, position - self._end), 0)
        pull = self._dominance * np.exp(-FADE * away)
        total = max(float(pull.sum()), 1e-12)
        shape = np.bincount(self._viseme, pull * self._strength, len(VISEMES)) / total
        shape = self._closed(shape, position)
        return {
            viseme: float(weight)
            for viseme, weight in zip(VISEMES[1:], shape[1:], strict=True)
            if weight > 1e-3
        }

    def _closed(self, shape: NDArray[np.float64], position: float) -> NDArray[np.float64]:
        """The shape with closures laid over it."""
        closing = np.zeros(len(VISEMES))
        for number, start, end in self._closures:
            ramp = 1 + min(position - start, end - position, 0.0) / RAMP
            closing[number] = max(closing[number], ramp)
        share = closing.sum()
        if share > 1:
            closing /= share
            share = 1.0
        mixed: NDArray[np.float64] = (1 - share) * shape + closing
        return mixed


def segments_of(phonemes: tuple[Phoneme, ...]) -> Iterator[Segment]:
    """Visemes with their times: gliding sounds split, `h` shaped by what follows it."""
    for number, phoneme in enumerate(phonemes):
        end = phoneme.start + max(phoneme.duration, 0.0)
        name, strength = phoneme.name, 1.12 if phoneme.stressed else 1.0
        if name == "h" and number + 1 < len(phonemes):
            name, strength = phonemes[number + 1].name, 0.6
        visemes, factor = visemes_of(name)
        if len(visemes) == 1:
            yield Segment(visemes[0], phoneme.start, end, strength * factor)
        else:
            middle = phoneme.start + SPLIT * (end - phoneme.start)
            yield Segment(visemes[0], phoneme.start, middle, strength)
            yield Segment(visemes[1], middle, end, strength)


def visemes_of(name: str) -> tuple[tuple[str, ...], float]:
    """Visemes of an espeak-ng mnemonic, and how strongly they are shaped.

    Marks of stress and length are ignored; an unknown sound is a slightly open mouth.
    """
    plain = name.strip("'%,=|")
    if plain in SCHWAS:
        return ("E",), 0.5
    for candidate in (plain, plain.rstrip(":~#"), plain.rstrip(":~#0123456789"), plain[:1]):
        if candidate in DOUBLE:
            return tuple(DOUBLE[candidate].split()), 1.0
        if candidate in _VISEME:
            return (_VISEME[candidate],), 1.0
    return ("kk",), 0.3


def _closure(segment: Segment) -> tuple[int, float, float]:
    """Index of the viseme, and from when until when the lips must be together."""
    start = segment.start - LEAD
    return _INDEX[segment.viseme], start, max(segment.end - 0.02, start + CLOSURE)
