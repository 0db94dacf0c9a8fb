"""From the sounds of a voice to shapes in order: which there are, and which there is time for.

A gliding sound is two shapes. In quick talk many sounds are too short for a mouth: the weakest are
left out, closures never, and rounded lips last.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from statistics import median

from hri.core.signals import Phoneme
from hri.face.lips.phonemes import BREATH, Sound, sound_of

ARTICULATORS = ("lips", "jaw", "tongue")
"""What moves at its own pace."""

PULL = {
    "sil": (0.7, 0.7, 0.7),
    "PP": (1.0, 0.9, 0.1),
    "FF": (1.0, 0.8, 0.1),
    "TH": (0.6, 0.6, 1.0),
    "DD": (0.35, 0.6, 1.0),
    "kk": (0.2, 0.4, 0.8),
    "CH": (0.9, 0.9, 0.7),
    "SS": (0.6, 1.0, 0.8),
    "nn": (0.35, 0.5, 1.0),
    "RR": (0.6, 0.5, 0.6),
    "aa": (0.7, 1.0, 0.7),
    "E": (0.6, 0.8, 0.7),
    "ih": (0.7, 0.7, 0.7),
    "oh": (0.9, 0.9, 0.7),
    "ou": (1.0, 0.8, 0.7),
}
"""How hard a viseme pulls at lips, jaw and tongue, 0 to 1."""

ROUNDED = ("CH", "oh", "ou")
SPREAD = ("aa", "E", "ih")
"""Vowels that are weaker where they are unstressed or short; lips that round do so fully."""
PRESSED = "PP"
CLOSED = (PRESSED, "FF")
UNYIELDING = (*CLOSED, "sil")
"""Shapes that take no time from a neighbor that is left out."""
SHORTEST = (0.035, 0.07)
"""Seconds, bounds: shorter shapes are left out, their neighbors take the time. The upper one is
that of Rhubarb Lip Sync; the lower one is a frame of 30 Hz."""
PACE = 0.6
"""The shortest shape of a phrase, of the median of its sounds: quick talk has quicker shapes."""
SHORTEST_ROUNDING = 0.02
"""Seconds; lips round for any sound longer than this, since they set out early."""
SPLIT = 0.6
"""Share of a gliding sound that its first viseme gets (Rhubarb Lip Sync)."""
UNSTRESSED = 0.8
"""How far the mouth goes for a vowel beside a stressed one."""
HASTY, FULL_VOWEL = 0.75, 0.14
"""How far it goes for a vowel of no time; and seconds from which on it goes all the way."""
ECHO = 0.6
"""How far an h opens the mouth to the vowel after it."""


@dataclass(frozen=True, slots=True)
class VisemeSpan:
    """A viseme that the mouth is at over some time."""

    viseme: str
    start: float
    """Seconds from the start of the speech."""
    end: float
    strength: float = 1.0
    """How far the mouth goes, 0 to 1."""
    stressed: bool = False
    """Whether it is a vowel that the voice stresses."""

    @property
    def duration(self) -> float:
        """Seconds."""
        return self.end - self.start


def spoken(phonemes: Sequence[Phoneme]) -> Iterator[VisemeSpan]:
    """Every sound as a shape: gliding sounds split, an `h` shaped by what follows it.

    In order, without overlaps and gaps, whatever the order and the lengths of the phonemes.
    """
    ordered = sorted(phonemes, key=lambda phoneme: phoneme.start)
    has_stress = any(phoneme.stressed for phoneme in ordered)
    for number, phoneme in enumerate(ordered):
        sound = sound_of(phoneme.name)
        end = phoneme.start + max(phoneme.duration, 0.0)
        if number + 1 < len(ordered):
            following = ordered[number + 1]
            end = min(end, following.start)
            if phoneme.name == BREATH:
                vowel = sound_of(following.name)
                sound = Sound(vowel.visemes[:1], ECHO * vowel.strength)
        middle = phoneme.start + SPLIT * (end - phoneme.start)
        bounds = (phoneme.start, end) if len(sound.visemes) == 1 else (phoneme.start, middle, end)
        for place, viseme in enumerate(sound.visemes):
            start, stop = bounds[place : place + 2]
            stressed = phoneme.stressed and place == 0
            is_full = stressed or not has_stress
            strength = sound.strength * _reach(viseme, stop - start, is_full)
            yield VisemeSpan(viseme, start, stop, strength, stressed)
        if number + 1 < len(ordered) and end < following.start:
            yield VisemeSpan("sil", end, following.start)


def _reach(viseme: str, duration: float, is_full: bool) -> float:
    """How far of its way the mouth goes: several vowels of one kind are not all alike."""
    if viseme not in SPREAD:
        return 1.0
    full = HASTY + (1 - HASTY) * min(duration / FULL_VOWEL, 1.0)
    return full if is_full else UNSTRESSED * full


def shown(segments: Iterator[VisemeSpan]) -> list[VisemeSpan]:
    """The shapes that there is time for: equal ones joined, those that are too short left out.

    The weakest go first, and their time goes to their neighbors, so that of many short shapes
    the strong ones become long enough. Closures always stay and need no more time; what stands
    between closures and pauses alone stays, too, since nothing could take its place.
    """
    left = _joined(segments)
    least = _shortest(left)
    before, after = list(range(-1, len(left) - 1)), list(range(1, len(left) + 1))
    is_left = [True] * len(left)
    for number in sorted(range(len(left)), key=lambda n: _rank(left[n])):
        segment, (earlier, later) = left[number], (before[number], after[number])
        has_earlier = earlier >= 0 and left[earlier].viseme not in UNYIELDING
        has_later = later < len(left) and left[later].viseme not in UNYIELDING
        is_needed = segment.viseme in CLOSED or not (has_earlier or has_later)
        if is_needed or segment.duration >= least[number]:
            continue
        middle = segment.start + segment.duration * has_earlier / (has_earlier + has_later)
        if has_earlier:
            left[earlier] = replace(left[earlier], end=middle)
        if has_later:
            left[later] = replace(left[later], start=middle)
        is_left[number] = False
        if earlier >= 0:
            after[earlier] = later
        if later < len(left):
            before[later] = earlier
    return [segment for segment, stays in zip(left, is_left, strict=True) if stays]


def _rank(segment: VisemeSpan) -> tuple[bool, bool, float]:
    """How dear a shape is: short pauses are left out first, rounded lips last."""
    dear = PULL[segment.viseme][0] * segment.duration
    return segment.viseme != "sil", rounds(segment), dear


def rounds(segment: VisemeSpan) -> bool:
    """Whether lips are round for it."""
    return segment.viseme in ROUNDED


def _shortest(segments: Sequence[VisemeSpan]) -> list[float]:
    """The shortest time of each shape, seconds: by the pace of the phrase that it is in."""
    least: list[float] = []
    for pauses, group in groupby(segments, key=is_pause):
        phrase = list(group)
        pace = PACE * median(segment.duration for segment in phrase)
        usual = SHORTEST[1] if pauses else min(max(pace, SHORTEST[0]), SHORTEST[1])
        least += [SHORTEST_ROUNDING if rounds(segment) else usual for segment in phrase]
    return least


def is_pause(segment: VisemeSpan) -> bool:
    """Whether it is between two phrases."""
    return segment.viseme == "sil" and segment.duration >= SHORTEST[1]


def _joined(segments: Iterator[VisemeSpan]) -> list[VisemeSpan]:
    """Neighbors of the same viseme made one."""
    joined = []
    for _, equal in groupby(segments, key=lambda segment: segment.viseme):
        run = list(equal)
        strength = max(segment.strength for segment in run)
        stressed = any(segment.stressed for segment in run)
        joined.append(VisemeSpan(run[0].viseme, run[0].start, run[-1].end, strength, stressed))
    return joined
