"""What was seen around the robot a moment ago, and how far it could go in each direction.

A short memory of points in the odometry frame, so that a few beams fill it as the robot moves and
turns, and a polar histogram over it. It follows VFH+ (Ulrich and Borenstein, "VFH+: reliable
obstacle avoidance for fast mobile robots", ICRA 1998): obstacles are enlarged by the robot, and a
direction has two thresholds, so that it does not flicker between free and blocked. Instead of a
density each sector holds a way: the meters that a round robot can go there until it touches.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from hri.core.geometry import placed
from hri.core.signals import Pose2D, RangeReading
from hri.drive.mechanics import Mechanics

Array = NDArray[np.float64]

SECTORS = 72
"""Directions, 5 degrees each, counted to the left from the x axis of the odometry frame."""
WIDTH = math.tau / SECTORS
DIRECTIONS: Array = np.linspace(0.0, math.tau, SECTORS, endpoint=False)
MOST_POINTS = 600
"""Points that are remembered at most; of more the oldest are forgotten."""
GRAIN = 0.03
"""Meters; a point this near to a known one only confirms it."""
BEAM = 0.05
"""Meters to the side of a beam within which it shows that an old point is gone."""
TOLERANCE = 0.16
"""Meters before the end of a beam in which nothing is said to be gone: noise, and thin things."""
STAYS_S = 8.0
"""Seconds; what is in the same place for longer stands there for good. People who pass by stay for
some seconds at most."""
FELT_S = 15.0
"""Seconds for which something is remembered that the bumper felt."""
TRACE_S, TRACE = 1.0, 0.5
"""Seconds for which a point is remembered that lies so near to someone who walks, meters."""
FARTHEST = 10.0
"""Meters; what is farther away is in nobody's way."""
DEPTH = 0.3
"""Meters that everything is deep, at least."""
CORE = 0.75
"""Share of a robot's reach that is surely filled by its body."""
SLACK = 0.002
"""Meters by which the robot may get nearer to what it stands beside."""
SURE_REACH = 0.6
"""Meters that a beam without an echo shows free; the reach of the shortest usual sensor, less some
for dark things."""


class Memory:
    """Points at which something was seen, until they are too old or a beam passes through them."""

    def __init__(self, keep_s: float) -> None:
        """`keep_s`: seconds that a point is remembered."""
        self._keep = keep_s
        self._points: Array = np.zeros((0, 6))
        """x, y, when it was seen last, the direction it was looked at in, 1 when it was felt and -1
        when it was someone who walks, and when it was seen first."""

    @property
    def points(self) -> Array:
        """Shape [n, 2], meters in the odometry frame: what was seen, and a point behind each.

        Things have a depth. Without the points behind, the robot would turn in behind the half of a
        round thing that it has seen, into the half that it has not.
        """
        return self._deep(self._points)

    def since(self, time: float) -> Array:
        """The same of what was seen since a time, or has been there for longer than people stay."""
        last, first = self._points[:, 2], self._points[:, 5]
        return self._deep(self._points[(last >= time) | (last - first >= STAYS_S)])

    @staticmethod
    def _deep(points: Array) -> Array:
        seen, angles = points[:, :2], points[:, 3]
        behind = seen + DEPTH * np.column_stack((np.cos(angles), np.sin(angles)))
        return np.concatenate((seen, behind))

    def see(
        self,
        now: float,
        pose: Pose2D,
        readings: Mapping[str, RangeReading],
        mechanics: Mechanics,
    ) -> None:
        """Take in what the beams say from a pose; a reading that is not a number is left out."""
        kind = self._points[:, 4]
        keep = np.select([kind > 0, kind < 0], [FELT_S, TRACE_S], self._keep)
        self._points = self._points[self._points[:, 2] > now - keep]
        for id, mount in mechanics.mounts.items():
            reading = readings.get(id)
            if reading is None or math.isnan(reading.distance) or reading.distance < 0:
                continue
            start, angle = placed(pose, mount.x, mount.y), pose.heading + mount.heading
            self._clear(start, angle, min(reading.distance, SURE_REACH) - TOLERANCE)
            if reading.distance < FARTHEST:
                x = start[0] + reading.distance * math.cos(angle)
                y = start[1] + reading.distance * math.sin(angle)
                self.add(x, y, now, angle)

    def pass_by(self, now: float, walkers: Sequence[tuple[float, float]]) -> None:
        """Someone walks at each of these places: what was just seen there is soon gone."""
        x, y, last, _, kind, first = self._points.T
        is_trace = (now - last < TRACE_S) & (last - first < STAYS_S) & (kind == 0)
        for at_x, at_y in walkers:
            near = np.hypot(x - at_x, y - at_y) < TRACE
            self._points[near & is_trace, 4] = -1.0

    def forget(self, before: float) -> None:
        """Forget what was seen before a time."""
        self._points = self._points[self._points[:, 2] > before]

    def feel(self, x: float, y: float, now: float, angle: float) -> None:
        """Remember what the bumper felt, for FELT_S, though no beam may see it."""
        self._points = np.vstack((self._points, (x, y, now, angle, 1.0, now)))

    def add(self, x: float, y: float, now: float, angle: float) -> None:
        """Remember a point of the odometry frame that was looked at in this direction."""
        apart = np.hypot(self._points[:, 0] - x, self._points[:, 1] - y)
        known = apart < GRAIN
        if known.any():
            self._points[known, 2:4] = now, angle
        else:
            point = (x, y, now, angle, 0.0, now)
            self._points = np.vstack((self._points[-MOST_POINTS + 1 :], point))

    def _clear(self, start: tuple[float, float], angle: float, length: float) -> None:
        """Forget what a beam passed through."""
        if length <= 0 or not len(self._points):
            return
        east, north = self._points[:, 0] - start[0], self._points[:, 1] - start[1]
        along = east * math.cos(angle) + north * math.sin(angle)
        aside = np.abs(north * math.cos(angle) - east * math.sin(angle))
        is_felt = self._points[:, 4] > 0
        self._points = self._points[is_felt | (along < 0) | (along > length) | (aside > BEAM)]


def free_ways(
    pose: Pose2D,
    points: Array,
    radius: float,
    discs: Sequence[tuple[float, float, float]] = (),
    directions: Array = DIRECTIONS,
) -> Array:
    """Meters that a round robot can go straight in each direction until it touches something.

    `points` are [n, 2]; `discs` are (x, y, radius). Infinite where nothing is in the way. Where it
    is nearer to something already only the ways that lead no nearer are free.
    """
    n = len(points)
    if n + len(discs) == 0:
        return np.full(len(directions), math.inf)
    x = np.concatenate((points[:, 0], [disc[0] for disc in discs])) - pose.x
    y = np.concatenate((points[:, 1], [disc[1] for disc in discs])) - pose.y
    reach = np.concatenate((np.full(n, radius), [radius + disc[2] for disc in discs]))
    reach = reaches(x, y, reach, CORE * radius)
    cos, sin = np.cos(directions), np.sin(directions)
    along = np.outer(x, cos) + np.outer(y, sin)
    aside = np.outer(y, cos) - np.outer(x, sin)
    room = reach[:, None] ** 2 - aside**2
    # The ray meets the circle of radius `reach` around the point: the robot's middle touches it.
    way = along - np.sqrt(np.maximum(room, 0.0))
    way = np.where((room > 0) & (along > 0), np.maximum(way, 0.0), math.inf)
    ways: Array = way.min(axis=0)
    return ways


def reaches(x: Array, y: Array, reach: Array | float, body: float) -> Array:
    """How far to stay away from points at (x, y) from the robot: `reach`, or as far as now.

    Something that is nearer already, by noise or because it came by itself, must not nail the
    robot down: it may go along it and away from it. Within `body` it may only go away.
    """
    return np.minimum(reach, np.maximum(np.hypot(x, y) - SLACK, body))


class Histogram:
    """Which directions are free, with a threshold to become so and a lower one to stay so."""

    def __init__(self, blocked_below: float, free_above: float) -> None:
        """Meters of free way; between the two a direction stays what it was."""
        self._low, self._high = blocked_below, free_above
        self.is_free: NDArray[np.bool_] = np.ones(SECTORS, np.bool_)

    def update(self, ways: Array, needed: float = math.inf) -> NDArray[np.bool_]:
        """Take in the ways of `free_ways`; a way of `needed` meters is enough in any case."""
        low, high = min(self._low, needed), min(self._high, needed)
        self.is_free = (ways >= high) | (self.is_free & (ways >= low))
        return self.is_free


def sector(direction: float) -> int:
    """Index of the sector that a direction of the odometry frame lies in."""
    return round(direction / WIDTH) % SECTORS


def valleys(is_free: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """The runs of free directions as (first, count), counted to the left; one of all is (0, n)."""
    if is_free.all():
        return [(0, SECTORS)]
    begins = np.flatnonzero(is_free & ~np.roll(is_free, 1))
    blocked = np.flatnonzero(~is_free)
    found = []
    for first in begins:
        after = blocked[blocked > first]
        end = int(after[0]) if len(after) else int(blocked[0]) + SECTORS
        found.append((int(first), end - int(first)))
    return found
