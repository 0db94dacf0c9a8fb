"""What is painted: the steps of a picture, as numbers that compiled loops and numpy can read.

Vertices are whole numbers of 1/256 pixels, and all sums of coverage are whole numbers, so they are
exact, and the same whatever else is drawn. A picture is one row after the other of 0xAABBGGRR,
whose colors are premultiplied: those of a canvas that was all 0.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Picture = NDArray[np.uint32]
"""Shape [height, width]."""
Floats = NDArray[np.float32]
Whole = NDArray[np.int32]
Contours = NDArray[np.int64]
"""Shape [n, 2]: first vertex, the one after the last."""
Box = tuple[int, int, int, int]
"""Left, top, right, bottom in pixels; right and bottom lie outside."""

SOLID, LINEAR, RADIAL, OPENING, CLOSING = range(5)
"""Kinds of steps."""
SHADES = 1024
"""Colors along a gradient."""
BLOCK = 16
"""Pixels of a row that are looked at together: does an edge touch one of them?"""

BITS = 8
STEPS = 1 << BITS
"""In a pixel."""
FULL = 2 * STEPS * STEPS
"""The sum in a pixel that is covered once."""
FAINT = 1 / 255
"""Less opacity than this shows nothing."""
SHIFT = 4 * BITS + 2
HALF = 1 << (SHIFT - 1)
"""Half of what is shifted away: alphas are rounded."""


class Program(NamedTuple):
    """What is painted, step by step."""

    steps: NDArray[np.void]
    """A record for each shape, and one where what is seen through an opening ends."""
    contours: Contours
    """Of all shapes, those of each behind each other."""
    ramps: NDArray[np.uint32]
    """Shape [n, SHADES]: colors from the start of a gradient to its end, 0xAABBGGRR."""


class Scratch(NamedTuple):
    """Room to paint in."""

    sums: Whole
    """Shape [height, width + 1]: changes of coverage along a row."""
    touched: NDArray[np.bool_]
    """Whether there are any in a block of a row."""
    alphas: NDArray[np.uint8]
    """Coverage times opacity, [height, width]."""
    spans: Whole
    """Of a shape, [n, 4]: row, begin, end, and alpha, or -1 when it varies."""
    shades: NDArray[np.uint32]
    """Colors of a row."""
    masks: NDArray[np.uint8]
    """Shape [openings in each other, height, width]."""
    below: NDArray[np.uint32]
    """The same."""
