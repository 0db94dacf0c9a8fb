"""Wandering: one place after another near by, chosen at random, never the way it came from."""

from __future__ import annotations

import math
import random

from hri.core.signals import Pose2D

LONGEST_S = 15.0
"""Seconds for one place; then it tries another."""
NEAREST, FARTHEST = 1.0, 2.5
"""Meters to the next place."""
WIDEST = math.radians(100)
"""Radians off straight ahead in which it lies."""
NEAR = 0.25
"""Meters from a place that are near enough."""


class Wandering:
    """Chooses places; the same seed chooses the same ones."""

    def __init__(self, seed: int = 0) -> None:
        self._dice = random.Random(seed)
        self._goal: Pose2D | None = None
        self._since = -math.inf

    def goal(self, now: float, pose: Pose2D) -> Pose2D:
        """Where to go next, in the odometry frame."""
        goal = self._goal
        is_over = goal is None or math.dist((pose.x, pose.y), (goal.x, goal.y)) < NEAR
        if goal is None or is_over or now - self._since > LONGEST_S:
            direction = pose.heading + self._dice.uniform(-WIDEST, WIDEST)
            way = self._dice.uniform(NEAREST, FARTHEST)
            x, y = pose.x + way * math.cos(direction), pose.y + way * math.sin(direction)
            goal = self._goal = Pose2D(x, y, direction)
            self._since = now
        return goal
