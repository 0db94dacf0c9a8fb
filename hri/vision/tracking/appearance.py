"""How someone looks, in a few numbers: to tell apart the people who are here now.

Colors of a coarse grid over face, hair and chest against the brightness of the face: light that
is stronger or weaker for all of it changes nothing. It distinguishes a red sweater from a blue one,
a beard from a chin; it does not tell who someone is, and is forgotten with the person.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.vision.detectors.mesh import Region

Look = NDArray[np.float32]
"""Shape [cells, 3]: logarithm of red, green, blue against the face; NaN outside of the picture."""

FACE_GRID = (-0.30, -0.46, 0.30, 0.34, 6, 8)
"""Left, top, right, bottom in sides of the region, columns, rows: hair to chin."""
CHEST_GRID = (-0.36, 0.56, 0.36, 0.92, 4, 3)
SAMPLES = 4
"""Points a side that are averaged in each cell."""
FLOOR = 0.1
"""Added to each color, as a part of the brightness of the face: of dark hair, shades of black make
no difference."""
FACE_KEPT, CHEST_KEPT = 0.85, 0.7
"""Parts of the cells that count, those that are most alike: a hand or a turned head hides some."""
BRIGHTNESS, COLOR = 0.2, 2.0
"""What a difference in brightness counts, and one in color: light falls from one side."""
FACE_CELLS = FACE_GRID[4] * FACE_GRID[5]
SKIN = slice(12, 42)
"""Cells of the face that make up its brightness."""


def _grid(left: float, top: float, right: float, bottom: float, columns: int, rows: int) -> Look:
    """Points [cells * SAMPLES ** 2, 2] of a grid, those of each cell together."""
    across = left + (right - left) * (np.arange(columns * SAMPLES) + 0.5) / (columns * SAMPLES)
    down = top + (bottom - top) * (np.arange(rows * SAMPLES) + 0.5) / (rows * SAMPLES)
    x, y = np.meshgrid(across, down)
    points = np.stack([x, y], axis=-1).reshape(rows, SAMPLES, columns, SAMPLES, 2)
    together: Look = points.transpose(0, 2, 1, 3, 4).reshape(-1, 2).astype(np.float32)
    return together


POINTS = np.concatenate([_grid(*FACE_GRID), _grid(*CHEST_GRID)])


def look_of(image: Image, region: Region) -> Look:
    """What the person of a face looks like in a picture."""
    cosine, sine = math.cos(region.roll), math.sin(region.roll)
    turn = region.side * np.array([[cosine, sine], [-sine, cosine]], np.float32)
    places = np.rint(POINTS @ turn + (region.x, region.y)).astype(np.int64)
    height, width = image.shape[:2]
    is_inside = ((places >= 0) & (places < (width, height))).all(axis=1)
    x, y = np.where(is_inside[:, None], places, 0).T
    colors = image[y, x].astype(np.float32)
    colors[~is_inside] = np.nan
    cells = colors.reshape(-1, SAMPLES**2, 3).mean(axis=1)
    skin = cells[SKIN]
    known = skin[~np.isnan(skin[:, 0])]
    brightness = max(1.0, float(known.mean())) if len(known) else 1.0
    look: Look = np.log(cells / brightness + FLOOR).astype(np.float32)
    return look


def difference(first: Look, second: Look) -> float:
    """How unlike two looks are: 0 for the same, some 0.05 for one person, 0.3 for two.

    Infinite when they have next to nothing to compare.
    """
    apart = first - second
    gray = apart.mean(axis=1)
    unlike = BRIGHTNESS * np.abs(gray) + COLOR * np.abs(apart - gray[:, None]).mean(axis=1)
    face = _typical(unlike[:FACE_CELLS], FACE_KEPT)
    chest = _typical(unlike[FACE_CELLS:], CHEST_KEPT)
    if math.isnan(face):
        return math.inf
    return face if math.isnan(chest) else (face + chest) / 2


def _typical(unlike: Look, kept: float) -> float:
    """The mean of the least; NaN when fewer than half are known."""
    known = np.sort(unlike[~np.isnan(unlike)])
    if len(known) < len(unlike) / 2:
        return math.nan
    return float(known[: max(1, int(kept * len(known)))].mean())


def blended(old: Look, new: Look, part: float) -> Look:
    """The old look with a part of the new one; cells that only one of them has come from it."""
    mixed = old + (new - old) * part
    both: Look = np.where(np.isnan(mixed), np.where(np.isnan(old), new, old), mixed)
    return both
