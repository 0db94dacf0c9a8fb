"""What moves in the pictures of a camera that itself may turn and drive.

What the camera's own turning makes of a picture is known from odometry and subtracted. What its
driving makes of it depends on how far away everything is; then the motion that most of the picture
shares is subtracted, as an affine map (Odobez and Bouthemy, "Robust multiresolution estimation of
parametric motion models", 1995).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image, Motion, MovingRegion
from hri.vision.camera_view import CameraView
from hri.vision.motion.block_flow import CELL, SMALLEST, BlockFlow, BlockFlowFinder

WIDEST = 320
"""Pixels; a wider picture is shrunk."""
LONGEST_S = 1.0
"""Between two pictures; after a longer pause nothing is known of what moved."""
SLOWEST = 0.7
"""Pixels between two pictures; less is noise."""
SURE = 3.0
"""Times what the noise of the camera changes in a cell; less is light or noise."""
LEAST_NOISE = 1.5
"""Levels of 255."""
SMALLEST_REGION = 3
"""Cells."""
STEPS = 5
"""Of the fit of the shared motion."""
CLOCKS = 0.5
"""Part of what turning makes of a picture that clocks may have wrong: those of wheels and camera
differ by some milliseconds, and turns begin and end."""
DRIVING = 0.002
"""Meters between two pictures; a base that drives less stands still."""

Cells = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class CameraMove:
    """Where a camera was when it took a picture."""

    heading: float = 0.0
    """Radians to the left, of the base and its neck together."""
    x: float = 0.0
    y: float = 0.0
    """Meters, of the base."""


@dataclass(frozen=True, slots=True)
class FoundMotion:
    """How a picture has moved."""

    motion: Motion
    flow: BlockFlow
    """Without what turning makes of it."""

    @property
    def expansion(self) -> float:
        """By which share of its size the picture grows in a second."""
        return self.flow.expansion / self.motion.elapsed

    @property
    def time_to_contact(self) -> float:
        """Seconds until the camera is where the scene is; infinite unless it comes nearer."""
        return self.flow.time_to_contact(self.motion.elapsed)


@dataclass(frozen=True, slots=True)
class _Looked:
    """The picture before."""

    shape: tuple[int, ...]
    gray: NDArray[np.uint8]
    time: float
    place: CameraMove


class MotionFinder:
    """Compares each picture with the one before."""

    def __init__(self, view: CameraView) -> None:
        self._view = view
        self._finder = BlockFlowFinder()
        self._before: _Looked | None = None

    def look(self, image: Image, time: float, place: CameraMove, pan: float) -> FoundMotion | None:
        """What has moved since the picture before; None where there is none to compare with.

        `image` is uint8, [height, width, 3], RGB, taken at a time (seconds) and place; `pan` is
        what the camera is turned to the left of the robot's straight ahead, radians.
        """
        gray, scale = _gray(image)
        before, self._before = self._before, _Looked(image.shape, gray, time, place)
        if before is None or before.shape != image.shape or not 0 < time - before.time <= LONGEST_S:
            return None
        turn = math.remainder(place.heading - before.place.heading, math.tau)
        seen, is_known = self._turned(before.gray, turn)
        seen[is_known == 0] = gray[is_known == 0]
        flow = self._finder.between(seen, gray)
        if flow is None:
            return None
        late = self._view.focal_length(gray.shape[::-1]) * turn
        cells = _without_late_turning(flow.cells, late)
        exact = self._exact(seen, gray, flow, time - before.time)
        turned = BlockFlow(_without_late_turning(exact.cells, late), exact.confidence)
        if math.dist((place.x, place.y), (before.place.x, before.place.y)) > DRIVING:
            cells = cells - _shared(cells)
        moving = _moving(cells, flow.cells - cells, seen, gray)
        moving[_by_cell(is_known) < 255] = 0
        elapsed, size = time - before.time, (image.shape[1], image.shape[0])
        regions = tuple(self._region(box, scale, size, pan) for box in _boxes(moving))
        speed = np.asarray(cells / np.float32(scale * elapsed), np.float32)
        return FoundMotion(Motion(time, elapsed, speed, regions, flow.confidence), turned)

    def _exact(
        self, before: NDArray[np.uint8], now: NDArray[np.uint8], flow: BlockFlow, elapsed: float
    ) -> BlockFlow:
        """The flow of a scene that surely comes nearer, more exactly; others as they are."""
        grown = flow.grown()
        if grown is None or not math.isfinite(flow.time_to_contact(elapsed)):
            return flow
        return self._finder.again(before, now, grown) or flow

    def _turned(
        self, gray: NDArray[np.uint8], turn: float
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
        """A picture as a camera sees it that has turned to the left, and 255 where it is known."""
        size = gray.shape[1], gray.shape[0]
        focal = self._view.focal_length(size)
        camera = np.array([[focal, 0, size[0] / 2], [0, focal, size[1] / 2], [0, 0, 1]])
        rotation, _ = cv2.Rodrigues(np.array([0.0, turn, 0.0]))
        way = camera @ rotation @ np.linalg.inv(camera)
        known = cv2.warpPerspective(np.full_like(gray, 255), way, size, flags=cv2.INTER_NEAREST)
        seen = cv2.warpPerspective(gray, way, size, flags=cv2.INTER_LINEAR)
        return np.asarray(seen, np.uint8), np.asarray(known, np.uint8)

    def _region(
        self, box: tuple[int, int, int, int], scale: float, size: tuple[int, int], pan: float
    ) -> MovingRegion:
        left, top, width, height = (part * CELL / scale for part in box)
        x, y = left + width / 2, top + height / 2
        bearing, _ = self._view.toward(x, y, size)
        return MovingRegion(x, y, width, height, math.remainder(bearing + pan, math.tau))


def _without_late_turning(cells: Cells, shift: float) -> Cells:
    """Without what is left of a turn that moved the picture by this many pixels."""
    unsure = CLOCKS * abs(shift)
    return np.asarray(cells - np.clip(np.median(cells, axis=(0, 1)), -unsure, unsure), np.float32)


def _moving(
    cells: Cells, camera: Cells, before: NDArray[np.uint8], gray: NDArray[np.uint8]
) -> NDArray[np.uint8]:
    """Which cells move, [rows, columns]: they are fast by themselves, and the camera's motion alone
    does not explain their pixels.
    """
    expected, is_known = _moved(before, camera)
    levels = _by_cell(np.asarray(cv2.absdiff(expected, gray), np.uint8))
    noise = max(LEAST_NOISE, float(np.percentile(levels, 20)))
    is_moving = np.hypot(cells[..., 0], cells[..., 1]) > SLOWEST
    is_moving &= levels > SURE * noise
    return np.asarray(is_moving & (_by_cell(is_known) > 254), np.uint8)


def _moved(before: NDArray[np.uint8], flow: Cells) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """A picture as a flow moves it, and 255 where it was in the picture before."""
    y, x = np.indices(before.shape, np.float32)
    across, down = (np.asarray((each + 0.5) / CELL - 0.5, np.float32) for each in (x, y))
    whole = cv2.remap(
        np.ascontiguousarray(flow), across, down, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    from_x, from_y = x - whole[..., 0], y - whole[..., 1]
    moved = cv2.remap(before, from_x, from_y, cv2.INTER_LINEAR)
    inside = np.full(before.shape, 255, np.uint8)
    return (
        np.asarray(moved, np.uint8),
        np.asarray(cv2.remap(inside, from_x, from_y, cv2.INTER_LINEAR), np.uint8),
    )


def _by_cell(picture: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Its mean over each cell."""
    rows, columns = picture.shape[0] // CELL, picture.shape[1] // CELL
    picture = picture[: rows * CELL, : columns * CELL]
    return np.asarray(picture.reshape(rows, CELL, columns, CELL).mean(axis=(1, 3)))


def _gray(image: Image) -> tuple[NDArray[np.uint8], float]:
    """A small gray picture, and how much smaller it is."""
    gray = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY)
    scale = min(1.0, WIDEST / image.shape[1])
    if scale < 1 and min(image.shape[:2]) * scale >= SMALLEST:
        gray = cv2.resize(gray, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    else:
        scale = 1.0
    return np.asarray(gray, np.uint8), scale


def _shared(cells: Cells) -> Cells:
    """The motion that most of the cells share, as an affine map of where they are."""
    rows, columns = cells.shape[:2]
    y, x = np.mgrid[:rows, :columns].astype(np.float64)
    where = np.stack([np.ones(x.size), x.ravel(), y.ravel()], axis=1)
    flow = cells.reshape(-1, 2).astype(np.float64)
    weights = np.ones(len(flow))
    fitted = np.zeros_like(flow)
    for _ in range(STEPS):
        weighted = where * weights[:, None]
        solved, *_ = np.linalg.lstsq(weighted.T @ where, weighted.T @ flow, rcond=None)
        fitted = where @ solved
        away = np.hypot(*(flow - fitted).T)
        scale = max(1.5 * float(np.median(away)), 0.1)
        weights = 1 / (1 + (away / scale) ** 2) ** 2  # Geman and McClure's
    return np.asarray(fitted.reshape(cells.shape), np.float32)


def _boxes(moving: NDArray[np.uint8]) -> list[tuple[int, int, int, int]]:
    """Left, top, width and height in cells of what hangs together, the largest first."""
    count, _, stats, _ = cv2.connectedComponentsWithStats(moving, connectivity=8)
    parts = [tuple(int(value) for value in stats[part]) for part in range(1, count)]
    large = sorted((part for part in parts if part[4] >= SMALLEST_REGION), key=lambda p: (-p[4], p))
    return [(left, top, width, height) for left, top, width, height, _ in large]
