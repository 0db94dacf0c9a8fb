"""What the parts of a face do, from its mesh: smile, brows and blink.

All are lengths between points of the mesh as parts of the distance between the eyes' outer
corners, so they do not depend on how far or how large a face is. Faces differ at rest, so all three
count from what each person's own face does most of the time.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Countenance, Landmarks

Values = NDArray[np.float64]

EYES = (33, 263)
"""Outer corners of the eyes; the distance between them is the unit."""
PUPILS = ((33, 133), (362, 263))
"""Corners of the right and the left eye; the pupils are between them."""
MOUTH = (61, 291)
"""Corners of the mouth."""
LIP = 0
"""Middle of the upper lip, which hardly moves when the mouth opens."""
BROWS = (55, 105, 285, 334)
"""Inner end and middle of each brow."""
NOSE_ROOT = 168
FOREHEAD, CHIN = 10, 152
LIDS = (((159, 145), (33, 133)), ((386, 374), (263, 362)))
"""Of each eye: upper and lower lid, outer and inner corner."""

SMILE_SPAN = 0.09
"""What a broad smile adds to the width of the mouth and to how high its corners stand. This and
the next ones are as the network shows drawn faces; it is shy of brows that are drawn down."""
BROWS_UP, BROWS_DOWN = 0.035, 0.02
"""How far brows go up and down, all the way."""
BROWS_SMILE, SMILE_FROWNS = 0.4, 0.3
"""How much of a smile the network makes of raised brows, and of lowered ones of a smile."""
SHUT = 0.25
"""By which part eyes that shut become narrower than they are when open."""
ADAPTATION = 20.0
"""Seconds in which a lasting expression becomes the face's rest."""
FIRST_LOOK = 1.0
"""Seconds in which the rest is learned at first; all is near 0 until then."""


def smile_of(landmarks: Landmarks) -> float:
    """How wide the mouth is and how far its corners stand above the lip; larger smiles more."""
    corners = landmarks[list(MOUTH)]
    lift = float((landmarks[LIP] - corners.mean(axis=0)) @ _down(landmarks))
    return (_length(corners[0], corners[1]) + 2 * lift) / _unit(landmarks)


def brows_of(landmarks: Landmarks) -> float:
    """How far the brows stand above the root of the nose."""
    height = landmarks[NOSE_ROOT] - landmarks[list(BROWS)].mean(axis=0)
    return float(height @ _down(landmarks)) / _unit(landmarks)


def openness_of(landmarks: Landmarks) -> float:
    """How far the eyes are open: their height as a part of their width, in the mean of both.

    The eye aspect ratio of Soukupova and Cech, "Real-time eye blink detection" (2016).
    """
    ratios = [
        _length(landmarks[up], landmarks[low])
        / max(_length(landmarks[out], landmarks[inner]), 1e-6)
        for (up, low), (out, inner) in LIDS
    ]
    return sum(ratios) / len(ratios)


class Expressiveness:
    """One person's face; learns how it looks at rest."""

    def __init__(self) -> None:
        self._rest: Values | None = None
        self._begun = self._time = 0.0

    def update(self, time: float, landmarks: Landmarks) -> Countenance:
        """What the face does at a time in seconds. Landmarks that are not finite are ignored."""
        if not np.isfinite(landmarks).all():
            return Countenance()
        measures = smile_of(landmarks), brows_of(landmarks), openness_of(landmarks)
        now, elapsed = np.array(measures), time - self._time
        self._time = time
        if self._rest is None or elapsed < 0:
            self._rest, self._begun, elapsed = now, time, 0.0
        smile, brows, _ = now - self._rest
        narrowed = 1 - now[2] / max(self._rest[2], 1e-6)
        pace = ADAPTATION if time - self._begun > FIRST_LOOK else FIRST_LOOK / 3
        self._rest = self._rest + (now - self._rest) * (1 - math.exp(-elapsed / pace))
        smile, brows = smile / SMILE_SPAN, brows / (BROWS_UP if brows > 0 else BROWS_DOWN)
        return Countenance(
            smile=_within(smile - BROWS_SMILE * _within(brows, 0.0, 1.0), 0.0, 1.0),
            brows=_within(max(brows, min(0.0, brows + SMILE_FROWNS * smile)), -1.0, 1.0),
            blink=_within(narrowed / SHUT, 0.0, 1.0),
        )


def _unit(landmarks: Landmarks) -> float:
    return max(_length(landmarks[EYES[0]], landmarks[EYES[1]]), 1e-6)


def _down(landmarks: Landmarks) -> Landmarks:
    """From the forehead to the chin, of length 1."""
    way: Landmarks = landmarks[CHIN] - landmarks[FOREHEAD]
    length = float(np.linalg.norm(way))
    return way / max(length, 1e-6)


def _length(first: Landmarks, second: Landmarks) -> float:
    return float(np.linalg.norm(second - first))


def _within(value: float, low: float, high: float) -> float:
    return min(high, max(low, float(value)))
