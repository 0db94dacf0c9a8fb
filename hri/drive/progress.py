"""Notices that a robot which should move gets nowhere."""

from __future__ import annotations

import math

from hri.core.signals import Pose2D

STUCK_S = 4.0
"""Seconds without progress after which it is stuck."""
LEAST = 0.1
"""Meters; a robot that got so far from where it was has moved on."""
LEAST_TURN = 0.6
"""Radians; the same for turning on the spot, which is how it looks for a way."""
MOST_TURN = math.tau
"""Radians; more than a whole turn on the spot is not progress."""
WALKED = 0.5
"""Meters; someone who is so far from where they were has walked on."""


class Progress:
    """Where the robot got on last, and since when it has not."""

    def __init__(self) -> None:
        self._spot: Pose2D | None = None
        self._heading, self._since = 0.0, 0.0
        self._turned = 0.0

    def rest(self) -> None:
        """It does not try to move: nothing is expected."""
        self._spot = None

    def is_stuck(self, now: float, pose: Pose2D) -> bool:
        """Whether a robot that tries to move has got nowhere for too long."""
        if self._spot is None or _apart(pose, self._spot) > LEAST:
            self._spot, self._turned = pose, 0.0
            self._heading, self._since = pose.heading, now
            return False
        turn = abs(math.remainder(pose.heading - self._heading, math.tau))
        if turn > LEAST_TURN and self._turned < MOST_TURN:
            self._turned += turn
            self._heading, self._since = pose.heading, now
        return now - self._since > STUCK_S


class Patience:
    """Notices that a goal comes no nearer."""

    def __init__(self, seconds: float, least: float) -> None:
        """It is over after `seconds` in which not `least` was gained, meters or radians."""
        self._seconds, self._least = seconds, least
        self._best, self._since = math.inf, math.nan

    def is_over(self, now: float, remaining: float) -> bool:
        """Whether nothing was gained for too long; `remaining` is infinite when it is not known."""
        if math.isnan(self._since) or remaining < self._best - self._least:
            self._best, self._since = remaining, now
        return now - self._since > self._seconds


class Approach:
    """Notices that someone who stays where they are is not reached."""

    def __init__(self, seconds: float, least: float) -> None:
        """It is over after `seconds` in which not `least` meters were gained."""
        self._limits = seconds, least
        self.rest()

    def rest(self) -> None:
        """They are reached, or out of sight: nothing is expected."""
        self._target: tuple[float, float] | None = None
        self._patience = Patience(*self._limits)

    def is_over(self, now: float, pose: Pose2D, target: tuple[float, float]) -> bool:
        """Whether too long nothing was gained on the way to a target (x, y)."""
        if self._target is None or math.dist(self._target, target) > WALKED:
            self.rest()
            self._target = target
        return self._patience.is_over(now, math.dist((pose.x, pose.y), target))


def _apart(one: Pose2D, other: Pose2D) -> float:
    return math.hypot(one.x - other.x, one.y - other.y)
