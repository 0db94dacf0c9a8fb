"""The way around what is remembered: A* on a grid in which what nobody has seen counts as free.

A* is by Hart, Nilsson and Raphael ("A formal basis for the heuristic determination of minimum cost
paths", 1968). That the unknown counts as free, and the way is sought again when something turns up,
is the freespace assumption (Koenig and Likhachev, "D* Lite", AAAI 2002): a robot with a few short
beams gets out of dead ends that way. Meters in the odometry frame.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Pose2D
from hri.drive.polar_histogram import CORE, Array, reaches

CELL = 0.1
"""Side of a cell."""
BORDER = 1.5
"""Around robot, goal and obstacles, where a way may lead."""
MOST_CELLS = 120
"""Along each side of the grid; of a larger one the part around the robot is looked at."""
BEYOND = 1e6
"""Cells from the grid; whatever is farther away is only a direction."""
NARROW = 2.0
"""What a cell costs in the narrow ring around obstacles, beside the meters."""
THROUGH = 40.0
"""What a cell costs that an obstacle covers: only where there is no other way."""
BEGINNING = 4
"""Points of a way that do not tell whether it is still clear: the robot stands on them."""
DOUBT = 4.0
"""The same of one that something covers which was seen long ago, and may have moved on."""
NOTHING: Array = np.zeros((0, 2))
RING = 0.12
"""Meters of that ring."""
SAVED = 0.4
"""Meters by which a way must be shorter to count as another one."""

Point = tuple[float, float]
Cell = tuple[int, int]
_STEPS = tuple(
    (dx, dy, math.hypot(dx, dy)) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if (dx, dy) != (0, 0)
)


@dataclass(frozen=True)
class Route:
    """A way to the goal."""

    points: tuple[Point, ...]
    """From the robot to the goal."""
    is_free: bool
    """False when it leads through an obstacle, since no other way is known."""

    @property
    def length(self) -> float:
        """Meters."""
        pairs = zip(self.points, self.points[1:], strict=False)
        return sum(math.dist(one, other) for one, other in pairs)

    def rest(self, pose: Pose2D) -> Route:
        """What is left of it from the robot on."""
        here = (pose.x, pose.y)
        nearest = self._nearest(here)
        return Route((here, *self.points[nearest + 1 :]), self.is_free)

    def is_clear(self, obstacles: Array, reach: float) -> bool:
        """Whether all of it, without its beginning, keeps `reach` meters to the points."""
        if not len(obstacles) or len(self.points) < BEGINNING + 1:
            return True
        way = np.array(self.points[BEGINNING:])
        apart = np.hypot(
            way[:, 0, None] - obstacles[None, :, 0], way[:, 1, None] - obstacles[None, :, 1]
        )
        return bool((apart >= reach - CELL / 2).all())

    def _nearest(self, here: Point) -> int:
        """Number of the point of the way that is nearest."""
        return min(range(len(self.points)), key=lambda number: math.dist(here, self.points[number]))

    def ahead(self, pose: Pose2D, obstacles: Array, reach: float, most: float) -> Point:
        """The farthest point of the way that can be gone to straight on, `most` meters at most.

        `obstacles` are points, shape [n, 2], to which the robot's middle keeps `reach`. Corners are
        cut only as far as the ring around obstacles: the robot sees little of what it turns around.
        """
        here = (pose.x, pose.y)
        nearest = self._nearest(here)
        best = self.points[min(nearest + 1, len(self.points) - 1)]
        for point in self.points[nearest + 2 :]:
            if math.dist(here, point) > most or not _is_clear(here, point, obstacles, reach + RING):
                break
            best = point
        return best


def find_route(
    start: Point, goal: Point, obstacles: Array, reach: float, doubtful: Array = NOTHING
) -> Route:
    """The cheapest way for a round robot whose middle keeps `reach` meters to the obstacles.

    Where something `doubtful` was it may lead through, rather than a long way around.
    """
    grid = _Grid.around(start, goal, obstacles, reach)
    grid.cover(doubtful, start, reach, DOUBT)
    cells = grid.search(grid.cell(start), grid.cell(goal))
    is_free = not any(grid.costs[cell] >= THROUGH for cell in cells[1:-1])
    inner = [grid.middle(cell) for cell in cells[1:-1]]
    return Route((start, *inner, goal), is_free)


def narrow_way(start: Point, goal: Point, obstacles: Array, reach: float) -> float:
    """How wide the way is that a slimmer robot would take, meters, to within a cell.

    `2 * reach` when it would take the same: the robot that keeps `reach` is not too wide. A way
    that saves less than SAVED does not count: what nobody has seen may be free.
    """
    wide = find_route(start, goal, obstacles, reach)

    def is_better(reach: float) -> bool:
        slim = find_route(start, goal, obstacles, reach)
        return slim.is_free and (not wide.is_free or slim.length < wide.length - SAVED)

    least, most = 0.0, reach
    if not is_better(least):
        return 2 * reach
    while most - least > CELL / 4:
        middle = (least + most) / 2
        least, most = (middle, most) if is_better(middle) else (least, middle)
    return 2 * least


class _Grid:
    """Costs of cells by (column, row)."""

    def __init__(self, left: float, bottom: float, costs: NDArray[np.float64]) -> None:
        self._left, self._bottom = left, bottom
        self.costs = costs

    @classmethod
    def around(cls, start: Point, goal: Point, obstacles: Array, reach: float) -> _Grid:
        everything = np.vstack((obstacles.reshape(-1, 2), start, goal))
        half = MOST_CELLS * CELL / 2
        low = np.maximum(everything.min(axis=0) - BORDER, np.array(start) - half)
        high = np.minimum(everything.max(axis=0) + BORDER, np.array(start) + half)
        columns, rows = (int(n) for n in np.ceil((high - low) / CELL))
        grid = cls(float(low[0]), float(low[1]), np.zeros((columns, rows)))
        grid.cover(obstacles, start, reach, THROUGH)
        return grid

    def cover(self, obstacles: Array, start: Point, reach: float, price: float) -> None:
        """Let cells cost something to which the robot's middle may not, or hardly, come."""
        columns, rows = self.costs.shape
        x = self._left + (np.arange(columns) + 0.5) * CELL
        y = self._bottom + (np.arange(rows) + 0.5) * CELL
        apart = obstacles - np.array(start)
        # Beside something that is near already the robot may go on, see `reaches`.
        near = reaches(apart[:, 0], apart[:, 1], reach, CORE * reach)
        for (px, py), reach in zip(obstacles, near, strict=True):
            far = reach + RING
            left, right = np.searchsorted(x, (px - far, px + far))
            lower, upper = np.searchsorted(y, (py - far, py + far))
            away = np.hypot(x[left:right, None] - px, y[None, lower:upper] - py)
            cost = np.where(away < reach, price, np.where(away < far, NARROW, 0.0))
            part = self.costs[left:right, lower:upper]
            np.maximum(part, cost, out=part)

    def cell(self, point: Point) -> Cell:
        """The cell of a point; numbers beyond those of the grid for one that lies beyond."""
        across, up = (point[0] - self._left) / CELL, (point[1] - self._bottom) / CELL
        column, row = (math.floor(min(max(n, -BEYOND), BEYOND)) for n in (across, up))
        return column, row

    def middle(self, cell: Cell) -> Point:
        return self._left + (cell[0] + 0.5) * CELL, self._bottom + (cell[1] + 0.5) * CELL

    def search(self, start: Cell, goal: Cell) -> list[Cell]:
        """Cells from the start to the goal.

        To a goal beyond the grid it goes straight on from where it leaves the grid toward it:
        nothing is known there. So a thing on the border is gone around like any other.
        """
        columns, rows = self.costs.shape
        costs = self.costs.tolist()
        is_beyond = not (0 <= goal[0] < columns and 0 <= goal[1] < rows)
        came: dict[Cell, Cell] = {}
        spent = {start: 0.0}
        edge = [(math.dist(start, goal), start)]
        done: set[Cell] = set()
        while edge:
            _, here = heapq.heappop(edge)
            if here == goal:
                break
            if here in done:
                continue
            done.add(here)
            so_far = spent[here]
            for dx, dy, way in _STEPS:
                column, row = here[0] + dx, here[1] + dy
                if not (0 <= column < columns and 0 <= row < rows):
                    continue
                cost = so_far + way * (1.0 + costs[column][row])
                there = (column, row)
                if cost < spent.get(there, math.inf):
                    spent[there], came[there] = cost, here
                    heapq.heappush(edge, (cost + math.dist(there, goal), there))
            if is_beyond and self._is_exit(here, goal):
                cost = so_far + math.dist(here, goal)
                if cost < spent.get(goal, math.inf):
                    spent[goal], came[goal] = cost, here
                    heapq.heappush(edge, (cost, goal))
        return _traced(came, start, goal)

    def _is_exit(self, cell: Cell, goal: Cell) -> bool:
        """Whether it lies on a border behind which the goal is."""
        return any(
            (at == 0 and end < 0) or (at == count - 1 and end >= count)
            for at, end, count in zip(cell, goal, self.costs.shape, strict=True)
        )


def _traced(came: dict[Cell, Cell], start: Cell, goal: Cell) -> list[Cell]:
    cells = [goal]
    while cells[-1] != start:
        cells.append(came[cells[-1]])
    return cells[::-1]


def _is_clear(start: Point, end: Point, obstacles: Sequence[Point] | Array, reach: float) -> bool:
    """Whether the straight way keeps `reach` meters to all points."""
    if not len(obstacles):
        return True
    points = np.asarray(obstacles)
    dx, dy = end[0] - start[0], end[1] - start[1]
    x, y = points[:, 0] - start[0], points[:, 1] - start[1]
    along = np.clip((x * dx + y * dy) / max(dx * dx + dy * dy, 1e-9), 0.0, 1.0)
    return bool(
        (np.hypot(x - along * dx, y - along * dy) >= reaches(x, y, reach, CORE * reach)).all()
    )
