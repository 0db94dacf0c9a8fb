"""Following someone at a distance, facing them; looking for them when they are lost.

Pure: what is seen comes in with its time, goals in the odometry frame go out. A target that is lost
is looked for where it must have walked to; from there the robot turns around twice, first to the
side on which it went out of sight. Meters, radians, seconds.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from enum import Enum

from hri.core.event_bus import EventBus
from hri.core.geometry import placed
from hri.core.signals import People, Person, Pose2D
from hri.drive.walker_tracker import velocity_of

STAND = "stand where the camera sees you"
LOST_S = 1.0
"""Without a sight of it for so long, a target is lost."""
SEARCH_RATE = 0.6
"""Radians a second while it looks around."""
LOOK_AROUND = 2 * math.tau
"""Radians that it turns, searching, before it gives up."""
WALK_S, WALKS_ON_S = 1.5, 2.0
"""Seconds over which the walk of a target is measured, and for which it is taken to walk on."""
FASTEST = 1.5
"""Meters a second that a person walks."""
SLACK = 0.15
"""Meters by which the target may come nearer or go before the robot follows again."""


class Pursuit(Enum):
    """How the following goes."""

    WAITING = "waiting"
    """Nobody was seen yet."""
    FOLLOWING = "following"
    SEARCHING = "searching"
    LOST = "lost"
    """It was searched for in vain."""


@dataclass(frozen=True, slots=True)
class FollowingManner:
    """How someone is followed."""

    distance: float = 1.2
    """Between the middles of the robot and of who is followed."""
    patience_s: float = 20.0
    """After so long it is given up, wherever the search has got to."""


class Reason(Enum):
    """Why following someone ended."""

    TIME = "time"
    """The seconds that it was given are over."""
    LOST = "lost"
    """They were out of sight, and looked for in vain."""
    BLOCKED = "blocked"
    """They stay where they are, and it comes no nearer."""
    STOPPED = "stopped"
    """A stop, a touch or another motion ended it."""


@dataclass(frozen=True, slots=True)
class Ending:
    """How following someone ended; true where it had them in sight to the end."""

    reason: Reason
    person: str
    """Id of who was followed last; empty where nobody was seen."""
    is_in_sight: bool
    seconds: float
    """How long it lasted."""
    halt: str = ""
    """What stopped it: "bump", "halt"; empty where another motion did."""
    remedy: str = STAND
    """What to do when nothing is seen."""

    def __bool__(self) -> bool:
        return self.is_in_sight

    def __str__(self) -> str:
        who = self.person or "nobody"
        match self.reason:
            case Reason.TIME if not self.person:
                return f"saw nobody for {self.seconds:.0f} s - {self.remedy}"
            case Reason.TIME:
                state = "in sight" if self.is_in_sight else "out of sight"
                return f"followed {who}, {state} at the end: the {self.seconds:.0f} s are over"
            case Reason.LOST:
                return f"lost sight of {who} for good - {self.remedy}"
            case Reason.BLOCKED:
                return f"cannot come nearer to {who} - clear the way"
            case _:
                by = {"bump": "a touch", "halt": "a stop"}.get(self.halt, "another motion")
                return f"followed {who} until {by} ended it"


class Following:
    """Where to go and what to face, tick by tick."""

    def __init__(self, manner: FollowingManner | None = None) -> None:
        self.manner = manner or FollowingManner()
        self.pursuit = Pursuit.WAITING
        self.person = ""
        """Id of who was seen last by `look`, or name of what; empty before."""
        self._target: tuple[float, float] | None = None
        self._sights: deque[tuple[float, float, float]] = deque()
        """Seconds, x and y of the last WALK_S."""
        self._side = 1.0
        self._seen = self._looked = -math.inf
        self._turned = 0.0
        self._last: tuple[float, float] | None = None
        self._spot: Pose2D | None = None
        self._poses: deque[tuple[float, Pose2D]] = deque()
        """Where the robot was lately, with the seconds."""

    def see(self, now: float, pose: Pose2D, bearing: float, distance: float) -> None:
        """The target is there, seen from a pose; NaN is not a sighting."""
        if not (math.isfinite(bearing) and math.isfinite(distance) and distance >= 0):
            return
        away = placed(pose, distance * math.cos(bearing), distance * math.sin(bearing))
        self._target, self._seen = away, now
        self._sights.append((now, *away))
        while now - self._sights[0][0] > WALK_S:
            self._sights.popleft()
        self.pursuit = Pursuit.FOLLOWING

    def look(self, now: float, pose: Pose2D, people: People | None, id: str) -> Person | None:
        """Take in the newest people from the camera; `sight_of` chooses the followed one, who then
        stays it until they are given up. They are where the robot saw them from when the picture
        was taken; old results do not count.
        """
        self._poses.append((now, pose))
        while now - self._poses[0][0] > LOST_S:
            self._poses.popleft()
        if people is None or people.time <= self._looked:
            return None
        self._looked = people.time
        if self.pursuit is not Pursuit.LOST:
            id = id or self.person
        if (person := sight_of(people, id, now)) is not None:
            self.person = person.id
            _, taken = min(self._poses, key=lambda entry: abs(entry[0] - people.time))
            self.see(now, taken, person.bearing, person.distance)
        return person

    @property
    def target(self) -> tuple[float, float] | None:
        """Where the target was seen last, x and y of the odometry frame."""
        return self._target

    def goal(self, now: float, pose: Pose2D) -> Pose2D | None:
        """Where to go and, once there, what to face; None to stay as it is."""
        if self._target is None or self.pursuit is Pursuit.LOST:
            return None
        if now - self._seen <= LOST_S:
            return self._keep_up(pose, self._expected(now, self._target))
        return self._search(now, pose, self._expected(now, self._target))

    def _expected(self, now: float, seen: tuple[float, float]) -> tuple[float, float]:
        """Where the target is now, if it walks on for a while as it did."""
        ahead = min(WALKS_ON_S, now - self._seen)
        if ahead <= 0 or self._sights[-1][0] - self._sights[0][0] < WALK_S / 2:
            return seen
        velocity = velocity_of(self._sights)
        speed = math.hypot(*velocity)
        ahead *= min(1.0, FASTEST / speed) if speed > 0 else 0.0
        return seen[0] + velocity[0] * ahead, seen[1] + velocity[1] * ahead

    def _keep_up(self, pose: Pose2D, target: tuple[float, float]) -> Pose2D:
        """A place at the right distance on the straight way to the target."""
        x, y = target[0] - pose.x, target[1] - pose.y
        apart, facing = math.hypot(x, y), math.atan2(y, x)
        excess = apart - self.manner.distance
        if excess < (SLACK if self._spot is None else 0.0):
            # Near enough: stand and face. It does not drive backward, where it sees nothing.
            self._spot = None
            return Pose2D(pose.x, pose.y, facing)
        self._spot = pose
        share = excess / apart
        return Pose2D(pose.x + x * share, pose.y + y * share, facing)

    def _search(self, now: float, pose: Pose2D, target: tuple[float, float]) -> Pose2D | None:
        """Go to where it must be, then turn around."""
        if self.pursuit is not Pursuit.SEARCHING:
            self.pursuit, self._turned, self._last = Pursuit.SEARCHING, 0.0, None
            left = math.atan2(target[1] - pose.y, target[0] - pose.x) - pose.heading
            self._side = math.copysign(1.0, math.sin(left))
        if now - self._seen > self.manner.patience_s:
            self.pursuit = Pursuit.LOST
            return None
        if math.dist((pose.x, pose.y), target) > self.manner.distance + SLACK and not self._last:
            return self._keep_up(pose, target)
        return self._look_around(now, pose)

    def _look_around(self, now: float, pose: Pose2D) -> Pose2D | None:
        if self._last is not None:
            self._turned += abs(math.remainder(pose.heading - self._last[1], math.tau))
        self._last = (now, pose.heading)
        if self._turned >= LOOK_AROUND:
            self.pursuit = Pursuit.LOST
            return None
        # Always a little ahead of where it looks now: it goes on turning.
        return Pose2D(pose.x, pose.y, pose.heading + self._side * SEARCH_RATE)


def sight_of(people: People | None, id: str, now: float) -> Person | None:
    """The person of that id, without one whoever is attended to, or the nearest of known distance.

    None when they are out of sight, or nobody has looked for a while.
    """
    if people is None or now - people.time > LOST_S:
        return None
    wanted = id or people.attended
    seen = [p for p in people.persons if p.is_visible and math.isfinite(p.distance)]
    if wanted:
        seen = [person for person in seen if person.id == wanted]
    return min(seen, key=lambda person: person.distance, default=None)


def tell(events: EventBus, pursuit: Pursuit) -> None:
    """Raise the event of a change to this."""
    if pursuit is Pursuit.FOLLOWING:
        events.raise_event("target.found")
    elif pursuit in (Pursuit.SEARCHING, Pursuit.LOST):
        events.raise_event("target.lost", given_up=pursuit is Pursuit.LOST)


def tell_ending(events: EventBus, ending: Ending) -> None:
    """Raise the event of the end: `target.left`."""
    reason = ending.reason.value
    events.raise_event("target.left", reason=reason, person=ending.person, text=str(ending))
