"""From the sounds of a voice to the shapes of the mouth, as a function of the time played.

Each sound pulls lips, jaw and tongue to its viseme, with a dominance that dies away around it;
the shape at any time is the weighted mean (Cohen & Massaro 1993, "Modeling coarticulation in
synthetic visual speech"). Lips hurry where the jaw is slow, and a sound pulls only at what it
needs: a t leaves the lips to its vowels. Then P, B, M and F, V are closed for certain, whatever
their neighbors want, and nothing moves faster than a mouth can: a vowel between two closures that
has no time to open is cut, the closures never are. Lips cannot be shut and touch the teeth at once:
next to a P an F comes sooner or later than it sounds, and is cut where even that does not help.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Phoneme
from hri.face.lips.phonemes import BREATH, Sound, sound_of
from hri.face.vocabulary import VISEMES

Values = NDArray[np.float64]

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

FADE = {"lips": (60.0, 50.0), "jaw": (30.0, 25.0), "tongue": (60.0, 60.0)}
"""A pull falls by e every 1 / FADE seconds before the sound, and after it. Cohen & Massaro measure
from the middle of a sound, with half of these; here a sound pulls fully from its begin to its end.
"""
REACH = 0.25
"""Seconds around a sound beyond which its pull is nothing."""
LEAST_WEIGHT = 1e-3
"""Weights up to this are at rest."""

FASTEST = {"lips": 1 / 0.06, "jaw": 1 / 0.08, "tongue": 1 / 0.05}
"""Of the full way a second."""

ROUNDED = ("CH", "oh", "ou")
ROUND_LEAD = 0.05
"""Seconds by which rounded lips set out early."""
SHORTEST = 0.07
"""Seconds; shorter shapes are left out, their neighbors take the time (Rhubarb Lip Sync)."""
PRESSED = "PP"
CLOSED = (PRESSED, "FF")
UNYIELDING = (*CLOSED, "sil")
"""Shapes that take no time from a neighbor that is left out."""
CLOSURE = 0.045
"""Seconds that lips are shut fully at least; with the ends of their ways that makes 55 ms of 0.9
and more, which a frame at 30 Hz always sees."""
YIELD = 0.015
"""Seconds of a closed sound in which lips are still, or already, on their way: those that part
when the vowel sounds are late."""

CHANGE = 1 / FASTEST["lips"]
"""Seconds between one closure and another kind of closure."""

SPLIT = 0.6
"""Share of a gliding sound that its first viseme gets (Rhubarb Lip Sync)."""
STRESSED = 1.12
"""How much wider the jaw opens for a stressed vowel."""
ECHO = 0.6
"""How far an h opens the mouth to the vowel after it."""

EMPHASIS_RISE, EMPHASIS_FALL = 0.12, 0.3
"""Seconds in which brows go up before the middle of a stressed vowel, and come down after it."""
FULL_EMPHASIS = 0.16
"""Seconds; a stressed vowel as long as this lifts the brows fully."""

STEP = 0.005
"""Seconds between two points of a track; between them it is straight."""
_PER_CHUNK = 200
_HALO = 24
"""Steps that the limit of speed looks around: 1.2 of the slowest full way, and a closure."""

_INDEX = {viseme: number for number, viseme in enumerate(VISEMES)}
_CLOSING = np.array([viseme in CLOSED for viseme in VISEMES])


class LipTrack(ABC):
    """The mouth over a whole speech."""

    @abstractmethod
    def shape(self, position: float) -> Values:
        """Weights [visemes, articulators], 0 to 1.2, at a position in the speech, seconds.

        Rows are as in VISEMES, that of "sil" always 0; columns are as in ARTICULATORS.
        """

    @abstractmethod
    def emphasis(self, position: float) -> float:
        """Stress of the current syllable, 0 to 1; the brows follow it."""

    def weights(self, position: float, articulator: str = "lips") -> dict[str, float]:
        """The shape of one of ARTICULATORS by viseme, those at rest left out."""
        weights = self.shape(position)[:, ARTICULATORS.index(articulator)]
        return {VISEMES[number]: float(weights[number]) for number in np.flatnonzero(weights)}


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


class PhonemeTrack(LipTrack):
    """A mouth that follows phoneme times; worked out a second at a time, when it is asked for."""

    def __init__(self, phonemes: Sequence[Phoneme]) -> None:
        """Raises ValueError without any phoneme."""
        if not phonemes:
            raise ValueError("no phonemes - follow the loudness of the voice instead")
        self.segments = tuple(shown(spoken(phonemes)))
        """The shapes in order, without overlaps."""
        rest = (
            VisemeSpan("sil", -1e9, self.segments[0].start - 0.05),
            VisemeSpan("sil", self.segments[-1].end + 0.02, 1e9),
        )
        shut = closures(self.segments)
        self._closures = tuple(shut.values())
        moved = {n: c for n, c in shut.items() if c != _closure(self.segments[n])}
        pulls = [moved.get(number, segment) for number, segment in enumerate(self.segments)]
        self._pulls = (rest[0], *pulls, rest[1])
        self._starts = np.array([segment.start for segment in self._pulls])
        self._ends = np.array([segment.end for segment in self._pulls])
        stresses = [segment for segment in self.segments if segment.stressed]
        self._stressed = np.array([(s.start + s.end) / 2 for s in stresses])
        self._stress = np.array([min(s.duration / FULL_EMPHASIS, 1.0) for s in stresses])
        self._chunks: dict[int, Values] = {}

    def shape(self, position: float) -> Values:
        first, last = self.segments[0].start - 2, self.segments[-1].end + 2
        position = min(max(position, first), last)
        step = math.floor(position / STEP)
        share = position / STEP - step
        shape: Values = (1 - share) * self._at(step) + share * self._at(step + 1)
        shape[shape <= LEAST_WEIGHT] = 0.0
        return shape

    def emphasis(self, position: float) -> float:
        if not len(self._stressed):
            return 0.0
        away = position - self._stressed
        share = np.clip(1 - np.maximum(-away / EMPHASIS_RISE, away / EMPHASIS_FALL), 0, 1)
        return float((self._stress * share * share * (3 - 2 * share)).max())

    def _at(self, number: int) -> Values:
        chunk, place = divmod(number, _PER_CHUNK)
        if chunk not in self._chunks:
            self._chunks[chunk] = self._work_out(chunk)
        shape: Values = self._chunks[chunk][place]
        return shape

    def _work_out(self, chunk: int) -> Values:
        """Weights [steps, visemes, articulators] over one chunk."""
        steps = np.arange(-_HALO, _PER_CHUNK + _HALO) + chunk * _PER_CHUNK
        times = steps.astype(np.float64) * STEP
        first = int(np.searchsorted(self._ends, times[0] - REACH))
        last = int(np.searchsorted(self._starts, times[-1] + REACH))
        near = self._pulls[first:last]
        shut = [
            c for c in self._closures if times[0] - REACH < c.end and c.start < times[-1] + REACH
        ]
        shapes = [
            _limited(_closed(_blended(near, times, articulator), shut, times), articulator)
            for articulator in ARTICULATORS
        ]
        _part(shapes[ARTICULATORS.index("lips")], shut, times[_HALO:-_HALO])
        track = np.stack(shapes, axis=-1)
        track[:, _INDEX["sil"]] = 0.0
        return track


def _blended(segments: Sequence[VisemeSpan], times: Values, articulator: str) -> Values:
    """The weighted mean of all shapes, [times, visemes]."""
    before, after = FADE[articulator]
    lead = ROUND_LEAD if articulator == "lips" else 0.0
    starts = np.array([s.start - lead * (s.viseme in ROUNDED) for s in segments])
    ends = np.array([segment.end for segment in segments])
    early, late = starts - times[:, None], times[:, None] - ends
    place = ARTICULATORS.index(articulator)
    pulls = np.array([PULL[segment.viseme][place] for segment in segments])
    pulls = pulls * np.exp(-np.maximum(np.maximum(before * early, after * late), 0.0))
    pulls /= np.maximum(pulls.sum(axis=1, keepdims=True), 1e-12)
    visemes = np.zeros((len(segments), len(VISEMES)))
    for number, segment in enumerate(segments):
        widened = STRESSED if segment.stressed and articulator == "jaw" else 1.0
        visemes[number, _INDEX[segment.viseme]] = segment.strength * widened
    blended: Values = pulls @ visemes
    return blended


def closures(segments: Sequence[VisemeSpan]) -> dict[int, VisemeSpan]:
    """When the lips must be shut, or on the teeth, by the number of the segment.

    Those on the teeth give way, and are left out where there is no time for them.
    """
    wanted = {n: _closure(s) for n, s in enumerate(segments) if s.viseme in CLOSED}
    pressed = [closure for closure in wanted.values() if closure.viseme == PRESSED]
    starts = [*(closure.start for closure in pressed), math.inf]
    ends = [-math.inf, *(closure.end for closure in pressed)]
    kept, passed = {}, 0
    for number, closure in wanted.items():
        if closure.viseme == PRESSED:
            passed += 1
            kept[number] = closure
        else:
            earliest, latest = ends[passed] + CHANGE, starts[passed] - CHANGE
            if earliest <= latest:
                kept[number] = _between(closure, earliest, latest)
    return kept


def _closure(segment: VisemeSpan) -> VisemeSpan:
    """From when until when the lips must be shut; what a short sound lacks comes before it."""
    end = segment.end - min(YIELD, segment.duration / 4)
    return VisemeSpan(segment.viseme, min(segment.start + YIELD, end - CLOSURE), end)


def _between(closure: VisemeSpan, earliest: float, latest: float) -> VisemeSpan:
    """The closure, cut to these times, and moved where that would leave too little of it."""
    start = max(min(max(closure.start, earliest), latest - CLOSURE), earliest)
    end = min(max(min(closure.end, latest), start + CLOSURE), latest)
    return replace(closure, start=start, end=end)


def _closed(shape: Values, shut: Sequence[VisemeSpan], times: Values) -> Values:
    """The shape, with only the closure wherever the lips must meet."""
    for closure in shut:
        within = (closure.start <= times) & (times <= closure.end)
        shape[within] = 0.0
        shape[within, _INDEX[closure.viseme]] = 1.0
    return shape


def _part(shape: Values, shut: Sequence[VisemeSpan], times: Values) -> None:
    """Let each closure push the other kind out, as fast as lips move."""
    for closure in shut:
        away = np.maximum(closure.start - times, times - closure.end) / CHANGE
        most = np.clip(away, 0.0, 1.0)
        for viseme in CLOSED:
            if viseme != closure.viseme:
                column = shape[:, _INDEX[viseme]]
                np.minimum(column, most, out=column)


def _limited(shape: Values, articulator: str) -> Values:
    """The middle of the shape, at no more than the full way in the time that it takes.

    Closures are widened by as much as their ramps need, all other shapes are cut: the smallest
    function above, and the largest below, of that slope.
    """
    slope = (FASTEST[articulator] * STEP * np.arange(len(shape)))[:, None]
    most = -shape
    most[:, _CLOSING] *= -1
    ahead = np.maximum.accumulate(most + slope) - slope
    behind = np.maximum.accumulate((most - slope)[::-1])[::-1] + slope
    limited = np.maximum(ahead, behind)[_HALO:-_HALO]
    limited[:, ~_CLOSING] *= -1
    return np.asarray(limited)


def spoken(phonemes: Sequence[Phoneme]) -> Iterator[VisemeSpan]:
    """Every sound as a shape: gliding sounds split, an `h` shaped by what follows it.

    In order, without overlaps and gaps, whatever the order and the lengths of the phonemes.
    """
    ordered = sorted(phonemes, key=lambda phoneme: phoneme.start)
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
            yield VisemeSpan(viseme, start, stop, sound.strength, stressed)
        if number + 1 < len(ordered) and end < following.start:
            yield VisemeSpan("sil", end, following.start)


def shown(segments: Iterator[VisemeSpan]) -> list[VisemeSpan]:
    """The shapes that there is time for: equal ones joined, those that are too short left out.

    The weakest go first, and their time goes to their neighbors, so that of many short shapes
    the strong ones become long enough. Closures always stay and need no more time; what stands
    between closures and pauses alone stays, too, since nothing could take its place.
    """
    left = _joined(segments)
    before, after = list(range(-1, len(left) - 1)), list(range(1, len(left) + 1))
    is_left = [True] * len(left)
    for number in sorted(range(len(left)), key=lambda n: _rank(left[n])):
        segment, (earlier, later) = left[number], (before[number], after[number])
        has_earlier = earlier >= 0 and left[earlier].viseme not in UNYIELDING
        has_later = later < len(left) and left[later].viseme not in UNYIELDING
        is_needed = segment.viseme in CLOSED or not (has_earlier or has_later)
        if is_needed or segment.duration >= SHORTEST:
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


def _rank(segment: VisemeSpan) -> tuple[bool, float]:
    """How dear a shape is: short pauses are left out first."""
    return segment.viseme != "sil", PULL[segment.viseme][0] * segment.duration


def _joined(segments: Iterator[VisemeSpan]) -> list[VisemeSpan]:
    """Neighbors of the same viseme made one."""
    joined = []
    for _, equal in groupby(segments, key=lambda segment: segment.viseme):
        run = list(equal)
        strength = max(segment.strength for segment in run)
        stressed = any(segment.stressed for segment in run)
        joined.append(VisemeSpan(run[0].viseme, run[0].start, run[-1].end, strength, stressed))
    return joined
