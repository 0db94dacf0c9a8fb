"""The verbs of driving: `move`, `turn`, `stop`.

A motion writes velocities to the board, where the command gate reads them. Starting one ends the
one before; `stop`, `CommandGate.halt` and a bump end it too. It ends by itself at the goal, or when
it gets nowhere.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from hri.core.signals import Pose2D, Twist
from hri.drive.behaviors import COMMAND, MOTION
from hri.drive.gate import REST
from hri.drive.profile import velocity_for
from hri.hal.drive import Odometry
from hri.task.context import TaskContext

CRUISE = 0.3
"""Metres a second, when nobody says how fast; an upper limit of what is safe near people."""
TURN_RATE = 1.0
"""Radians a second."""

_PERIOD = 0.05
_LINEAR_DECELERATION = 0.3
_ANGULAR_DECELERATION = 1.0
_NEAR_LINEAR = 0.005
"""Metres from the goal at which a move is over; the base rolls out a little."""
_NEAR_ANGULAR = math.radians(0.5)
_HEADING_GAIN = 2.0
"""Radians a second for each radian off the heading."""
_PATIENCE_S = 2.0
"""A motion that gets nowhere for so long is over."""
_LONGEST_ROLL_S = 2.0
_STANDING = 0.005
"""A base that is slower, in m/s and rad/s, will stand by the next look."""


async def move(context: TaskContext, distance_m: float, speed: float | None = None) -> float:
    """Drive straight ahead, backward when negative; the distance really travelled, with its sign.

    Raises ValueError for a distance that is not finite or a speed (m/s) that is not above 0.
    """
    cruise = CRUISE if speed is None else speed
    if not math.isfinite(cruise) or cruise <= 0:
        raise ValueError(f"cannot move at {speed} m/s - give a speed above 0")
    motion = _Motion(context, distance_m)
    start = motion.pose()

    def travelled(pose: Pose2D) -> float:
        ahead, left = math.cos(start.heading), math.sin(start.heading)
        return (pose.x - start.x) * ahead + (pose.y - start.y) * left

    def steered(remaining: float, pose: Pose2D) -> Twist:
        linear = velocity_for(remaining, cruise, _LINEAR_DECELERATION, _PERIOD)
        return Twist(linear, _HEADING_GAIN * wrapped(start.heading - pose.heading))

    return await motion.run(travelled, steered, _NEAR_LINEAR)


async def turn(context: TaskContext, angle_rad: float) -> float:
    """Turn on the spot, left when positive, also more than once round; the angle really turned.

    Raises ValueError for an angle that is not finite.
    """
    motion = _Motion(context, angle_rad)
    turned = _Turned(motion.pose())

    def steered(remaining: float, pose: Pose2D) -> Twist:
        return Twist(0.0, velocity_for(remaining, TURN_RATE, _ANGULAR_DECELERATION, _PERIOD))

    return await motion.run(turned, steered, _NEAR_ANGULAR)


async def stop(context: TaskContext) -> None:
    """End any motion and wait until the base is at rest, two seconds at most."""
    motion = _Motion(context, 0.0)
    motion.end()
    await motion.roll_out()


def wrapped(angle: float) -> float:
    """The same direction within -pi to pi."""
    return math.remainder(angle, math.tau)


class _Turned:
    """The angle turned since the start, counted on through whole turns."""

    def __init__(self, pose: Pose2D) -> None:
        self._heading = pose.heading
        self._angle = 0.0

    def __call__(self, pose: Pose2D) -> float:
        self._angle += wrapped(pose.heading - self._heading)
        self._heading = pose.heading
        return self._angle


class _Motion:
    """The one motion that may write commands, until another one starts or something ends it."""

    def __init__(self, context: TaskContext, goal: float) -> None:
        """`goal`: metres or radians from here. Raises ValueError when it is not finite."""
        if not math.isfinite(goal):
            raise ValueError(f"cannot go {goal} - give a finite number")
        self._goal = goal
        self._clock = context.clock
        self._odometry = context.resources.obtain("odometry", Odometry)
        self._command = context.board.slot(COMMAND)
        self._current = context.board.slot(MOTION)
        self._current.set(self, self._clock.now())

    def pose(self) -> Pose2D:
        return self._odometry.pose(self._clock.now())

    async def run(
        self,
        travelled: Callable[[Pose2D], float],
        steered: Callable[[float, Pose2D], Twist],
        near: float,
    ) -> float:
        """Steer until what is `travelled` is near the goal; how far it got."""
        patience = _Patience(self._clock.now(), abs(self._goal))
        try:
            while self._current.value is self:
                pose, now = self.pose(), self._clock.now()
                remaining = self._goal - travelled(pose)
                if abs(remaining) <= near or patience.is_over(now, abs(remaining), near):
                    break
                self._command.set(steered(remaining, pose), now)
                await self._clock.sleep(_PERIOD)
        finally:
            self.end()
        await self.roll_out()
        return travelled(self.pose())

    def end(self) -> None:
        """Let the base come to rest, unless another motion has taken over."""
        if self._current.value is self:
            self._current.clear()
            self._command.set(REST, self._clock.now())

    async def roll_out(self) -> None:
        """Wait until the base stands or another motion drives it."""
        deadline = self._clock.now() + _LONGEST_ROLL_S
        while self._current.value is None and self._clock.now() < deadline:
            velocity = self._odometry.velocity(self._clock.now())
            await self._clock.sleep(_PERIOD)
            if abs(velocity.linear) < _STANDING and abs(velocity.angular) < _STANDING:
                return


class _Patience:
    """Notices that the goal comes no nearer."""

    def __init__(self, now: float, remaining: float) -> None:
        self._best, self._since = remaining, now

    def is_over(self, now: float, remaining: float, least: float) -> bool:
        """Whether nothing was gained, `least` metres or radians, for too long."""
        if remaining < self._best - least:
            self._best, self._since = remaining, now
        return now - self._since > _PATIENCE_S
