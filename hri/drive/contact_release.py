"""Someone leans on the robot: it waits for them to go on, then looks for them and lets go.

Its bumper does not know on which side they are. So it turns until a beam sees them close by, then
until a free way that leads away from them is behind it, and backs off. Where that gets it nowhere
someone stands behind it, too. Pure arithmetic; directions in the odometry frame, radians, meters,
seconds.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping

import numpy as np

from hri.core.geometry import wrapped
from hri.core.signals import Pose2D, RangeReading, Twist
from hri.drive.polar_histogram import DIRECTIONS, WIDTH, Array, sector
from hri.hal.motion import REST

LEANS = 0.12
"""Meters of a beam that ends at someone who leans on the robot, at most."""
BESIDE = 0.3
"""Radians from where someone leaned within which a longer beam shows that they have gone."""
AWAY = -0.2
"""Cosine of the angle to whoever leans on it that a way must have at most to lead away."""
BETWEEN = 0.1
"""How much worse than the best, by that cosine, a way between two people may be."""
STANDS_S, STANDING = 0.15, 0.005
"""A robot that has moved by fewer meters in this many seconds stands still."""
WAITS_S = 10.0
"""Seconds for which it only turns when someone has come: most go on by themselves, and a robot
that backs off may meet them, or another, where no sensor looks."""
BREATH_S = 2.0
"""Seconds; someone who leans on it again within them has not gone."""
PUSHES_S = 0.6
"""Seconds of backing off without getting on after which someone must be behind."""
BACKING = 0.1
"""How fast it backs off, m/s."""
LEAST_BEHIND = 0.1
"""Meters that must be free behind it for that."""


class Leaning:
    """What presses the bumper of one robot."""

    def __init__(self, mounts: Mapping[str, Pose2D]) -> None:
        self.is_pressed = False
        self._mounts = mounts
        self._waits_until = self._felt = -math.inf
        self._seen: list[float] = []
        """Directions in which a beam sees someone lean on it, the newest last."""
        self._pushed: list[float] = []
        """The direction in which it could not get on itself last, if any."""
        self._poses: deque[tuple[float, Pose2D]] = deque()
        self._backs_since = math.inf
        self._turned, self._heading = 0.0, math.nan

    def see(self, now: float, pose: Pose2D, readings: Mapping[str, RangeReading]) -> None:
        """Where the robot is, and what its range sensors say."""
        self._poses.append((now, pose))
        while now - self._poses[0][0] > STANDS_S:
            self._poses.popleft()
        for id, mount in self._mounts.items():
            reading = readings.get(id)
            if self.is_pressed and reading is not None and reading.distance >= 0:
                toward = pose.heading + math.atan2(mount.y, mount.x)
                self._seen = [a for a in self._seen if abs(wrapped(a - toward)) > BESIDE]
                self._seen += [toward] if reading.distance < LEANS else []

    def feel(self, now: float, pose: Pose2D, is_pressed: bool) -> bool:
        """Take in whether something presses the bumper; whether that begins now."""
        begins, self.is_pressed = is_pressed and not self.is_pressed, is_pressed
        if begins:
            self._begin(now, pose)
        if is_pressed:
            self._felt = now
        return begins

    def _begin(self, now: float, pose: Pose2D) -> None:
        stands = self.stood(pose)
        self._seen, self._pushed = [], [] if stands else [pose.heading]
        self._backs_since, self._turned, self._heading = math.inf, 0.0, math.nan
        if now - self._felt > BREATH_S:
            self._waits_until = now + WAITS_S if stands else now

    def stood(self, pose: Pose2D) -> bool:
        """Whether the robot has not got on for a moment."""
        return all(math.dist((pose.x, pose.y), (p.x, p.y)) < STANDING for _, p in self._poses)

    def let_go(self, now: float, pose: Pose2D, ways: Array, rate: float) -> Twist:
        """How to get away from whoever leans on it; `ways` as in `free_ways`.

        It turns at `rate`, rad/s, and rests where no way leads away.
        """
        turn = self._turn(pose.heading, ways, rate)
        if turn is not None:
            self._backs_since = math.inf
            return turn
        return REST if now < self._waits_until else self._back_off(now, pose, ways)

    def _turn(self, heading: float, ways: Array, rate: float) -> Twist | None:
        """How to turn before backing off; None when a way that leads away is behind."""
        if not (self._seen or self._pushed):
            return Twist(0.0, rate) if self._looks_around(heading) else None
        free = self._leading_away(ways)
        if not len(free):
            return REST
        off = min((wrapped(float(way) + math.pi - heading) for way in free), key=abs)
        return None if abs(off) < WIDTH else Twist(0.0, math.copysign(rate, off))

    def _looks_around(self, heading: float) -> bool:
        """Whether it has not yet turned all around to look for them."""
        if not math.isnan(self._heading):
            self._turned += abs(wrapped(heading - self._heading))
        self._heading = heading
        return self._turned < math.tau

    def _leading_away(self, ways: Array) -> Array:
        """Free directions that lead away from all who lean on it, or between them at least."""
        free = DIRECTIONS[ways > LEAST_BEHIND]
        against = np.array([*self._pushed, *self._seen])
        toward = np.cos(free[:, None] - against).max(axis=1)
        found: Array = free[toward <= max(AWAY, toward.min(initial=1.0) + BETWEEN)]
        return found

    def _back_off(self, now: float, pose: Pose2D, ways: Array) -> Twist:
        """Back; someone who pushes something that does not give way learns that it is there."""
        twist = back_off(pose.heading, ways)
        self._backs_since = min(self._backs_since, now) if twist != REST else math.inf
        if now - self._backs_since > PUSHES_S and self.stood(pose):
            self._pushed = [pose.heading + math.pi]
            self._backs_since = math.inf
        return twist


def back_off(heading: float, ways: Array) -> Twist:
    """Slowly back where a robot came from, as far as nothing is known to be there.

    `ways` as in `free_ways`.
    """
    return Twist(-BACKING) if ways[sector(heading + math.pi)] > LEAST_BEHIND else REST
