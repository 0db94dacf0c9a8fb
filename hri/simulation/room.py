"""The room: walls and furniture as line segments and circles, and what can be asked of them.

Meters and radians throughout. A solid box is its four sides: nothing that moves ever starts
inside one, so its inside never matters.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from copy import copy
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_NEARLY_PARALLEL = 1e-12


@dataclass(frozen=True, slots=True)
class Wall:
    """A straight wall from (x1, y1) to (x2, y2)."""

    x1: float
    y1: float
    x2: float
    y2: float


@dataclass(frozen=True, slots=True)
class Circle:
    """A round obstacle."""

    x: float
    y: float
    radius: float


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangular obstacle around (x, y), turned by `heading`."""

    x: float
    y: float
    length: float
    """Along its own x axis."""
    width: float
    heading: float = 0.0

    def sides(self) -> list[Wall]:
        """The four sides, counterclockwise."""
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        corners = [
            (self.x + cos * u - sin * v, self.y + sin * u + cos * v)
            for u, v in (
                (self.length / 2, self.width / 2),
                (-self.length / 2, self.width / 2),
                (-self.length / 2, -self.width / 2),
                (self.length / 2, -self.width / 2),
            )
        ]
        return [Wall(*corners[i - 1], *corners[i]) for i in range(4)]


Obstacle = Wall | Circle | Box


class Room:
    """Obstacles that stand still, laid out as arrays so that one call asks them all."""

    def __init__(self, obstacles: Iterable[Obstacle] = ()) -> None:
        self.obstacles = tuple(obstacles)
        sides = [side for obstacle in self.obstacles for side in _sides(obstacle)]
        ends = np.array([(s.x1, s.y1, s.x2, s.y2) for s in sides], float).reshape(-1, 4)
        self._x, self._y, x2, y2 = ends.T.copy()  # rows that lie together are much faster
        self._dx, self._dy = x2 - self._x, y2 - self._y
        self._length_squared = np.maximum(self._dx**2 + self._dy**2, _NEARLY_PARALLEL)
        self._lay_out(_rounds(self.obstacles))

    def with_more(self, circles: Iterable[Circle]) -> Room:
        """This room with something round in it as well; cheap, since people walk all the time."""
        more = tuple(circles)
        room = copy(self)
        room.obstacles = (*self.obstacles, *more)
        room._lay_out(np.hstack((self._rounds, _rounds(more))))
        return room

    def _lay_out(self, rounds: Array) -> None:
        """Take circles: rows of x, y, radius."""
        self._rounds = rounds
        self._cx, self._cy, self._radius = rounds
        self._radius_squared = self._radius**2

    def clearance(self, x: float, y: float) -> float:
        """Distance from a point to the nearest surface; negative inside a circle, inf if empty."""
        along = ((x - self._x) * self._dx + (y - self._y) * self._dy) / self._length_squared
        along = np.minimum(np.maximum(along, 0.0), 1.0)  # np.clip takes twice as long
        to_segments = np.hypot(self._x + along * self._dx - x, self._y + along * self._dy - y)
        to_circles = np.hypot(self._cx - x, self._cy - y) - self._radius
        return float(min(to_segments.min(initial=math.inf), to_circles.min(initial=math.inf)))

    def cast(self, x: ArrayLike, y: ArrayLike, angles: ArrayLike) -> Array:
        """How far rays from (x, y) get before they hit something, one per angle; inf for never."""
        turned = np.asarray(angles, float)[..., None]
        cos, sin = np.cos(turned), np.sin(turned)
        start = np.asarray(x, float)[..., None], np.asarray(y, float)[..., None]
        to_segments = self._to_segments(*start, cos, sin).min(axis=-1, initial=math.inf)
        to_circles = self._to_circles(*start, cos, sin).min(axis=-1, initial=math.inf)
        return np.asarray(np.minimum(to_segments, to_circles))

    def _to_segments(self, x: Array, y: Array, cos: Array, sin: Array) -> Array:
        """Distances [..., segment]: ray and segment as two lines, solved by Cramer's rule."""
        across = cos * self._dy - sin * self._dx
        across[np.abs(across) < _NEARLY_PARALLEL] = math.nan  # never a hit: nan compares as false
        east, north = self._x - x, self._y - y
        distance = (east * self._dy - north * self._dx) / across
        along = (east * sin - north * cos) / across
        return np.where((distance >= 0) & (along >= 0) & (along <= 1), distance, math.inf)

    def _to_circles(self, x: Array, y: Array, cos: Array, sin: Array) -> Array:
        """Distances [..., circle]; 0 from inside a circle."""
        east, north = self._cx - x, self._cy - y
        nearest = east * cos + north * sin
        reach = nearest * nearest - (east * east + north * north) + self._radius_squared
        half = np.sqrt(np.maximum(reach, 0.0))
        distance = np.maximum(nearest - half, 0.0)
        distance[(reach < 0) | (nearest + half < 0)] = math.inf
        return np.asarray(distance)


def _rounds(obstacles: Iterable[Obstacle]) -> Array:
    """Shape [3, circle]: x, y and radius of the circles among them."""
    circles = [(o.x, o.y, o.radius) for o in obstacles if isinstance(o, Circle)]
    return np.array(circles, float).reshape(-1, 3).T.copy()


def _sides(obstacle: Obstacle) -> list[Wall]:
    match obstacle:
        case Wall():
            return [obstacle]
        case Box():
            return obstacle.sides()
        case Circle():
            return []
