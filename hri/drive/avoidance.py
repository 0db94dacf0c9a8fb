"""Going to a place around what is in the way: pure arithmetic on poses and range readings.

Three layers. A polar histogram over a short memory gives how far the robot could go in each
direction (see `histogram`). The way is the free direction that costs least, after VFH+ (Ulrich and
Borenstein 1998); where the straight way is blocked the robot goes around the obstacle on one side,
and keeps to that side until it is nearer to the goal than where it met the obstacle and the way
there is free, after DistBug (Kamon and Rivlin, "Sensory-based motion planning with global proofs",
1997). A governor lets it go only so fast that it can stop before what lies ahead.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hri.core.geometry import wrapped
from hri.core.signals import People, Pose2D, RangeReading, Twist
from hri.drive.approach_detector import ApproachDetector
from hri.drive.contact_release import Leaning, back_off
from hri.drive.mechanics import Mechanics
from hri.drive.path_planner import Route, find_route, narrow_way
from hri.drive.polar_histogram import (
    WIDTH,
    Array,
    Histogram,
    Memory,
    free_ways,
    sector,
    valleys,
)
from hri.drive.progress import Progress
from hri.drive.velocity_limits import PRUDENCE, safe_speed
from hri.drive.walker_tracker import WalkerTracker
from hri.hal.motion import REST
from hri.hal.motion_profile import velocity_for

PERSON_RADIUS = 0.25
"""Meters that a standing person takes."""
TURN_GAIN = 1.8
"""Radians a second for each radian off the direction."""
ON_THE_SPOT = 0.7
"""Radians off the direction from which the robot turns without going."""
BLOCKED_BELOW, FREE_ABOVE = 0.25, 0.4
"""Meters of free way below which a direction becomes blocked, and above which free."""
TARGET_COST, HEADING_COST, LAST_COST = 5.0, 2.0, 2.0
"""What each radian off the goal, off the heading and off the last choice costs, as in VFH+."""
FACING = 0.05
"""Radians off a heading that count as facing it."""
TURN_DECELERATION = 1.0
"""Radians a second squared with which it slows down before a heading."""
LATENCY_S = 0.1
"""Seconds for which a velocity goes on, in a network that ticks ten times a second."""
HOMING = 0.15
"""Meters from the goal within which it goes straight there, where that is free."""
AHEAD_ANGLES: Array = np.radians((0.0, 6.0, -6.0, 12.0, -12.0))
"""Directions that the governor looks at, radians from straight ahead, that one first."""
CLOSEST = 0.2
"""Meters of a beam that gets shorter at which it only creeps."""
CREEPING = 0.06
"""Meters a second."""
BACKING_S = 1.5
"""Seconds for which a robot that gets nowhere backs off."""
STARTLE_S = 0.2
"""Seconds for which it stands after a touch: the gate hears nobody who has not let go since."""
LOOKING = 0.8
"""Share of the turn rate with which it looks for whoever leans on it."""
BLIND_S = 0.5
"""Seconds for which a reading counts; without one of each sensor the robot does not go ahead."""
ASIDE = 0.2
"""Radians off the straight way at which it counts as going around something."""
AHEAD = 1.2
"""Meters along the route that the robot looks ahead at most."""
ROUTE = "route"
"""The board slot with the way that it means to take, for people to look at."""
REPLAN_S = 0.5
"""Seconds until it looks for a route again."""
WEAVE, WEAVE_S = 0.3, 2.5
"""Radians and seconds of a swing."""
WATCHING_WEAVE = 0.1
"""Radians of a swing while the robot keeps its eyes on someone."""
WATCHING_S = 2.5
"""Seconds that it waits with its eyes on them before it turns away to get past what is in the way:
whoever crosses is gone by then."""
GAIN = 0.4
"""Meters that another route must save before the robot leaves the one it is on."""
DOUBT_S = 15.0
"""Seconds after which what was seen may have moved on."""
FRESH_S = 3.0
"""Seconds; only newer points count when all ways seem to be blocked."""


@dataclass(frozen=True, slots=True)
class Manner:
    """How a robot goes."""

    speed: float = 0.3
    """Meters a second, where nothing is near."""
    blind_speed: float = 0.15
    """The same of a robot without range sensors, which finds things with its bumper: it then stands
    after 3 cm (0.1 s until it brakes, with 0.8 m/s²), where 0.3 m/s would take it 9 cm on."""
    turn_rate: float = 1.0
    """Radians a second."""
    deceleration: float = 0.4
    """Meters a second squared that it counts on before obstacles."""
    margin: float = 0.05
    """Meters kept free beside the body."""
    person_gap: float = 0.5
    """Meters kept free to people it knows of, while it moves."""
    memory_s: float = 60.0
    """How long it remembers what it saw."""
    near: float = 0.1
    """Meters from the goal that count as there."""
    aim: float = math.inf
    """Where it is there, it goes on until it is this near, meters, as long as the goal is ahead."""
    watch: float = math.inf
    """Radians by which it turns away from the heading of its goal, where someone is in sight of its
    camera; before it turns further, to get past something, it waits for a moment."""


def towards(pose: Pose2D, goal: Pose2D) -> tuple[float, float]:
    """Direction in the odometry frame, and meters, to a goal."""
    x, y = goal.x - pose.x, goal.y - pose.y
    return math.atan2(y, x), math.hypot(x, y)


def is_reached(pose: Pose2D, goal: Pose2D, manner: Manner) -> bool:
    """Whether the robot is as near to a goal as it is meant to come."""
    direction, distance = towards(pose, goal)
    is_ahead = abs(wrapped(direction - pose.heading)) <= ON_THE_SPOT
    return distance <= manner.near and (distance <= manner.aim or not is_ahead)


def turn_to(pose: Pose2D, heading: float, rate: float, facing: float = FACING) -> Twist:
    """Turn on the spot to a heading; rest when it is reached, within `facing` radians."""
    off = wrapped(heading - pose.heading)
    if abs(off) <= facing:
        return REST
    return Twist(0.0, velocity_for(off, rate, TURN_DECELERATION, LATENCY_S))


def straight_to(pose: Pose2D, goal: Pose2D, manner: Manner, ahead: float = math.inf) -> Twist:
    """Toward a goal, which lies in a straight line; rest when it is reached.

    `ahead` is the fastest that what is ahead allows, m/s.
    """
    if is_reached(pose, goal, manner):
        return REST
    direction, distance = towards(pose, goal)
    off = wrapped(direction - pose.heading)
    angular = min(max(TURN_GAIN * off, -manner.turn_rate), manner.turn_rate)
    if abs(off) > ON_THE_SPOT:
        return Twist(0.0, angular)
    # At the goal it is to stand; it turns toward it faster than it gets there.
    braking = velocity_for(distance, manner.speed, PRUDENCE * manner.deceleration, LATENCY_S)
    if distance * abs(math.sin(off)) > min(manner.near, manner.aim) / 2:
        braking = min(braking, TURN_GAIN / 2 * distance)
    return Twist(min(manner.speed * math.cos(off), braking, ahead), angular)


class Avoidance:
    """Steers one robot; everything it knows comes from `see`."""

    def __init__(self, mechanics: Mechanics, manner: Manner | None = None) -> None:
        self.mechanics = mechanics
        self.manner = _careful(manner or Manner(), mechanics)
        self.memory = Memory(self.manner.memory_s)
        self._histogram = Histogram(BLOCKED_BELOW, FREE_ABOVE)
        self._progress = Progress()
        self._route: Route | None = None
        self._replan_at = -math.inf
        self._side = 0
        self._discs: Sequence[tuple[float, float, float]] = ()
        self._walkers = WalkerTracker()
        self._approaching = ApproachDetector(mechanics.mounts)
        self._seen = self._fresh = self.memory.points
        self._chosen = 0.0
        self._aside_since: float | None = None
        """Seconds, when the way began to lead out of sight of whom it watches."""
        self._startled_until = self._backing_until = -math.inf
        self._is_moving = self._is_blind = False
        self._leaning = Leaning(mechanics.mounts)

    def see(
        self,
        now: float,
        pose: Pose2D,
        readings: Mapping[str, RangeReading],
        people: People | None = None,
    ) -> None:
        """Take in range readings by sensor, and the newest of what the camera says of people.

        A sensor that says nothing, nothing new or no number might look at anything: until it speaks
        again the robot turns, but does not go ahead.
        """
        self.memory.see(now, pose, readings, self.mechanics)
        reach = PERSON_RADIUS + self.manner.person_gap
        self._discs = [(x, y, reach) for x, y in self._walkers.see(now, pose, people)]
        self.memory.pass_by(now, self._walkers.walking(now))
        self._approaching.see(now, readings)
        self._leaning.see(now, pose, readings)
        known = (readings.get(id) for id in self.mechanics.mounts)
        self._is_blind = not all(_is_sound(reading, now) for reading in known)

    def touch(self, now: float, pose: Pose2D, is_pressed: bool) -> None:
        """Take in whether something presses the bumper, which does not know on which side.

        A robot that went somewhere has driven into a thing: it remembers that something is ahead,
        and backs off until that is free. To one that stood someone has come, from wherever.
        """
        if not self._leaning.feel(now, pose, is_pressed):
            return
        self._startled_until = now + STARTLE_S
        if self._leaning.stood(pose):
            return
        reach = self.mechanics.radius + self.manner.margin
        for aside in (-0.5, 0.0, 0.5):
            angle = pose.heading + aside
            x, y = pose.x + reach * math.cos(angle), pose.y + reach * math.sin(angle)
            self.memory.feel(x, y, now, angle)

    def steer(self, now: float, pose: Pose2D, goal: Pose2D) -> Twist:
        """The velocity for now on the way to a goal; rest when it is reached, or nothing is free.

        The heading of the goal counts only where the robot keeps its eyes on someone there.
        """
        self._seen, self._fresh = self.memory.points, self.memory.since(now - DOUBT_S)
        ways = free_ways(pose, self._seen, self._reach, self._discs)
        if is_reached(pose, goal, self.manner):
            self._progress.rest()
            self._route = None
            twist = REST
        elif now < self._startled_until:
            twist = REST
        elif self._leaning.is_pressed:
            twist = self._leaning.let_go(now, pose, ways, LOOKING * self.manner.turn_rate)
        elif now < self._backing_until:
            twist = back_off(pose.heading, ways)
        else:
            self._note_progress(now, pose)
            is_last_bit = towards(pose, goal)[1] <= HOMING and self.is_open(pose, goal)
            twist = self._home(pose, goal) if is_last_bit else self._forth(now, pose, goal, ways)
        self._is_moving = twist.linear > 0
        return twist

    def is_touched(self, now: float) -> bool:
        """Whether something presses the bumper, or did a moment ago: a gate that was dropped hears
        only who rests then.
        """
        return now < self._startled_until or self._leaning.is_pressed

    def is_open(self, pose: Pose2D, goal: Pose2D) -> bool:
        """Whether nothing stands on the straight way to a goal."""
        direction, distance = towards(pose, goal)
        return self._free(pose, np.array([direction - pose.heading]), self._reach) >= distance

    @property
    def side(self) -> int:
        """On which side it goes around an obstacle: 1 left, -1 right, 0 for none."""
        return self._side

    @property
    def route(self) -> tuple[tuple[float, float], ...]:
        """Points of the way that it means to take, meters in the odometry frame; often none."""
        return () if self._route is None else self._route.points

    @property
    def needed(self) -> float:
        """How wide a way must be, meters."""
        return 2 * self._reach

    def narrow_way(self, pose: Pose2D, goal: Pose2D) -> float:
        """How wide the way is that a slimmer robot would take, meters; at least `needed` if none.

        It may take half a second, so not on the robot loop.
        """
        start, end = (pose.x, pose.y), (goal.x, goal.y)
        return narrow_way(start, end, self.memory.points, self._reach)

    @property
    def _reach(self) -> float:
        return self.mechanics.radius + self.manner.margin

    def _note_progress(self, now: float, pose: Pose2D) -> None:
        if self._progress.is_stuck(now, pose):
            self._progress.rest()
            self._route = None
            self._backing_until = now + BACKING_S

    def _home(self, pose: Pose2D, goal: Pose2D) -> Twist:
        """The last bit of the way."""
        self._route = None
        return straight_to(pose, goal, self.manner, self._governed(pose))

    def _forth(self, now: float, pose: Pose2D, goal: Pose2D, ways: Array) -> Twist:
        """Along the route, or around what is in its way."""
        lead, way = self._lead(now, pose, goal)
        is_free = self._histogram.update(ways, way)
        direction = lead if is_free[sector(lead)] else self._cheapest(pose, lead)
        if self._keeps_watching(now, goal, direction):
            # Its beams swing past what stands there no more.
            heading = goal.heading + self._swing(now, WEAVE)
            return turn_to(pose, heading, self.manner.turn_rate)
        if direction is None:  # nothing is free: look around on the spot
            return Twist(0.0, (self.side or 1) * self.manner.turn_rate * 0.6)
        self._chosen = direction
        direction += self._weave(now, direction)
        _, distance = towards(pose, goal)
        course = Pose2D(
            pose.x + distance * math.cos(direction), pose.y + distance * math.sin(direction)
        )
        return straight_to(pose, course, self.manner, self._governed(pose))

    def _keeps_watching(self, now: float, goal: Pose2D, direction: float | None) -> bool:
        """Whether it stands and faces whom it watches, since no way leads toward them yet."""
        aside = math.pi if direction is None else abs(wrapped(direction - goal.heading))
        if aside <= self.manner.watch:
            self._aside_since = None
            return False
        if self._aside_since is None:
            self._aside_since = now
        return math.isfinite(self.manner.watch) and now - self._aside_since < WATCHING_S

    def _weave(self, now: float, direction: float) -> float:
        """Radians to the side: it swings its few beams to and fro, where there is room for that."""
        aside = self._swing(now, WEAVE if math.isinf(self.manner.watch) else WATCHING_WEAVE)
        return aside if self._histogram.is_free[sector(direction + 2 * aside)] else 0.0

    def _swing(self, now: float, width: float) -> float:
        """Radians to the side at which its beams look now; 0 without any."""
        return width * math.sin(math.tau * now / WEAVE_S) if self.mechanics.mounts else 0.0

    def _lead(self, now: float, pose: Pose2D, goal: Pose2D) -> tuple[float, float]:
        """Direction to the next point of the route, and meters to there."""
        if self._route is None or now >= self._replan_at:
            self._replan_at = now + REPLAN_S
            self._route = self._routed(now, pose, goal)
        x, y = self._route.ahead(pose, self._fresh, self._reach, AHEAD)
        direction, way = towards(pose, Pose2D(x, y))
        self._note_side(wrapped(direction - towards(pose, goal)[0]))
        return direction, way

    def _note_side(self, off: float) -> None:
        """Remember the side on which the route leaves the straight way, until it is back on it."""
        if abs(off) > ASIDE:
            self._side = 1 if off > 0 else -1
        elif abs(off) < ASIDE / 4:
            self._side = 0

    def _routed(self, now: float, pose: Pose2D, goal: Pose2D) -> Route:
        """A new route, or the old one where the new one is hardly shorter."""
        start, end = (pose.x, pose.y), (goal.x, goal.y)
        route = find_route(start, end, self._fresh, self._reach, self._doubtful())
        if not route.is_free:
            # Something that moves has left its traces all around: only what is new counts.
            self.memory.forget(now - FRESH_S)
            self._seen = self._fresh = self.memory.points
            route = find_route(start, end, self._fresh, self._reach, self._doubtful())
        old = self._route.rest(pose) if self._route is not None else None
        if old is None or math.dist(old.points[-1], end) > self.manner.near:
            return route
        if route.length <= old.length - GAIN or not old.is_clear(self._fresh, self._reach):
            return route
        return old

    def _doubtful(self) -> Array:
        """What may have moved on when the robot gets there: things of long ago, and people.

        People are rings of points. A robot that planned a long way around each of them would be
        on its way back by the time they have moved.
        """
        rings = [
            (x + (r - 0.01) * math.cos(a), y + (r - 0.01) * math.sin(a))
            for x, y, r in self._discs
            for a in np.linspace(0, math.tau, 12, endpoint=False)
        ]
        return np.vstack((self._seen, *rings)) if rings else self._seen

    def _cheapest(self, pose: Pose2D, direction: float) -> float | None:
        """The edge of a free valley that costs least, by the cost function of VFH+."""
        edges = [
            WIDTH * edge
            for first, count in valleys(self._histogram.is_free)
            for edge in (first, first + count - 1)
        ]

        def cost(candidate: float) -> float:
            return (
                TARGET_COST * abs(wrapped(candidate - direction))
                + HEADING_COST * abs(wrapped(candidate - pose.heading))
                + LAST_COST * abs(wrapped(candidate - self._chosen))
            )

        return min(edges, key=cost, default=None)

    def _governed(self, pose: Pose2D) -> float:
        """The speed from which it can stop before what lies ahead, m/s.

        Straight ahead the margin counts. Slightly aside, where it may steer to next, only the body
        does, and slow going is always allowed: it must get along something it stands beside. The
        same holds for what a beam comes nearer to, since only a spot of it is seen yet.
        """
        if self._is_blind:
            return 0.0
        ahead = self._free(pose, AHEAD_ANGLES[:1], self._reach)
        aside = self._free(pose, AHEAD_ANGLES[1:], self.mechanics.radius)
        closing = self._safe(self._approaching.nearest - CLOSEST)
        return min(self._safe(ahead), max(min(self._safe(aside), closing), CREEPING))

    def _free(self, pose: Pose2D, angles: Array, reach: float) -> float:
        """Meters free in the worst of some directions, radians from straight ahead."""
        ways = free_ways(pose, self._seen, reach, self._discs, pose.heading + angles)
        return float(ways.min())

    def _safe(self, free: float) -> float:
        return safe_speed(free, 0.0, self.manner.deceleration, self._is_moving)


def _careful(manner: Manner, mechanics: Mechanics) -> Manner:
    """How a robot goes with the range sensors it has."""
    if mechanics.mounts:
        return manner
    return replace(manner, speed=min(manner.speed, manner.blind_speed))


def _is_sound(reading: RangeReading | None, now: float) -> bool:
    """Whether a sensor says something that counts."""
    return reading is not None and reading.distance >= 0 and now - reading.time <= BLIND_S
