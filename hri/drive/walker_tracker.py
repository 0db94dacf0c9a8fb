"""Where people are and where they walk to, in the odometry frame.

A camera sees a sector ahead, with a delay. So each sight is placed by the pose that
the robot had then, and who has just gone out of the picture is taken to walk on for a while: the
robot has turned, they are still there. Meters, seconds.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Collection
from dataclasses import dataclass, field

import numpy as np

from hri.core.geometry import placed
from hri.core.signals import People, Pose2D

SEEN_S = 1.0
"""What a camera said longer ago is not taken in any more."""
REMEMBERED_S = 2.5
"""How long someone is remembered who is out of the picture."""
WATCHED_S = 0.8
"""Over which a walk is measured."""
LEAST_SIGHTS = 4
"""From which it can be told."""
WALKS = 0.35
"""Meters a second; slower is standing, or an error of the distance."""


@dataclass(slots=True)
class _Track:
    """Sights of one person: time, x, y."""

    sights: deque[tuple[float, float, float]] = field(default_factory=deque)

    def add(self, time: float, x: float, y: float) -> None:
        self.sights.append((time, x, y))
        while self.sights[0][0] < time - WATCHED_S:
            self.sights.popleft()

    @property
    def walks(self) -> bool:
        return len(self.sights) >= LEAST_SIGHTS and math.hypot(*velocity_of(self.sights)) > WALKS

    def at(self, now: float) -> tuple[float, float]:
        """Where they are now, if they go on as they did: x and y."""
        times, x, y = np.array(self.sights).T
        if not self.walks:
            return float(x[-1]), float(y[-1])
        vx, vy = velocity_of(self.sights)
        way = now - float(times.mean())
        return float(x.mean()) + vx * way, float(y.mean()) + vy * way


class WalkerTracker:
    """The people around one robot."""

    def __init__(self) -> None:
        self._tracks: dict[str, _Track] = {}
        self._poses: deque[tuple[float, Pose2D]] = deque()
        self._looked = -math.inf

    def see(self, now: float, pose: Pose2D, people: People | None) -> list[tuple[float, float]]:
        """Take in the newest of what the camera says; where everyone is now, x and y.

        Someone whose distance is not known is left out.
        """
        self._poses.append((now, pose))
        while self._poses[0][0] < now - SEEN_S:
            self._poses.popleft()
        if people is not None and people.time > self._looked and now - people.time <= SEEN_S:
            self._looked = people.time
            self._take(people)
        kept = now - REMEMBERED_S
        self._tracks = {id: t for id, t in self._tracks.items() if t.sights[-1][0] >= kept}
        return [track.at(now) for track in self._tracks.values()]

    def walking(self, now: float) -> list[tuple[float, float]]:
        """Where those are who walk, x and y."""
        return [track.at(now) for track in self._tracks.values() if track.walks]

    def _take(self, people: People) -> None:
        time = people.time
        _, pose = min(self._poses, key=lambda entry: abs(entry[0] - time))
        for person in people.persons:
            if person.is_visible and math.isfinite(person.distance):
                ahead = person.distance * math.cos(person.bearing)
                left = person.distance * math.sin(person.bearing)
                self._tracks.setdefault(person.id, _Track()).add(time, *placed(pose, ahead, left))


def velocity_of(sights: Collection[tuple[float, float, float]]) -> tuple[float, float]:
    """Meters a second in x and y that fit sights best: seconds, x and y of at least two times."""
    times, x, y = np.array(sights).T
    since = times - times.mean()
    spread = float(since @ since)
    return float(since @ x) / spread, float(since @ y) / spread
