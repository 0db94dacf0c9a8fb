"""Squares: the parts of a picture that a search for faces looks at, and which of them comes next.

A network that takes small pictures sees faces of at least an eighth of a side. So the squares
become smaller step by step, until a face is large in one of them wherever it is and however far
away. All of them in each picture would cost too much: the large ones, with the faces that are near,
are looked at often, and the small ones take turns.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

OVERLAP = 0.2
"""Part of a square by which the next one reaches into it, at least."""
MOST_PIECES = 8
"""Squares along a side at most; of a picture more oblong than any camera's some is not seen."""
SMALLER = 2 / 3
"""Side of the smaller squares as a part of that of the next larger ones."""
FINEST = 160
"""Pixels; no smaller squares follow these. A face of 20 pixels is an eighth of them."""
SQUARE_COST, FIT_COST = 0.004, 0.005
"""Seconds of work: to look at a square, and to fit a mesh; about what a laptop takes. Modeled and
not measured, so that the same film is seen in the same way."""
BUDGET = 0.020
"""Seconds of work in one picture; at least one square is looked at when one is due."""
LARGEST, SECOND, OTHERS = 1, 8, 16
"""Searches of the largest squares for each of the others: of the next smaller ones, and of those
for faces beyond two meters."""
DUE = 0.99
"""Part of its interval after which a square is due; the times of pictures are not exact."""
EXPECTED = 8
"""How many times more often those squares come where a face that is missing would be seen well."""
WELL = (1 / 7, 1 / 2)
"""Size of a face that is seen well, as a part of the side."""


@dataclass(frozen=True, slots=True)
class Square:
    """A part of a picture, which may reach over its edges."""

    left: int
    top: int
    side: int

    def shows(self, x: float, y: float, breadth: float) -> bool:
        """Whether a face with this middle and size, in pixels, is seen well in it."""
        low, high = WELL
        inside = self.left <= x - breadth / 2 and x + breadth / 2 <= self.left + self.side
        return (
            inside
            and self.top <= y - breadth / 2
            and y + breadth / 2 <= self.top + self.side
            and low * self.side <= breadth <= high * self.side
        )


def covering(width: int, height: int, side: int) -> list[Square]:
    """Squares of a side that overlap and cover a picture together."""
    return [
        Square(left, top, side)
        for top, left in itertools.product(_starts(height, side), _starts(width, side))
    ]


def whole(width: int, height: int) -> Square:
    """The square around a picture."""
    long = max(width, height)
    return Square((width - long) // 2, (height - long) // 2, long)


def all_squares(width: int, height: int) -> list[Square]:
    """The squares of all sizes, the largest that cover the picture first.

    The square around the whole picture stands among the second ones: only a face that fills it
    needs that.
    """
    side = min(width, height)
    squares = covering(width, height, side)
    around = whole(width, height)
    others = [] if around in squares else [around]
    while side > FINEST:
        side = round(SMALLER * side)
        others += covering(width, height, side)
    return squares + others


class SearchPlan:
    """Decides which squares to look at in a picture: those that have waited longest for theirs."""

    def __init__(self, squares: Sequence[Square]) -> None:
        """`squares` are those of a whole search, one of the largest first."""
        self._squares = list(squares)
        self._looked: list[float | None] = [None] * len(squares)
        largest = squares[0].side if squares else 0
        self._turns = [_searches(square.side / largest) for square in squares]

    def due(
        self,
        time: float,
        interval: float,
        fits: int = 0,
        missing: Iterable[tuple[float, float, float]] = (),
        spent: float = 0.0,
    ) -> list[Square]:
        """The squares for the picture of this time, in seconds; noted as looked at.

        `interval`: seconds between two looks at the largest squares; `fits`: meshes that are fitted
        in the same picture; `missing`: middle and size, in pixels, of the faces that are missing;
        `spent`: seconds of modeled work for anything else in it.
        """
        sought = list(missing)
        waited = []
        for index, square in enumerate(self._squares):
            turns = self._turns[index]
            if any(square.shows(*face) for face in sought):
                turns = max(1, turns // EXPECTED)
            last = self._looked[index]
            if last is None:  # due, and no later than that, so that the large ones come first
                last = self._looked[index] = time - interval * turns
            lateness = (time - last) / (interval * turns)
            if lateness >= DUE:
                waited.append((-lateness, index))
        spent += fits * FIT_COST
        affordable = max(1, int((BUDGET - spent) / SQUARE_COST))
        chosen = sorted(waited)[:affordable]
        for _, index in chosen:
            self._looked[index] = time
        return [self._squares[index] for _, index in sorted(chosen, key=lambda pair: pair[1])]


def _searches(share: float) -> int:
    """How many searches of the largest squares there are for one of these."""
    if share == 1:
        return LARGEST
    return SECOND if share > SMALLER**1.5 else OTHERS


def _starts(length: int, side: int) -> list[int]:
    """Where pieces of a length begin that overlap enough and cover it evenly."""
    rest = max(0, length - side)
    count = min(MOST_PIECES, 1 + math.ceil(rest / ((1 - OVERLAP) * side)))
    return [round(place) for place in np.linspace(0, rest, count)]
