"""Which beams come to an end nearer and nearer: what a robot is about to run into, or who comes.

A beam at the side of a robot that drives along a wall keeps its length. One that gets shorter shows
an edge whose rest is not visible yet, or a person who walks toward the robot.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping

from hri.core.signals import Pose2D, RangeReading

WINDOW_S = 0.2
"""Seconds over which a beam is watched."""
LEAST = 0.1
"""Meters a second by which a beam must get shorter; less is noise."""


class ApproachDetector:
    """Remembers the last readings of the beams that look ahead."""

    def __init__(self, mounts: Mapping[str, Pose2D]) -> None:
        ahead = [id for id, mount in mounts.items() if math.cos(mount.heading) > 0.3]
        self._history: dict[str, deque[tuple[float, float]]] = {id: deque() for id in ahead}

    def see(self, now: float, readings: Mapping[str, RangeReading]) -> None:
        """Take in readings; one that is not a number is left out."""
        for id, history in self._history.items():
            reading = readings.get(id)
            if reading is not None and not math.isnan(reading.distance):
                history.append((now, reading.distance))
            while len(history) > 1 and history[0][0] < now - WINDOW_S - 1e-6:
                history.popleft()

    @property
    def nearest(self) -> float:
        """The shortest beam that gets shorter, meters; infinity when none does."""
        return min(map(_closing, self._history.values()), default=math.inf)


def _closing(history: deque[tuple[float, float]]) -> float:
    """The newest of some lengths where they get shorter; else infinity."""
    if len(history) < 2:
        return math.inf
    (begun, first), (ended, last) = history[0], history[-1]
    if not math.isfinite(last) or ended <= begun:
        return math.inf
    return last if first - last > LEAST * (ended - begun) else math.inf
