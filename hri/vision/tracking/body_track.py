"""One body, followed by its clothes while the face is not seen: from behind, or bent down.

Boxes for torso and legs are laid where they may be, as large as they may be, and the ones that hold
most of the person's colors, with least of them beside and above, are theirs. Someone on a level
floor who goes away also comes nearer to the horizon: place and size go together, which shows the
distance where the picture has only a back. Whoever is covered is lost for a moment, and looked for
in more and more of the picture; one who looks like another there counts as neither.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.vision.tracking.clothes import Box, Clothes, Colors, Field
from hri.vision.tracking.place import Place

Floats = NDArray[np.float64]

THEIRS = 0.5
"""Likeness of clothes below which it is not them."""
FOUND_AGAIN = 0.6
"""The same for who was out of sight."""
LEAST, CLEARLY, LEAST_CLEARLY = 0.35, 0.7, 0.2
"""Likeness of each part of them that they must have then; and that of all from which on a part may
be less alike: light falls otherwise on it, or something stands before it."""
SHOWN = 0.12
"""How far the torso must speak for them, of 1."""
SIDES_COUNT, ABOVE, LEGS_COUNT = 2.5, 0.5, 0.4
"""What their colors beside the torso and above it count against a place, and the legs for it."""
SHOULDERS: tuple[Box, Box] = ((-2.0, 1.3, -1.4, 3.3), (1.4, 1.3, 2.0, 3.3))
OVER: Box = (-1.0, -0.6, 1.0, 0.8)
CORE: Box = (-0.95, 1.05, 0.95, 3.3)
THIGHS: Box = (-0.65, 4.6, 0.65, 6.8)
"""The parts that are looked at, in sizes of the face from its middle, seen from the front."""
SIDEWAYS = 0.6
"""Breadth of a torso from the side, as a part of that from the front."""
ACROSS, STEPS = 1.5, 10
"""Sizes of the face to each side of where they should be that are searched, and the steps there."""
SIZES, TURNS, HEIGHTS = (-2, -1, 0, 1, 2), (-1, 0, 1), (-1, 0, 1)
SIZE_STEP, TURN_STEP, HEIGHT_STEP = 0.06, 0.1, 0.12
"""Steps of the size (logarithm), of the breadth of the torso, and of the height (sizes of the face)
from what they were."""
PLACE_COST, STEP_COST, TURN_COST = 0.25, 0.003, 0.2
"""What each squared size of the face away costs, each squared step, and a squared turn aside."""
WIDE_SIZES = tuple(range(-8, 9, 2))
WIDE_TURNS = (SIDEWAYS, 0.8, 1.0)
WIDE_ACROSS = 0.25
"""Sizes of the face between two places of a search through the whole width."""
WIDE_SOON = 0.4
"""Seconds out of sight after which they may be anywhere in the picture."""
REACH_COST = 0.04
"""What each size of the face from where they were last costs then."""
SHARPNESS, NEAR_BEST = 0.04, 0.5
"""How much less a place may fit to count a third as much, and sizes of the face to the best."""
RIVAL_APART, RIVAL_NEAR = 1.2, 0.08
"""Sizes of the face to another place that fits as well, and by how little it may fit less."""
MOMENT, HEAD_AWAY = 0.3, 0.8
"""Seconds for which a body shows where its face must be, and sizes of the face by which that may be
elsewhere."""
APPROACH, HEAD_GROWN = 1.0, math.log(1.5)
"""Seconds in which nobody comes so near that their face grows by more, logarithm of a ratio."""
OUTLINE_AWAY, OUTLINE_GROWN = 1.0, math.log(1.6)
"""The same of a body that was found by its outline."""
OUTLINE_PART = 0.25
"""Part of the way to the size and height of an outline, which are some 20 % off."""
TAKEN, TAKEN_SIZE = 0.9, math.log(1.5)
"""Sizes of the face within which a place is someone else's or behind them, and logarithm of the
ratio of sizes from which on it is before them."""
BESIDE = 2.5
"""Sizes of the face to the next one, within which clothes may be those of someone else."""
PACE_SMOOTHING = 0.25
"""Seconds over which the pace is averaged."""
FITTING, MISFIT = 0.4, 0.6
"""Part of how large clothes make someone look that each look makes up; and the least of it."""
RISING = 0.2
"""Part of how far below the horizon a face is that each picture of it makes up."""
STEADYING = 0.4
"""Part of the way to the size and height that were found: they are looked for in coarse steps."""
COASTING = 0.5
"""Seconds that someone covered is taken to walk on."""


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What a picture says beside the colors."""

    time: float
    horizon: float
    """Pixels from the top: where the camera's height is, far away."""
    others: Sequence[Place] = ()
    """Where other people are."""


class BodyTrack:
    """Someone's body, from where their face was seen."""

    def __init__(self) -> None:
        self.place: Place | None = None
        """Where it was last."""
        self.seen = -math.inf
        """Seconds, when that was."""
        self.rested = -math.inf
        """Seconds, when the face above it was seen last."""
        self.outlined = -math.inf
        """Seconds, when its outline was looked for."""
        self.looked = -math.inf
        """Seconds, when it was looked for."""
        self._pace = 0.0
        self._breadth = 1.0
        """Of the torso, as a part of that from the front."""
        self._rise = math.nan
        """Sizes of the face by which the face lies below the horizon."""
        self._fit = 1.0
        """How large their clothes make them look, against the face."""

    def rest_on(self, place: Place, around: Surroundings) -> None:
        """The face is seen: so the body is there."""
        if not place.is_somewhere:
            return
        self._note(place, around.time)
        self._breadth, self.rested = 1.0, around.time
        rise = (place.y - around.horizon) / place.breadth
        known = rise if math.isnan(self._rise) else self._rise
        self._rise = known + RISING * (rise - known)

    def is_behind(self, other: Place) -> bool:
        """Whether someone there is much nearer to the camera."""
        return self.place is not None and math.log(other.breadth / self.place.breadth) > TAKEN_SIZE

    def is_near(self, time: float) -> bool:
        """Whether it was seen so lately that it is looked for only near there."""
        return time - self.seen <= WIDE_SOON

    def measure(self, colors: Colors, clothes: Clothes, around: Surroundings) -> None:
        """See how large their clothes make them look, while the face shows how large they are."""
        if self.place is None or self.rested != around.time or not clothes.are_known:
            return
        found = self._search(colors, clothes, self.place, around).near(1.0)
        if found is not None and found.torso >= SHOWN:
            fit = found.place.breadth / self.place.breadth
            self._fit = min(1 / MISFIT, max(MISFIT, self._fit + FITTING * (fit - self._fit)))

    def contradicts(self, time: float, face: Place) -> bool:
        """Whether a face cannot be theirs, because their body was seen elsewhere a moment ago.

        Who has just lost their face may have moved in a jerk: their body does not say so yet.
        """
        missing, is_followed = time - self.seen, self.seen - self.rested > MOMENT
        if self.place is None or not is_followed or missing > APPROACH:
            return False
        here = self.expected(time)
        if abs(math.log(face.breadth / here.breadth)) > HEAD_GROWN:
            return True
        away = math.hypot(face.x - here.x, face.y - here.y) / here.breadth
        return missing <= MOMENT and away > HEAD_AWAY

    def follow(self, colors: Colors, clothes: Clothes, around: Surroundings) -> Place | None:
        """Look for it near where it should be, or in the whole picture; where it is."""
        missing = around.time - self.seen
        if self.place is None or not clothes.are_known or missing <= 0:
            return None
        expected = self.expected(around.time)
        is_wide = not self.is_near(around.time)
        self.looked = around.time
        clothes.look_around(colors, expected)
        search = self._search(colors, clothes, expected, around)
        found = search.wide() if is_wide else search.near(self._breadth)
        if found is None or found.torso < SHOWN:
            return None
        alike = clothes.likeness(colors, found.place, is_behind=True)
        if alike is None or alike.mean < (FOUND_AGAIN if is_wide else THEIRS):
            return None
        if is_wide and alike.least < (LEAST if alike.mean < CLEARLY else LEAST_CLEARLY):
            return None
        self._breadth = found.breadth
        place = self._steadied(found.place, expected, is_wide)
        self._note(place, around.time)
        if all(place.away(other) > BESIDE for other in around.others):
            clothes.learn_behind(colors, place)
        return place

    def take(
        self, colors: Colors, clothes: Clothes, found: Place, around: Surroundings
    ) -> Place | None:
        """A body was found by its outline: where it is if it is theirs."""
        if self.place is None:
            return None
        expected = self.expected(around.time)
        is_near = expected.away(found) < OUTLINE_AWAY
        is_near &= abs(math.log(found.breadth / expected.breadth)) < OUTLINE_GROWN
        alike = clothes.likeness(colors, found, is_behind=True)
        if not is_near or alike is None or alike.mean < THEIRS:
            return None
        grown = found.breadth / expected.breadth
        breadth = expected.breadth * grown**OUTLINE_PART
        place = Place(found.x, expected.y + OUTLINE_PART * (found.y - expected.y), breadth)
        self._note(place, around.time)
        return place

    def expected(self, time: float) -> Place:
        """Where it should be."""
        assert self.place is not None
        ahead = min(COASTING, max(0.0, time - self.seen))
        return replace(self.place, x=self.place.x + self._pace * ahead)

    def _search(
        self, colors: Colors, clothes: Clothes, expected: Place, around: Surroundings
    ) -> _Search:
        sought = replace(expected, breadth=expected.breadth * self._fit)
        return _Search(colors, clothes, sought, self._rise / self._fit, around)

    def _steadied(self, found: Place, expected: Place, is_wide: bool) -> Place:
        """What was found, without the coarse steps in which it was looked for."""
        if is_wide:
            return replace(found, breadth=found.breadth / self._fit)
        grown = found.breadth / (expected.breadth * self._fit)
        breadth = expected.breadth * grown**STEADYING
        return Place(found.x, expected.y + STEADYING * (found.y - expected.y), breadth)

    def _note(self, place: Place, time: float) -> None:
        elapsed = time - self.seen
        if self.place is not None and 0 < elapsed < COASTING:
            part = 1 - math.exp(-elapsed / PACE_SMOOTHING)
            self._pace += ((place.x - self.place.x) / elapsed - self._pace) * part
        elif elapsed:
            self._pace = 0.0
        self.place, self.seen = place, time


@dataclass(frozen=True, slots=True)
class _Found:
    place: Place
    breadth: float
    torso: float


class _Search:
    """The places where someone may be in a picture, and how far each speaks for them."""

    def __init__(
        self,
        colors: Colors,
        clothes: Clothes,
        expected: Place,
        rise: float,
        around: Surroundings,
    ) -> None:
        torso, legs = clothes.evidence(colors)
        self._torso = _sums(torso)
        self._legs = None if legs is None else _sums(legs)
        self._scale, self._size = colors.scale, colors.bins.shape
        self._expected, self._rise, self._around = expected, rise, around

    def near(self, breadth: float) -> _Found | None:
        """Near where they should be, and about as large as they were."""
        size = self._expected.breadth
        turns = [min(1.1, max(SIDEWAYS, breadth + TURN_STEP * turn)) for turn in TURNS]
        x, grown, turned, high = _grid(
            ACROSS * size * np.linspace(-1, 1, 2 * STEPS + 1), SIZES, turns, HEIGHTS
        )
        breadths = size * np.exp(SIZE_STEP * grown)
        cost = PLACE_COST * (x / size) ** 2
        cost += STEP_COST * (grown**2 + high**2) + TURN_COST * (1 - turned) ** 2
        return self._best(self._expected.x + x, breadths, turned, high, cost)

    def wide(self) -> _Found | None:
        """In the whole width of the picture; None where two places fit as well."""
        size, width = self._expected.breadth, self._size[1] * self._scale
        count = max(2, math.ceil(width / max(WIDE_ACROSS * size, 2 * self._scale)))
        x, grown, turned, high = _grid(
            np.linspace(0, width, count), WIDE_SIZES, WIDE_TURNS, HEIGHTS
        )
        breadths = size * np.exp(SIZE_STEP * grown)
        cost = REACH_COST * np.minimum(4.0, np.abs(x - self._expected.x) / size)
        cost += STEP_COST * (grown**2 + high**2) + TURN_COST * (1 - turned) ** 2
        return self._best(x, breadths, turned, high, cost, has_rivals=True)

    def _best(
        self,
        x: Floats,
        breadth: Floats,
        turned: Floats,
        high: Floats,
        cost: Floats,
        has_rivals: bool = False,
    ) -> _Found | None:
        level = self._around.horizon + self._rise * breadth
        y = level + HEIGHT_STEP * high * breadth
        torso, shown = self._mean(self._torso, CORE, x, y, breadth, turned)
        score = torso - ABOVE * self._mean(self._torso, OVER, x, y, breadth, turned)[0]
        for box in SHOULDERS:
            score -= SIDES_COUNT / 2 * self._mean(self._torso, box, x, y, breadth, turned)[0]
        if self._legs is not None:
            legs, seen = self._mean(self._legs, THIGHS, x, y, breadth, turned)
            score += LEGS_COUNT * np.where(seen > 0.5, legs, 0.0)
        score = np.where(shown > 0.35, score - cost, -np.inf)
        score[self._is_taken(x, breadth)] = -np.inf
        best = int(np.argmax(score))
        if score[best] == -np.inf:
            return None
        if has_rivals:
            away = np.abs(x - x[best]) > RIVAL_APART * breadth[best]
            if (score[away] > score[best] - RIVAL_NEAR).any():
                return None
        # Within what fits about as well the middle counts: a box fits a little smaller, too.
        with np.errstate(under="ignore"):
            weight = np.exp((score - score[best]) / SHARPNESS)
        weight[np.abs(x - x[best]) > NEAR_BEST * breadth[best]] = 0.0
        weight /= weight.sum()
        middle = (float(weight @ values) for values in (x, y, np.log(breadth), turned))
        at_x, at_y, size, aside = middle
        return _Found(Place(at_x, at_y, math.exp(size)), aside, float(torso[best]))

    def _is_taken(self, x: Floats, breadth: Floats) -> NDArray[np.bool_]:
        """Which places are those of others, or behind them."""
        taken = np.zeros(x.shape, np.bool_)
        for other in self._around.others:
            near = np.abs(x - other.x) < TAKEN * np.maximum(breadth, other.breadth)
            taken |= near & (np.log(breadth / other.breadth) < TAKEN_SIZE)
        return taken

    def _mean(
        self, sums: Floats, box: Box, x: Floats, y: Floats, breadth: Floats, turned: Floats
    ) -> tuple[Floats, Floats]:
        """The mean within a box at each place, 0 where none of it is in the picture; and how much
        of it is.
        """
        height, width = self._size
        unit = breadth / self._scale
        left, right = (
            np.rint(x / self._scale + edge * turned * unit).astype(np.int64)
            for edge in (box[0], box[2])
        )
        top, bottom = (
            np.rint(y / self._scale + edge * unit).astype(np.int64) for edge in (box[1], box[3])
        )
        area = np.maximum(1, (right - left) * (bottom - top))
        left, right = (np.clip(edge, 0, width) for edge in (left, right))
        top, bottom = (np.clip(edge, 0, height) for edge in (top, bottom))
        total = sums[bottom, right] - sums[top, right] - sums[bottom, left] + sums[top, left]
        inside = (right - left) * (bottom - top)
        return total / np.maximum(1, inside), inside / area


def _sums(values: Field) -> Floats:
    """The sum of all to the left and above of each place between them."""
    return np.asarray(cv2.integral(values), np.float64)


def _grid(*axes: Iterable[float]) -> tuple[Floats, ...]:
    """All combinations of some values, one array for each of them."""
    return tuple(axis.ravel() for axis in np.meshgrid(*map(np.asarray, axes), indexing="ij"))
