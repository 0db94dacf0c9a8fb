"""Where to look for hands: around the people who are seen, first where something moves."""

from __future__ import annotations

import math
from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import FaceBox, Image
from hri.vision.detectors.mesh import Region

CELL = 16
"""Pixels along a side of what is compared."""
STEP = 4
"""Every fourth pixel is taken: the average of some will do."""
APART = 0.15
"""Seconds between pictures that are compared: a hand that is raised moves on by then."""
MOVED = 8.0
"""Brightness, of 255, by which a cell changes where something moves; noise changes it by 1."""
FADING = 0.7
"""Seconds after which a movement is half forgotten: a raised hand that is held still."""
FADED = 0.1
"""Of a movement that is forgotten."""
REACH = 3.6
"""Sizes of the face from the head to as far as a hand can be: an arm of 0.7 m."""
SIDES = (4.5, 3.2)
"""Of the parts that are looked at in turn where something moves, in sizes of the face: in one the
network sees the hands that it misses in the other. Where nothing moves it is the first: a smaller
one holds no hand that is stretched out."""
RAISED = 1.5
"""How much of what moved counts, from its upper end, in sizes of the face: a hand, not its arm."""
ASIDE, BELOW = 1.5, 1.0
"""Where hands are when nothing moves, in sizes of the face from the head."""
SMALLEST = 96
"""Pixels of the part, for faces that are far away."""


class Movement:
    """What has moved in the picture of late, in cells."""

    def __init__(self) -> None:
        self._before: NDArray[np.float32] | None = None
        self._compared = -math.inf
        self._time = -math.inf
        self.moved = np.zeros((1, 1), np.float32)
        """How surely something moved there, 0 to 1, shape [rows, columns]."""

    def see(self, image: Image, time: float) -> None:
        """Compare a picture with one of a moment ago; of another size, or much later, with none."""
        height, width = image.shape[:2]
        size = max(1, width // CELL), max(1, height // CELL)
        sparse = np.ascontiguousarray(image[::STEP, ::STEP, 1])
        cells = cv2.resize(sparse, size, interpolation=cv2.INTER_AREA).astype(np.float32)
        if self._before is None or self._before.shape != cells.shape or time - self._time > 1.0:
            self._before, self._compared = cells, time
            self.moved = np.zeros_like(cells)
        elapsed, self._time = max(0.0, time - self._time), time
        if time - self._compared < APART:
            return
        difference = np.abs(cells - self._before)
        # A change of the light, or of the exposure, does not count.
        changed = (difference - float(np.median(difference)) > MOVED).astype(np.float32)
        fading = 0.5 ** ((time - self._compared) / FADING) if math.isfinite(elapsed) else 0.0
        self.moved = np.maximum(changed, self.moved * np.float32(fading))
        self._before, self._compared = cells, time

    def forget(self, box: FaceBox, stays: float = 0.0) -> None:
        """Take what moved there for known, but for a part that stays."""
        left, top = (max(0, int(edge // CELL)) for edge in (box.x, box.y))
        right, bottom = (
            max(0, math.ceil(edge / CELL)) for edge in (box.x + box.width, box.y + box.height)
        )
        self.moved[top:bottom, left:right] *= np.float32(stays)


def part_to_search(
    face: FaceBox, movement: Movement, size: tuple[int, int], turn: int
) -> tuple[Region, float]:
    """Where to look for the hands of who has this face, and how much moved there.

    `size` is that of the picture; `turn` counts the looks: one side, then the other, when nothing
    moves.
    """
    breadth = max(face.width, face.height)
    x, y = face.x + face.width / 2, face.y + face.height / 2
    rows, columns = np.mgrid[: movement.moved.shape[0], : movement.moved.shape[1]]
    across, down = (columns + 0.5) * CELL - x, (rows + 0.5) * CELL - y
    is_near = np.hypot(across, down - BELOW * breadth) < REACH * breadth
    weights = np.where(is_near & (movement.moved > FADED), movement.moved, 0.0)
    moved = float(weights.sum())
    if moved > 0:
        # Of two hands that move one is looked for: the middle between both would hold neither.
        half = [float(weights[is_it].sum()) for is_it in (across < 0, across >= 0)]
        weights = np.where((across < 0) == (half[0] >= half[1]), weights, 0.0)
        # A hand that was raised is at the upper end of its way.
        top = float(down[weights >= weights.max() / 2].min())
        weights = np.where(down <= top + RAISED * breadth, weights, 0.0)
        x += float((weights * across).sum() / weights.sum())
        y += float((weights * down).sum() / weights.sum())
    else:
        x += (ASIDE if turn % 2 else -ASIDE) * breadth
        y += BELOW * breadth
    side = SIDES[turn % len(SIDES)] if moved > 0 else SIDES[0]
    side = min(max(SMALLEST, side * breadth), 2.0 * max(size))
    # Beyond the edges of the picture there is nothing.
    x, y = (
        min(max(place, min(side / 2, length / 2)), max(length - side / 2, length / 2))
        for place, length in ((x, size[0]), (y, size[1]))
    )
    return Region(x, y, side), moved


def owner_of(hand: Region, faces: Sequence[FaceBox]) -> int | None:
    """Which of the faces belongs to whose hand is in a region; None when it is out of reach."""
    best, found = 1.0, None
    for number, face in enumerate(faces):
        breadth = max(face.width, face.height)
        if not 0.5 * breadth < hand.side < 5.0 * breadth:
            continue
        across = hand.x - (face.x + face.width / 2)
        down = hand.y - (face.y + face.height / 2) - BELOW * breadth
        away = math.hypot(across, down) / (1.2 * REACH * breadth)
        if away < best:
            best, found = away, number
    return found
