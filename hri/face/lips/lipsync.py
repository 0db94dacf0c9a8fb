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
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Phoneme
from hri.face.lips.accents import Accents
from hri.face.lips.loudness import Loudness
from hri.face.lips.spans import (
    ARTICULATORS,
    CLOSED,
    PRESSED,
    PULL,
    SHORTEST_ROUNDING,
    SPREAD,
    UNYIELDING,
    VisemeSpan,
    rounds,
    shown,
    spoken,
)
from hri.face.vocabulary import VISEMES

Values = NDArray[np.float64]

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

ROUND_LEAD = 0.05
"""Seconds by which rounded lips set out early."""
CLOSURE = 0.045
"""Seconds that lips are shut fully at least; with the ends of their ways that makes 55 ms of 0.9
and more, which a frame at 30 Hz always sees."""
YIELD = 0.015
"""Seconds of a closed sound in which lips are still, or already, on their way: those that part
when the vowel sounds are late."""

CHANGE = 1 / FASTEST["lips"]
"""Seconds between one closure and another kind of closure."""

STRESSED = 1.12
"""How much wider the jaw opens for a stressed vowel."""
MOST = 1.2
"""The largest weight, of a stressed vowel that is shouted."""

STEP = 0.005
"""Seconds between two points of a track; between them it is straight."""
_PER_CHUNK = 200
_HALO = 24
"""Steps that the limit of speed looks around: 1.2 of the slowest full way, and a closure."""

_INDEX = {viseme: number for number, viseme in enumerate(VISEMES)}
OPENED = {
    "lips": np.array([0.5 * (viseme in SPREAD) for viseme in VISEMES]),
    "jaw": np.ones(len(VISEMES)),
    "tongue": np.zeros(len(VISEMES)),
}
"""How far each viseme follows the loudness: the jaw fully, lips half and only where they spread."""
_CLOSING = np.array([viseme in CLOSED for viseme in VISEMES])


class LipTrack(ABC):
    """The mouth over a whole speech."""

    @abstractmethod
    def shape(self, position: float) -> Values:
        """Weights [visemes, articulators], 0 to MOST, at a position in the speech, seconds.

        Rows are as in VISEMES, that of "sil" always 0; columns are as in ARTICULATORS.
        """

    @abstractmethod
    def emphasis(self, position: float) -> float:
        """How accented the voice is, 0 to 1; brows and head follow it."""

    def weights(self, position: float, articulator: str = "lips") -> dict[str, float]:
        """The shape of one of ARTICULATORS by viseme, those at rest left out."""
        weights = self.shape(position)[:, ARTICULATORS.index(articulator)]
        return {VISEMES[number]: float(weights[number]) for number in np.flatnonzero(weights)}


class PhonemeTrack(LipTrack):
    """A mouth that follows phoneme times; worked out a second at a time, when it is asked for."""

    def __init__(self, phonemes: Sequence[Phoneme], loudness: Loudness | None = None) -> None:
        """The mouth opens as `loudness` says. Raises ValueError without any phoneme."""
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
        self._accents = Accents(self.segments, loudness)
        self._loudness = loudness
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
        return self._accents.at(position)

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
        louder = 0.0 if self._loudness is None else self._loudness.at(times)[:, None] - 1
        shapes = []
        for articulator in ARTICULATORS:
            opened = _blended(near, times, articulator) * (1 + louder * OPENED[articulator])
            wanted = _closed(np.minimum(opened, MOST), shut, times)
            shapes.append(_limited(wanted, articulator))
        _part(shapes[ARTICULATORS.index("lips")], shut, times[_HALO:-_HALO])
        track = np.stack(shapes, axis=-1)
        track[:, _INDEX["sil"]] = 0.0
        return track


def _blended(segments: Sequence[VisemeSpan], times: Values, articulator: str) -> Values:
    """The weighted mean of all shapes, [times, visemes]."""
    before, after = FADE[articulator]
    lead = ROUND_LEAD if articulator == "lips" else 0.0
    starts, ends = _times(segments, lead)
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


def _times(segments: Sequence[VisemeSpan], lead: float) -> tuple[Values, Values]:
    """From when to when each shape pulls fully, seconds.

    Shapes that round set out `lead` seconds early, and the one before lets go for them: a short sh
    between two vowels would not be seen.
    """
    starts = np.array([segment.start - lead * rounds(segment) for segment in segments])
    ends = np.array([segment.end for segment in segments])
    for number, (one, other) in enumerate(pairwise(segments)):
        if rounds(other) and not rounds(one) and one.viseme not in UNYIELDING:
            latest = max(starts[number + 1], one.start + SHORTEST_ROUNDING)
            ends[number] = min(ends[number], latest)
    return starts, ends


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
