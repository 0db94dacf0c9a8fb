"""The verbs of getting about: `go_to`, `follow`, `come_here`, `wander`.

All of them steer around what the range sensors of the configuration see (see `avoidance`), claim
"drive", write to the board for the command gate, and end when they are cancelled, stopped, or
another motion starts. People come from the board's slot "people".
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from hri.core.errors import HriError
from hri.core.geometry import after_move, wrapped
from hri.core.signals import Event, People, Pose2D, Twist
from hri.drive.arrival import Arrival
from hri.drive.avoidance import ROUTE, Avoidance, Manner, turn_to
from hri.drive.following import (
    Ending,
    Following,
    FollowingManner,
    Pursuit,
    Reason,
    tell,
    tell_ending,
)
from hri.drive.goal_behaviors import PEOPLE
from hri.drive.mechanics import mechanics_of, sensors
from hri.drive.nominal_pose import nominal_pose, note_arrival
from hri.drive.own_gate import see_to_gate
from hri.drive.progress import Approach, Patience
from hri.drive.target import Someone, Target
from hri.drive.tasks import piloting
from hri.drive.tasks_2003 import checked
from hri.drive.wandering import Wandering
from hri.hal.drive import Odometry
from hri.hal.motion import REST
from hri.hal.range_sensor import RangeSensor
from hri.task.context import TaskContext
from hri.task.task import task
from hri.task.units import UNIT_ANGLE, UNIT_DISTANCE, UNIT_TIME, in_si

USUAL = Manner()
"""How it wanders."""
WATCHFUL = Manner(watch=0.35)
"""How it goes to someone: they stay within the 60 degrees that a usual camera sees."""
EXACT, CLOSE = 0.01, 0.1
"""Meters from a place that count as there, where there is room and where there is not."""
AIM = 0.003
"""Meters from a place at which it stops, if it does not pass beside it; it rolls out a little."""
LEAST_NEAR = 0.005
"""Meters; nearer it does not get for sure."""
PATIENCE_S = 40.0
"""Seconds in which it must get nearer to a goal; else it gives up."""
NEARER = 0.1
"""Meters that count as nearer."""
LEAST_WAY = 0.3
"""Meters; a way that is narrower than this is not one that someone left for a robot."""
SEARCH_RATE = 0.6
"""Radians a second while it looks around: slow enough to see faces on the way."""


async def go_to(
    context: TaskContext, goal: Pose2D, *, faces: bool = False, near: float | None = None
) -> bool:
    """Go to a place of the odometry frame, around what is in the way; whether it got there.

    With `faces` it turns to the heading of the goal in the end, to 0.6 degrees. `near` is how many
    meters count as there; without it 1 cm, or 10 cm where things stand too close. Raises ValueError
    for a goal that is not finite, and a `near` below 5 mm.
    """
    return not await _why_not_gone_to(context, goal, faces, near)


async def _why_not_gone_to(
    context: TaskContext, goal: Pose2D, faces: bool, near: float | None
) -> str:
    """Go to a place; a sentence that says why it did not get there, empty when it did."""
    if not all(map(math.isfinite, (goal.x, goal.y, goal.heading))):
        raise ValueError(f"cannot go to {goal} - give finite numbers")
    manner = _exact(near)
    with _traveler(context, manner) as traveler:
        patience = Patience(PATIENCE_S, NEARER)
        arrival = Arrival(goal, CLOSE if near is None else 0.0)
        is_there = False

        def steer(now: float, pose: Pose2D) -> Twist | None:
            nonlocal is_there
            twist, is_there = traveler.toward(now, pose, goal, False)
            is_open = traveler.is_open(pose, goal)
            if arrival.is_at(now, pose, is_reached=is_there, is_open=is_open):
                twist = arrival.turn(now, pose, manner.turn_rate) if faces else REST
                is_there = twist == REST
            distance = math.dist((pose.x, pose.y), (goal.x, goal.y))
            return None if is_there or patience.is_over(now, distance) else twist

        with piloting(context) as pilot:
            await pilot.lead(steer)
        if not is_there:
            return await traveler.why_not(context, goal)
        now = context.clock.now()
        stands = traveler.pose(now)
        note_arrival(
            context.board, goal if faces else replace(goal, heading=stands.heading), stands, now
        )
        return ""


def _exact(near: float | None) -> Manner:
    """How it goes to a place that is given, as near as is asked for."""
    near = EXACT if near is None else near
    if not near >= LEAST_NEAR:
        raise ValueError(f"cannot come as near as {near} m - give at least {LEAST_NEAR} m")
    return Manner(near=near, aim=AIM if near <= EXACT else near)


async def follow(
    context: TaskContext, person: str = "", distance: float = 1.2, seconds: float = math.inf
) -> bool:
    """Follow someone by their id, whoever is attended to without one, `distance` meters apart.

    It faces them, looks for them when they are out of sight, and ends when they stay lost, cannot
    be reached, or after `seconds`; whether it had them in sight to the end. It comes no nearer than
    it may while it moves, whatever distance is asked for. Raises the events `target.lost`,
    `target.found` and in the end `target.left` (`reason`, `person`, `text`), and ValueError for a
    distance or a time that is not a number.
    """
    return bool(await follow_target(context, Someone(context, person), distance, seconds))


async def follow_target(
    context: TaskContext, target: Target, distance: float, seconds: float
) -> Ending:
    """Follow someone or something, as `follow` does; how that ended."""
    _refuse_nan(distance, seconds)
    with _traveler(context, WATCHFUL) as traveler:
        following = traveler.following(distance, target)
        approach = Approach(PATIENCE_S, NEARER)
        start, reason, halt = context.clock.now(), Reason.STOPPED, ""

        def steer(now: float, pose: Pose2D) -> Twist | None:
            nonlocal reason
            before = following.pursuit
            target.look(following, now, pose)
            goal = following.goal(now, pose)
            if following.pursuit is not before:
                tell(context.events, following.pursuit)
            twist, is_there = REST, True
            if goal is not None:
                twist, is_there = traveler.toward(now, pose, goal, True)
            if is_there or following.pursuit is not Pursuit.FOLLOWING or not following.target:
                approach.rest()
            elif approach.is_over(now, pose, following.target):
                reason = Reason.BLOCKED
            if following.pursuit is Pursuit.LOST:
                reason = Reason.LOST
            elif now >= start + seconds:
                reason = Reason.TIME
            return twist if reason is Reason.STOPPED else None

        def note(event: Event) -> None:
            nonlocal halt
            halt = event.properties["reason"]

        stops = context.events.subscribe("drive.stopped", note)
        try:
            with piloting(context) as pilot:
                await pilot.lead(steer)
        finally:
            stops.cancel()
        is_in_sight = following.pursuit is Pursuit.FOLLOWING
        lasted = context.clock.now() - start
        ending = Ending(reason, following.person, is_in_sight, lasted, halt, target.remedy)
        tell_ending(context.events, ending)
        return ending


async def come_here(context: TaskContext, person: str = "", distance: float = 1.2) -> bool:
    """Come to whoever is seen, `distance` meters before them, and face them; whether it did.

    A person who calls may be out of sight, and a voice does not show its direction: then it first
    looks around, once. It comes no nearer than it may while it moves, whatever distance is asked
    for. Raises ValueError for a distance that is not a number.
    """
    return await come_to(context, Someone(context, person), distance)


async def come_to(context: TaskContext, target: Target, distance: float) -> bool:
    """Come to someone or something, as `come_here` does; whether it did."""
    _refuse_nan(distance)
    with _traveler(context, WATCHFUL) as traveler:
        if not await look_around(context, target):
            return False
        following = traveler.following(distance, target)
        patience = Patience(PATIENCE_S, NEARER)
        is_there = False

        def steer(now: float, pose: Pose2D) -> Twist | None:
            nonlocal is_there
            if (away := target.look(following, now, pose)) is not None:
                patience.is_over(now, away)
            goal = following.goal(now, pose)
            if following.pursuit is Pursuit.LOST or patience.is_over(now, math.inf):
                return None
            if goal is None:
                return REST
            twist, is_there = traveler.toward(now, pose, goal, True)
            is_there = is_there and following.pursuit is Pursuit.FOLLOWING
            return None if is_there else twist

        with piloting(context) as pilot:
            await pilot.lead(steer)
        return is_there


async def look_around(context: TaskContext, target: Target) -> bool:
    """Turn on the spot until it is in sight, once around at most; whether it is."""
    turned, before = 0.0, math.nan
    is_seen = False

    def steer(now: float, pose: Pose2D) -> Twist | None:
        nonlocal turned, before, is_seen
        if not math.isnan(before):
            turned += abs(wrapped(pose.heading - before))
        before, is_seen = pose.heading, target.is_seen(now)
        return None if is_seen or turned >= math.tau else Twist(0.0, SEARCH_RATE)

    with piloting(context) as pilot:
        await pilot.lead(steer)
    return is_seen


async def wander(context: TaskContext, seconds: float = math.inf, seed: int = 0) -> None:
    """Drive for `seconds` from one nearby place to the next.

    Raises ValueError for a time that is not a number.
    """
    _refuse_nan(seconds)
    with _traveler(context) as traveler:
        wandering, end = Wandering(seed), context.clock.now() + seconds

        def steer(now: float, pose: Pose2D) -> Twist | None:
            if now >= end:
                return None
            return traveler.toward(now, pose, wandering.goal(now, pose), False)[0]

        with piloting(context) as pilot:
            await pilot.lead(steer)


@task("Hri.GoTo")
async def go_to_task(
    context: TaskContext, x: float, y: float, heading: float | None = None, near: float = 0.0
) -> None:
    """Go to a place of the odometry frame, in default units, around what is in the way.

    With a heading it turns there in the end. `near` is the distance that counts as there; 0 is 1 cm
    where there is room, else 10 cm. Fails when it does not get there.
    """
    place = in_si(UNIT_DISTANCE, x), in_si(UNIT_DISTANCE, y)
    faces = heading is not None
    goal = Pose2D(*place, in_si(UNIT_ANGLE, heading or 0.0))
    await go_to_point(context, goal, faces=faces, near=in_m(near))


@task("Hri.GoBy")
async def go_by(context: TaskContext, x: float, y: float, near: float = 0.0) -> None:
    """Go to a point of the robot's own frame, x ahead and y left, around what is in the way.

    In the end it faces along the straight line to there, whatever way it took. `near` is as for
    `go_to_task`. The next move starts from that place, not from where the robot stands beside it:
    errors of many moves do not add up. Fails when it does not get there.
    """
    with _traveler(context) as traveler:
        pose = traveler.pose(context.clock.now())
    start = nominal_pose(context.board, pose)
    goal = after_move(start, *(in_si(UNIT_DISTANCE, way) for way in (x, y)))
    await go_to_point(context, goal, near=in_m(near))


async def go_to_point(
    context: TaskContext, goal: Pose2D, *, faces: bool = True, near: float | None = None
) -> None:
    """Go to a place, and face as it says. Fails the task when it does not get there.

    Raises HriError for a goal that is not finite, and a `near` (meters) that is too small.
    """
    if why := await checked(_why_not_gone_to(context, goal, faces, near)):
        context.fail(why)


def in_m(near: float) -> float | None:
    """A distance in default units, in meters; None for 0."""
    return in_si(UNIT_DISTANCE, near) or None


@task("Hri.FollowPerson")
async def follow_person(
    context: TaskContext, person: str = "", distance: float = 0.0, seconds: float = 0.0
) -> Ending:
    """Follow someone, in default units; 0 is a usual distance, and no end.

    Gives how it ended: true where it had them in sight, with a `reason`; as text a sentence.
    """
    apart = in_si(UNIT_DISTANCE, distance) or FollowingManner().distance
    end = in_si(UNIT_TIME, seconds) or math.inf
    return await checked(follow_target(context, Someone(context, person), apart, end))


@task("Hri.ComeHere")
async def come_here_task(context: TaskContext, person: str = "", distance: float = 0.0) -> None:
    """Come to whoever is seen and face them, in default units; 0 is a usual distance."""
    apart = in_si(UNIT_DISTANCE, distance) or FollowingManner().distance
    if not await checked(come_here(context, person, apart)):
        context.fail("nobody could be reached - stand where the camera sees you")


@task("Hri.Wander")
async def wander_task(context: TaskContext, seconds: float = 0.0) -> None:
    """Go about, for ever when `seconds` (default units of time) is 0."""
    await checked(wander(context, in_si(UNIT_TIME, seconds) or math.inf))


def _refuse_nan(*values: float) -> None:
    if any(map(math.isnan, values)):
        raise ValueError(f"cannot travel by {', '.join(map(str, values))} - give numbers")


class _Traveler:
    """Sensors and steering, for as long as a verb lasts."""

    def __init__(self, context: TaskContext, manner: Manner) -> None:
        resources = context.resources
        self._slot = context.board.slot(PEOPLE)
        self._route = context.board.slot(ROUTE)
        self._odometry = resources.obtain("odometry", Odometry)
        self._sensors: dict[str, RangeSensor] = {}
        try:
            for id in sensors(resources, RangeSensor):
                self._sensors[id] = resources.obtain(id, RangeSensor)
            self._mechanics = mechanics_of(resources, self._sensors)
        except HriError:
            self.release(context)
            raise
        self._manner = manner
        self._avoidance = Avoidance(self._mechanics, self._manner)

    def following(self, distance: float, target: Target) -> Following:
        """How it follows at such a distance, or the least that avoidance lets it reach."""
        body = self._mechanics.radius + self._manner.margin
        least = body + target.clearance + self._manner.near
        return Following(FollowingManner(distance=max(distance, least)))

    def release(self, context: TaskContext) -> None:
        for resource in (self._odometry, *self._sensors.values()):
            context.resources.release(resource)

    def pose(self, now: float) -> Pose2D:
        return self._odometry.pose(now)

    def toward(self, now: float, pose: Pose2D, goal: Pose2D, faces: bool) -> tuple[Twist, bool]:
        """The velocity for now, and whether all is done."""
        readings = {id: sensor.read(now) for id, sensor in self._sensors.items()}
        self._avoidance.see(now, pose, readings, self.people)
        twist = self._avoidance.steer(now, pose, goal)
        self._route.set(self._avoidance.route, now)
        is_at = math.dist((pose.x, pose.y), (goal.x, goal.y)) <= self._manner.near
        if is_at and faces:
            twist = turn_to(pose, goal.heading, self._manner.turn_rate)
        return twist, is_at and twist == REST

    def is_open(self, pose: Pose2D, goal: Pose2D) -> bool:
        """Whether nothing stands on the straight way to a goal."""
        return self._avoidance.is_open(pose, goal)

    async def why_not(self, context: TaskContext, goal: Pose2D) -> str:
        """Why it did not get to a goal, and the remedy."""
        what = f"did not get to ({goal.x:.2f}, {goal.y:.2f}) m"
        pose, needed = self.pose(context.clock.now()), self._avoidance.needed
        width = await context.blocking(self._avoidance.narrow_way, pose, goal)
        if not LEAST_WAY <= width < needed:
            return f"{what} - clear the way"
        wide = f"a way there is about {width:.2f} m wide, and I need {needed:.2f} m"
        return f"{what}: {wide} - widen it, or clear another way"

    @property
    def people(self) -> People | None:
        """The newest of what the camera says."""
        people: People | None = self._slot.value
        return people


@contextmanager
def _traveler(context: TaskContext, manner: Manner = USUAL) -> Iterator[_Traveler]:
    see_to_gate(context)
    traveler = _Traveler(context, manner)
    try:
        yield traveler
    finally:
        traveler.release(context)
