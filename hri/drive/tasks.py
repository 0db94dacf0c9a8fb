"""The verbs of driving: `move`, `turn`, `stop`.

A motion claims "drive" and writes velocities to the board, where the command gate reads them.
Starting one ends the one before; `stop`, `CommandGate.halt` and a bump end it too. It ends by
itself at the goal, or when it gets nowhere.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from hri.core.geometry import wrapped
from hri.core.signals import Pose2D, Twist
from hri.drive.behaviors import COMMAND, MOTION
from hri.drive.own_gate import see_to_gate
from hri.drive.progress import Patience
from hri.hal.drive import DriveSystem, Odometry, longest_move, too_long
from hri.hal.motion import REST
from hri.hal.motion_profile import velocity_for
from hri.hal.pending import Interrupted
from hri.hal.resource import Description
from hri.task.context import TaskContext

CRUISE = 0.3
"""Meters a second, when nobody says how fast; an upper limit of what is safe near people."""
TURN_RATE = 1.0
"""Radians a second."""

_PERIOD = 0.05
_LINEAR_DECELERATION = 0.3
_ANGULAR_DECELERATION = 1.0
_HEADING_GAIN = 2.0
"""Radians a second for each radian off the heading."""
_PATIENCE_S = 2.0
"""A motion that gets nowhere for so long is over."""
_LONGEST_ROLL_S = 2.0
_STANDING = 0.005
"""A base that is slower, in m/s and rad/s, will stand by the next look."""


async def move(context: TaskContext, distance_m: float, speed: float | None = None) -> float:
    """Drive straight ahead, backward when negative; the distance really travelled, with its sign.

    Raises ValueError for a distance that is not finite or a speed (m/s) that is not above 0,
    HriError for a distance beyond `longest_move` of the drive.
    """
    refuse_too_long(
        context, distance_m, f"{distance_m:g} m", f"give {distance_m / 100:g} if you meant cm"
    )
    way = _Straight(distance_m, _above_0(speed, CRUISE, "m/s"))
    with motion_of(context) as motion:
        return await motion.run(way)


async def turn(context: TaskContext, angle_rad: float, rate: float | None = None) -> float:
    """Turn on the spot, left when positive, also more than once round; the angle really turned.

    Raises ValueError for an angle that is not finite or a rate (rad/s) that is not above 0.
    """
    way = _Turn(angle_rad, _above_0(rate, TURN_RATE, "rad/s"))
    with motion_of(context) as motion:
        return await motion.run(way)


async def stop(context: TaskContext) -> None:
    """End any motion and wait until the base is at rest, two seconds at most."""
    with motion_of(context) as motion:
        await motion.stop()


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
        raise ValueError(f"cannot move at {value} {unit} - give a speed above 0")
    return value


class _Way(ABC):
    """Where a motion leads: meters or radians from where it begins."""

    near: float
    """So close to the goal it is over; the base rolls out a little."""

    def __init__(self, goal: float) -> None:
        if not math.isfinite(goal):
            raise ValueError(f"cannot go {goal} - give a finite number")
        self.goal = goal
        self.gone = 0.0
        """How much of it has been travelled, as far as `look` has seen."""

    def begin(self, pose: Pose2D) -> None:
        self._start = pose

    @abstractmethod
    def look(self, pose: Pose2D) -> None:
        """Take note of how far it got."""

    @abstractmethod
    def steered(self, pose: Pose2D) -> Twist:
        """What to ask the base for on the way."""


class _Straight(_Way):
    near = 0.005

    def __init__(self, goal: float, cruise: float) -> None:
        super().__init__(goal)
        self._cruise = cruise

    def look(self, pose: Pose2D) -> None:
        ahead, left = math.cos(self._start.heading), math.sin(self._start.heading)
        self.gone = (pose.x - self._start.x) * ahead + (pose.y - self._start.y) * left

    def steered(self, pose: Pose2D) -> Twist:
        linear = velocity_for(self.goal - self.gone, self._cruise, _LINEAR_DECELERATION, _PERIOD)
        return Twist(linear, _HEADING_GAIN * wrapped(self._start.heading - pose.heading))


class _Turn(_Way):
    near = math.radians(0.5)

    def __init__(self, goal: float, rate: float) -> None:
        super().__init__(goal)
        self._rate = rate

    def begin(self, pose: Pose2D) -> None:
        self._heading = pose.heading

    def look(self, pose: Pose2D) -> None:
        # Counted on, through whole turns.
        self.gone += wrapped(pose.heading - self._heading)
        self._heading = pose.heading

    def steered(self, pose: Pose2D) -> Twist:
        remaining = self.goal - self.gone
        return Twist(0.0, velocity_for(remaining, self._rate, _ANGULAR_DECELERATION, _PERIOD))


class Motion:
    """The one motion that may write commands, until another task claims the drive or a halt."""

    def __init__(self, context: TaskContext, odometry: Odometry) -> None:
        self._context = context
        self._clock = context.clock
        self._odometry = odometry
        self._command = context.board.slot(COMMAND)
        self._current = context.board.slot(MOTION)

    async def run(self, way: _Way) -> float:
        """Steer until the goal is near; how far it got."""
        try:
            async with self._context.claim("drive"):
                self._current.set(self, self._clock.now())
                way.begin(self._pose())
                await self._steer(way)
                await self._roll_out()
                way.look(self._pose())
        except Interrupted:
            return way.gone  # the caller sees that it is not the whole way
        return way.gone

    async def lead(self, steer: Callable[[float, Pose2D], Twist | None]) -> bool:
        """Send what `steer` says for a time and a pose, until it says None.

        Whether it came to that; False when another motion, a stop or a bump ended it.
        """
        try:
            async with self._context.claim("drive"):
                self._current.set(self, self._clock.now())
                is_over = await self._led(steer)
                await self._roll_out()
        except Interrupted:
            return False
        return is_over

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

    async def stop(self) -> None:
        """End whatever motion goes on, and come to rest."""
        self._current.set(self, self._clock.now())
        self._end()
        await self._roll_out()

    async def _steer(self, way: _Way) -> None:
        patience = Patience(_PATIENCE_S, way.near)
        try:
            while self._current.value is self:
                pose, now = self._pose(), self._clock.now()
                way.look(pose)
                remaining = abs(way.goal - way.gone)
                if remaining <= way.near or patience.is_over(now, remaining):
                    break
                self._command.set(way.steered(pose), now)
                await self._clock.sleep(_PERIOD)
        finally:
            self._end()

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
def motion_of(context: TaskContext) -> Iterator[Motion]:
    """A motion, with the odometry for as long as it lasts; a gate of its own where none runs."""
    see_to_gate(context)
    odometry = context.resources.obtain("odometry", Odometry)
    try:
        yield Motion(context, odometry)
    finally:
        context.resources.release(odometry)
