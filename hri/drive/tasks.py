"""The verbs of driving: `move`, `turn`, `stop`.

A motion claims "drive" and writes velocities to the board, where the command gate reads them.
Starting one ends the one before; `stop`, `CommandGate.halt` and a bump end it too. It ends by
itself at the goal, or when it gets nowhere.

Its velocity follows from the way that is left, so the supervisor may hold it up. A motion of
`hri.hal.motion` follows a plan in time, to the millimeter, and fails when it is held up: that is
for programs that command the drive itself. Both use `hri.hal.motion_profile`.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import ClassVar

from hri.core.errors import HriError
from hri.core.geometry import along_arc, wrapped
from hri.core.signals import Pose2D, Twist
from hri.drive.behaviors import COMMAND, LIFT, MOTION, CommandGate
from hri.drive.nominal_pose import nominal_pose, note_arrival
from hri.drive.own_gate import see_to_gate
from hri.drive.progress import Patience
from hri.hal.drive import DriveSystem, Odometry, Stop, longest_move, too_long
from hri.hal.motion import REST
from hri.hal.motion_profile import velocity_for
from hri.hal.pending import Interrupted
from hri.hal.resource import Description
from hri.task.context import TaskContext
from hri.task.order import said

CRUISE = 0.3
"""Meters a second, when nobody says how fast; an upper limit of what is safe near people."""
TURN_RATE = 1.0
"""Radians a second."""

_PERIOD = 0.05
_HEADROOM = 0.8
"""Share of what the gate slows down with that a motion counts on."""
_HEADING_GAIN = 2.0
"""Radians a second for each radian off the heading."""
_PATIENCE_S = 2.0
"""A motion that gets nowhere for so long is over."""
_LONGEST_ROLL_S = 2.0
_STANDING = 0.005
"""A base that is slower, in m/s and rad/s, will stand by the next look."""


async def move(
    context: TaskContext,
    distance_m: float,
    speed: float | None = None,
    acceleration: float | None = None,
) -> float:
    """Drive straight ahead, backward when negative; the distance really traveled, with its sign.

    With an `acceleration` (m/s²) it speeds up and slows down no harder than that; the supervisor
    may allow less. Raises ValueError for a distance that is not finite, or a speed (m/s) or
    acceleration that is not above 0, HriError for a distance beyond `longest_move` of the drive.
    """
    refuse_too_long(
        context, distance_m, f"{distance_m:g} m", f"give {distance_m / 100:g} if you meant cm"
    )
    way = _Straight(distance_m, _above_0(speed, CRUISE, "m/s"), acceleration)
    with piloting(context) as pilot:
        return await pilot.follow(way)


async def turn(
    context: TaskContext,
    angle_rad: float,
    rate: float | None = None,
    acceleration: float | None = None,
) -> float:
    """Turn on the spot, left when positive, also more than once round; the angle really turned.

    With an `acceleration` (rad/s²) it speeds up and slows down no harder than that; the supervisor
    may allow less. Raises ValueError for an angle that is not finite, or a
    rate (rad/s) or acceleration that is not above 0.
    """
    way = _Turn(angle_rad, _above_0(rate, TURN_RATE, "rad/s"), acceleration)
    with piloting(context) as pilot:
        return await pilot.follow(way)


async def stop(context: TaskContext) -> None:
    """End any motion and wait until the base is at rest, two seconds at most.

    Where no command gate runs, no task moves the base; then the drive itself comes to rest.
    """
    if context.find_behavior(CommandGate) is not None:
        with piloting(context) as pilot:
            await pilot.stop()
        return
    drive = context.resources.find(DriveSystem)
    if drive is None:
        raise HriError("no drive in the configuration - add one")
    try:
        await drive.halt(Stop.SMOOTH)
    finally:
        context.resources.release(drive)


def refuse_too_long(context: TaskContext, distance_m: float, given: str, remedy: str) -> None:
    """Raise HriError for a move beyond `longest_move` of the drive.

    `given` is the distance as the caller gave it, with its unit; `remedy` says what to do.
    """
    resources = context.resources
    id = next(iter(resources.ids(DriveSystem)), "drive")
    description = resources.descriptions.get(id, Description(id, ""))
    if (longest := longest_move(description)) < abs(distance_m) < math.inf:
        raise too_long(id, given, longest, remedy)


def _above_0(value: float | None, default: float, unit: str) -> float:
    value = default if value is None else value
    if not math.isfinite(value) or value <= 0:
        raise ValueError(f"cannot move at {value} {unit} - give a number above 0")
    return value


class _Way(ABC):
    """Where a motion leads: meters or radians from where it is first looked at."""

    near: ClassVar[float]
    """So close to the goal it is over; the base rolls out a little."""
    deceleration: ClassVar[float]
    """The usual one, in `unit`."""
    unit: ClassVar[str]

    def __init__(self, goal: float, speed: float, acceleration: float | None) -> None:
        if not math.isfinite(goal):
            raise ValueError(f"cannot go {goal} - give a finite number")
        self.goal = goal
        self.gone = 0.0
        """How much of it has been traveled, as far as `look` has seen."""
        self._speed = speed
        self._down = _above_0(acceleration, self.deceleration, self.unit)
        # Without an acceleration, how fast it speeds up is the supervisor's part alone.
        self._up = math.inf if acceleration is None else acceleration
        self._asked = 0.0

    @abstractmethod
    def look(self, pose: Pose2D) -> None:
        """Take note of how far it got."""

    @abstractmethod
    def end(self, start: Pose2D) -> Pose2D:
        """Where it leads from there."""

    @abstractmethod
    def steered(self, pose: Pose2D, braking: Twist, factor: float) -> Twist:
        """What to ask the base for on the way.

        The gate slows down with `braking`, and multiplies every velocity by `factor`, above 0.
        """

    def _toward_goal(self, braking: float, factor: float) -> float:
        """The velocity for the next period, such that the base comes to rest at the goal."""
        down = min(self._down, _HEADROOM * braking)
        wanted = velocity_for(self.goal - self.gone, self._speed * factor, down, _PERIOD)
        self._asked = min(abs(wanted), self._asked + self._up * _PERIOD)
        return math.copysign(self._asked, wanted) / factor


class _Straight(_Way):
    near = 0.002
    deceleration, unit = 0.3, "m/s²"
    _start: Pose2D | None = None

    def look(self, pose: Pose2D) -> None:
        self._start = start = self._start or pose
        ahead, left = math.cos(start.heading), math.sin(start.heading)
        self.gone = (pose.x - start.x) * ahead + (pose.y - start.y) * left

    def end(self, start: Pose2D) -> Pose2D:
        return along_arc(start, self.goal, 0.0)

    def steered(self, pose: Pose2D, braking: Twist, factor: float) -> Twist:
        astray = wrapped((self._start or pose).heading - pose.heading)
        return Twist(self._toward_goal(braking.linear, factor), _HEADING_GAIN * astray)


class _Turn(_Way):
    near = math.radians(0.2)
    deceleration, unit = 1.0, "rad/s²"
    _last: Pose2D | None = None

    def look(self, pose: Pose2D) -> None:
        # Counted on, through whole turns.
        self.gone += wrapped(pose.heading - (self._last or pose).heading)
        self._last = pose

    def end(self, start: Pose2D) -> Pose2D:
        return along_arc(start, 0.0, self.goal)

    def steered(self, pose: Pose2D, braking: Twist, factor: float) -> Twist:
        return Twist(0.0, self._toward_goal(braking.angular, factor))


class Pilot:
    """The one that may write commands, until another motion takes the drive or a halt."""

    def __init__(self, context: TaskContext, gate: CommandGate, odometry: Odometry) -> None:
        self._context = context
        self._clock = context.clock
        self._gate = gate
        self._odometry = odometry
        self._command = context.board.slot(COMMAND)
        self._current = context.board.slot(MOTION)

    async def follow(self, way: _Way) -> float:
        """Steer until the goal is near or comes no nearer; how far it got."""
        patience = Patience(_PATIENCE_S, way.near)
        board = self._context.board
        start = nominal_pose(board, self._pose())
        way.look(start)
        is_there = False

        def steer(now: float, pose: Pose2D) -> Twist | None:
            nonlocal is_there
            way.look(pose)
            remaining = abs(way.goal - way.gone)
            is_there = remaining <= way.near
            if is_there or patience.is_over(now, remaining):
                return None
            if (factor := self._gate.factor) <= 0:
                return REST
            return way.steered(pose, self._gate.braking, factor)

        await self.lead(steer)
        pose = self._pose()
        way.look(pose)
        if is_there:
            note_arrival(board, way.end(start), pose, self._clock.now())
        return way.gone  # the caller sees whether it is the whole way

    async def lead(self, steer: Callable[[float, Pose2D], Twist | None]) -> bool:
        """Send what `steer` says for a time and a pose, until it says None.

        False when another motion, a stop or a bump ended it before.
        """
        try:
            async with self._context.claim("drive"):
                if (lift := self._context.board.slot(LIFT).value) is not None:
                    lift(said())
                self._current.set(self, self._clock.now())
                is_over = await self._led(steer)
                await self._roll_out()
        except Interrupted:
            return False
        return is_over

    async def stop(self) -> None:
        """End whatever motion goes on, and come to rest."""
        self._current.set(self, self._clock.now())
        self._end()
        await self._roll_out()

    async def _led(self, steer: Callable[[float, Pose2D], Twist | None]) -> bool:
        try:
            while self._current.value is self:
                now = self._clock.now()
                twist = steer(now, self._pose())
                if twist is None:
                    return True
                self._command.set(twist, now)
                await self._clock.sleep(_PERIOD)
        finally:
            self._end()
        return False

    def _pose(self) -> Pose2D:
        return self._odometry.pose(self._clock.now())

    def _end(self) -> None:
        """Let the base come to rest, unless another motion has taken over."""
        if self._current.value is self:
            self._current.clear()
            self._command.set(REST, self._clock.now())

    async def _roll_out(self) -> None:
        """Wait until the base stands or another motion drives it."""
        deadline = self._clock.now() + _LONGEST_ROLL_S
        while self._current.value is None and self._clock.now() < deadline:
            velocity = self._odometry.velocity(self._clock.now())
            await self._clock.sleep(_PERIOD)
            if abs(velocity.linear) < _STANDING and abs(velocity.angular) < _STANDING:
                return


@contextmanager
def piloting(context: TaskContext) -> Iterator[Pilot]:
    """A pilot, with the odometry for as long as it lasts; its own gate where none runs."""
    gate = see_to_gate(context)
    odometry = context.resources.obtain("odometry", Odometry)
    try:
        yield Pilot(context, gate, odometry)
    finally:
        context.resources.release(odometry)
