"""The swings of one angle: movements from one turning point to the next, found as they happen."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

SLACK = 0.2
"""Part of the least swing: so near to an extreme the head still rests there."""
REST = 0.4
"""Seconds after which a head that hardly moves is at rest; no nod lingers so long at its turns."""
REST_SLACK = 0.5
"""Part of the least swing within which it hardly moves."""
KEPT = 8
"""Turning points that are remembered."""
SPEED_WINDOW = 0.06
"""Seconds over which a speed is measured."""


MOST_LATELY = 100
"""Angles from which a rest is detected, whatever their rate."""

Point = tuple[float, float]
"""Seconds, and radians."""


@dataclass(frozen=True, slots=True)
class Swing:
    """A movement from one turning point to the next, or up to now."""

    start: float
    """Seconds, when the head left the first point."""
    end: float
    """Seconds, when it left the second, or now while it still rests there."""
    width: float
    """Radians, with its sign."""


class ZigZag:
    """The turning points of one angle: a turn counts once the angle has come back by `least`.

    A movement that goes on in the same direction after a rest is another swing: else one that
    follows a slow drift would seem to have begun with it.
    """

    def __init__(self) -> None:
        self.last_turn = -math.inf
        """Seconds, when a turn was found last."""
        self._turns: deque[Point] = deque(maxlen=KEPT)
        self._direction = 0
        self._low, self._high = (0.0, math.inf), (0.0, -math.inf)
        self._lately: deque[Point] = deque(maxlen=MOST_LATELY)
        self._rest: Point = (-math.inf, 0.0)
        """Where and when it rested last."""

    def update(self, time: float, value: float, least: float) -> None:
        """Take the next angle, in radians."""
        slack = SLACK * least
        if value >= self._high[1] - slack:
            self._high = (time, max(value, self._high[1]))
        if value <= self._low[1] + slack:
            self._low = (time, min(value, self._low[1]))
        if self._rests(time, value, REST_SLACK * least):
            self._rest = (time, value)
        if self._direction <= 0 and value - self._low[1] >= least:
            self._turn(max(self._low, self._rest), 1, time)
            self._high = (time, value)
        elif self._direction >= 0 and self._high[1] - value >= least:
            self._turn(max(self._high, self._rest), -1, time)
            self._low = (time, value)
        elif self._goes_on(value, least):
            self._turn(self._rest, self._direction, time)

    def _rests(self, time: float, value: float, slack: float) -> bool:
        """Whether the angle has hardly moved of late."""
        self._lately.append((time, value))
        while len(self._lately) > 1 and time - self._lately[1][0] >= REST:
            self._lately.popleft()
        values = [value for _, value in self._lately]
        return time - self._lately[0][0] >= REST and max(values) - min(values) <= slack

    def _goes_on(self, value: float, least: float) -> bool:
        """Whether it moves on after a rest in the direction in which it came there."""
        is_new = bool(self._turns) and self._rest[0] > self._turns[-1][0]
        return is_new and self._direction * (value - self._rest[1]) >= least

    def _turn(self, extreme: Point, direction: int, time: float) -> None:
        self._turns.append(extreme)
        self._direction, self.last_turn = direction, time

    def swings(self) -> list[Swing]:
        """The swings that are remembered, in order, the one under way last."""
        if not self._direction:
            return []
        running = self._high if self._direction > 0 else self._low
        points = [*self._turns, running]
        return [Swing(start, end, last - first) for (start, first), (end, last) in pairwise(points)]


def slowing(times: Sequence[float], angles: Sequence[float]) -> float:
    """The speed at the end of a movement as a part of its top speed; 1 for one too short to tell.

    Speeds are means over `SPEED_WINDOW`, or over one step where that is longer.
    """
    speeds, behind = [], 0
    for now in range(1, len(times)):
        while behind + 1 < now and times[now] - times[behind + 1] >= SPEED_WINDOW:
            behind += 1
        if times[now] - times[behind] >= SPEED_WINDOW:
            speeds.append(abs(angles[now] - angles[behind]) / (times[now] - times[behind]))
    return speeds[-1] / max(speeds) if speeds and max(speeds) > 0 else 1.0


def resting(times: Sequence[float], angles: Sequence[float], slack: float) -> float:
    """Seconds for which an angle has stayed within a slack of where it is now."""
    since = times[-1]
    for time, angle in zip(reversed(times), reversed(angles), strict=True):
        if abs(angle - angles[-1]) > slack:
            break
        since = time
    return times[-1] - since
