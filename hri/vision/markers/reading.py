"""Reads which marker is in a quadrilateral: its cells are compared with those of every marker.

The brightness of each cell is taken as a logarithm, and the mean around it is subtracted: so a
shadow across the paper, which changes all of its cells by the same factor, changes little. What is
left is correlated with the same of every marker of the family, in four turns.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from hri.core.geometry import Matrix
from hri.core.signals import Image
from hri.vision.markers.families import Family
from hri.vision.markers.quads import sampled

SAMPLES = 4
"""Of a cell, to each side."""
MIDDLE = 0.6
"""Part of a cell, to each side, that is sampled: its middle has the least of its neighbors."""
AROUND = 1.6
"""Cells, standard deviation of the mean that is subtracted."""
INK = 12.0
"""Levels added to the brightness: the noise of dark cells means little."""
SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)


@dataclass(frozen=True, slots=True)
class Reading:
    """The marker that is likeliest in a quadrilateral."""

    id: int
    likeness: float
    """-1 to 1, correlation with it."""
    lead: float
    """By how much the likeness of every other marker is less."""
    wrong: int
    """Cells of its frame and bits that look otherwise."""
    corners: Matrix
    """[4, 2], pixels: its upper left one as it is printed, then clockwise."""


def read(gray: Image, quads: Matrix, family: Family) -> Iterator[Reading]:
    """What is likeliest in each quadrilateral, [count, 4, 2], whose corners are clockwise."""
    if not len(quads):
        return
    seen = np.array([_even(cells) for cells in np.log(_cells(gray, quads, family.width) + INK)])
    looks = _looks(family)
    flat = seen.reshape(len(quads), -1)
    flat = flat / np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-6)
    scores = (flat @ looks.T).reshape(len(quads), family.count, 4)
    for number, quad in enumerate(quads):
        of_ids = scores[number].max(axis=1)
        second, first = np.sort(of_ids)[-2:]
        id = int(of_ids.argmax())
        turn = int(scores[number, id].argmax())
        look = looks[4 * id + turn].reshape(seen[number].shape)
        wrong = int(((look > 0) != (seen[number] > 0))[1:-1, 1:-1].sum())
        yield Reading(id, float(first), float(first - second), wrong, np.roll(quad, turn, axis=0))


def _cells(gray: Image, quads: Matrix, width: int) -> Matrix:
    """Mean brightness of the cells of each, with a white one around, [count, cells, cells]."""
    count = width + 2
    within = (np.arange(SAMPLES) + 0.5) / SAMPLES - 0.5
    steps = ((np.arange(count)[:, None] - 0.5 + MIDDLE * within) / width).ravel()
    x, y = np.meshgrid(steps, steps)
    spots = np.stack([x.ravel(), y.ravel(), np.ones(x.size)])
    warps = [cv2.getPerspectiveTransform(SQUARE, quad.astype(np.float32)) for quad in quads]
    across, down, depth = np.moveaxis(np.array(warps) @ spots, 1, 0)
    values = sampled(gray, np.stack([across, down], axis=-1) / depth[..., None])
    grid = values.reshape(len(quads), count, SAMPLES, count, SAMPLES)
    cells: Matrix = grid.mean(axis=(2, 4))
    return cells


def _even(cells: Matrix) -> Matrix:
    """Cells without the mean around them."""
    around = cv2.GaussianBlur(cells, (0, 0), AROUND, borderType=cv2.BORDER_REFLECT)
    even: Matrix = cells - around
    even -= even.mean()
    return even


@lru_cache(maxsize=8)
def _looks(family: Family) -> Matrix:
    """What the cells of each marker look like in each turn, [4 * count, cells], of length 1."""
    looks: Matrix = np.array(
        [
            _even(np.rot90(family.cells(id), turn)).ravel()
            for id in range(family.count)
            for turn in range(4)
        ]
    )
    even: Matrix = looks / np.linalg.norm(looks, axis=1, keepdims=True)
    return even
