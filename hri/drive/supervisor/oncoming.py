"""People who approach: beams that get shorter than the robot's own motion explains, and how slow to
go then.

Pure arithmetic on readings with their times, and on how far the wheels have rolled meanwhile. All
places are in the robot's frame, and move in it as the robot moves.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise

from hri.core.signals import Pose2D
from hri.hal.motion import Way
from hri.hal.motion_profile import stopping_speed

WALKING = 1.0
"""Meters a second at which people walk about at home."""
REACTION = 0.05
"""Seconds from a reading to brakes, at the 20 turns a second of a slow network."""
KEEP = 0.04
"""Meters that are to be left when the robot stands."""
SLOPE = 1.5
"""Meters by which a beam gets shorter for each meter that its end sweeps aside, along a wall."""
NOISE, RELATIVE_NOISE = 0.02, 0.03
"""Meters, and the share of the reading, by which two readings of the same thing may differ."""
WINDOW_S = 0.2
"""Seconds over which a beam is watched."""
SAME = 0.1
"""Meters between two ends of beams that may be the same thing."""
SETTLED = 0.25
"""Seconds after which a thing that is still in the same place does not move."""
HELD = 1.0
"""Seconds for which someone who walked is expected where they may have got to since."""
DOUBTED = 0.1
"""The same of what a beam has only just met: it may be the edge of a thing."""
REMEMBERED = 10.0
"""Seconds for which it remembers a thing that no beam sees any more."""
PASSED = 0.05
"""Meters beside a beam within which it shows that a thing is gone."""
NEAR_PEOPLE, MET_S = 0.1, 4.0
"""Meters a second that are enough, and for how many seconds, after someone came near: they, or
whoever is with them, may come again from where no sensor looks."""
SHORT_REACH = 0.5
"""Meters that every range sensor reaches."""


@dataclass(slots=True)
class _Place:
    """A place in the robot's frame, meters."""

    x: float
    y: float

    def roll(self, rolled: Way) -> None:
        """The robot has moved: it lies elsewhere, seen from there."""
        cos, sin = math.cos(rolled.angular), math.sin(rolled.angular)
        ahead = self.x - rolled.linear
        self.x, self.y = cos * ahead + sin * self.y, cos * self.y - sin * ahead

    def is_near(self, other: _Place, distance: float) -> bool:
        return math.hypot(self.x - other.x, self.y - other.y) <= distance


@dataclass(slots=True)
class _Spot(_Place):
    """Where beams ended, and when for the first and the last time."""

    first: float
    last: float


@dataclass(slots=True)
class _Mover(_Place):
    """Someone who moved, or may move, and when that was."""

    time: float
    held: float
    """Seconds for which they are expected near there."""


@dataclass(frozen=True, slots=True)
class _Said:
    """A reading, and how far the wheels had rolled."""

    time: float
    distance: float
    rolled: Way


@dataclass(slots=True)
class _Beam:
    """A range sensor, and what it said lately."""

    mount: Pose2D
    reach: float = SHORT_REACH
    said: deque[_Said] = field(default_factory=deque)

    def end(self, distance: float) -> _Place:
        """Where it ends."""
        return _Place(
            self.mount.x + distance * math.cos(self.mount.heading),
            self.mount.y + distance * math.sin(self.mount.heading),
        )

    def passes(self, place: _Place, length: float) -> bool:
        """Whether it passes through a place within a distance, meters."""
        cos, sin = math.cos(self.mount.heading), math.sin(self.mount.heading)
        x, y = place.x - self.mount.x, place.y - self.mount.y
        return 0 < x * cos + y * sin < length and abs(y * cos - x * sin) < PASSED

    def has_said(self, distance: float) -> bool:
        return math.isfinite(distance) and any(s.distance == distance for s in [*self.said][-1:])

    def remember(self, said: _Said) -> None:
        self.said.append(said)
        while len(self.said) > 1 and self.said[0].time < said.time - WINDOW_S:
            self.said.popleft()

    def is_approached(self, said: _Said) -> bool:
        """Whether it got shorter, again and again, than the robot's motion explains.

        Of things that stand still it gets shorter once, where it meets the edge of one.
        """
        words = [*self.said, said]
        lengths = [min(word.distance, self.reach) for word in words]
        steps = [before - after for before, after in pairwise(lengths)]
        return sum(steps) - max(steps, default=0.0) > self._explained(words[0], said)

    def _explained(self, before: _Said, after: _Said) -> float:
        """Meters by which it may get shorter on things that stand still."""
        ahead = after.rolled.linear - before.rolled.linear
        turned = after.rolled.angular - before.rolled.angular
        heading, distance = self.mount.heading, after.distance
        aside = abs(ahead * math.sin(heading)) + distance * abs(turned)
        toward = max(0.0, ahead * math.cos(heading))
        return toward + SLOPE * aside + NOISE + RELATIVE_NOISE * distance


class Oncoming:
    """Watches the surroundings of one round body through beams."""

    def __init__(self, mounts: Mapping[str, Pose2D], radius: float) -> None:
        """`mounts`: where beams start and look, in the robot's frame; `radius`: of the body, m."""
        self._radius = radius
        self._beams = {name: _Beam(mount) for name, mount in mounts.items()}
        self._spots: list[_Spot] = []
        self._movers: list[_Mover] = []
        self._rolled = Way()
        self._met = -math.inf

    def see(self, now: float, rolled: Way, ranges: Mapping[str, float]) -> None:
        """Take in what sensors say, meters, and how far the wheels have rolled since whenever.

        Invalid distances are left out, and a reading that is the same to the last digit is taken
        for the same word.
        """
        self._roll(Way(rolled.linear - self._rolled.linear, rolled.angular - self._rolled.angular))
        self._rolled = rolled
        self._movers = [mover for mover in self._movers if now - mover.time <= mover.held]
        self._spots = [spot for spot in self._spots if now - spot.last <= REMEMBERED]
        for name, beam in self._beams.items():
            distance = ranges.get(name, math.nan)
            if distance >= 0 and not beam.has_said(distance):
                self._take(beam, _Said(now, distance, rolled))

    def speed(self, now: float, deceleration: float) -> float:
        """The speed from which the robot stands before anyone who comes reaches it, m/s.

        `deceleration` is what the brakes do at once, m/s²; infinite when nobody comes.
        """
        gaps = (self._gap(mover, now) for mover in self._movers)
        gap = min(gaps, default=math.inf)
        return stopping_speed(gap - KEEP, REACTION, deceleration, WALKING)

    def pace(self, now: float) -> float:
        """The speed that is enough near people, m/s; infinite where nobody was met lately."""
        return NEAR_PEOPLE if now - self._met <= MET_S else math.inf

    # --- places ---

    def _roll(self, rolled: Way) -> None:
        if rolled == Way():
            return
        for spot in self._spots:
            spot.roll(rolled)
        for mover in self._movers:
            mover.roll(rolled)

    def _take(self, beam: _Beam, said: _Said) -> None:
        self._clear(beam, said.distance)
        if math.isfinite(said.distance):
            beam.reach = max(beam.reach, said.distance)
            self._meet(beam.end(said.distance), beam.is_approached(said), said.time)
        beam.remember(said)

    def _meet(self, end: _Place, is_approached: bool, now: float) -> None:
        """A beam ends there."""
        if not self._is_settled(end, now):
            self._met = now if is_approached else self._met
            self._movers.append(_Mover(end.x, end.y, now, HELD if is_approached else DOUBTED))
        for spot in self._spots:
            if spot.is_near(end, SAME / 2):
                spot.last = now
                return
        self._spots.append(_Spot(end.x, end.y, now, now))

    def _is_settled(self, end: _Place, now: float) -> bool:
        """Whether something stands there, or so near that it may be the same thing."""
        return any(now - s.first >= SETTLED and s.is_near(end, SAME) for s in self._spots)

    def _clear(self, beam: _Beam, distance: float) -> None:
        """Forget what a beam passed through."""
        length = min(distance, beam.reach) - SAME
        self._spots = [spot for spot in self._spots if not beam.passes(spot, length)]

    def _gap(self, mover: _Mover, now: float) -> float:
        """Meters that may be left between the body and someone, wherever they went."""
        age = now - mover.time
        return math.hypot(mover.x, mover.y) - self._radius - WALKING * age
