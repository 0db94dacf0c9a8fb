"""A drive system that runs motions by itself: drivers of a base say only how to send and measure.

While a motion runs, a timer of the clock repeats its command every 20 ms, so the base's own
watchdog stops it when this program falls silent.
"""

from __future__ import annotations

import math
from abc import abstractmethod

from hri.core.clock import Timer
from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.hal.drive import DriveSystem, Stop
from hri.hal.motion import (
    PERIOD,
    Brake,
    Motion,
    MoveDelta,
    Ramp,
    Reading,
    SlowDown,
    TurnDelta,
    Way,
)
from hri.hal.pending import Interrupted, Pending, completed
from hri.hal.profile import Trapezoid

SMOOTH = Twist(0.4, 1.6)
"""How fast a smooth stop slows down: m/s² and rad/s²."""
FULL_POWER = 100.0
_HEADROOM = 0.8
"""Share of the greatest acceleration that motions plan with; the rest is left to catch up with."""


class MovingBase(DriveSystem):
    """Executes motions over `_send`, `_brake`, `_set_power`, `_rolled` and `_velocity`."""

    def _open(self) -> None:
        self._motion: Motion | None = None
        self._pending: Pending[None] = completed(self.manager.clock, None)
        self._timer: Timer | None = None
        self._began = self._due = 0.0
        self._origin = Way()
        self._idle_power = 0.0
        self._move_power = FULL_POWER

    def _close(self) -> None:
        now = self.manager.clock.now()
        self._replace("the drive was closed - open it again")
        self._brake(now)
        self._set_power(0.0, now)

    # --- what a driver fills in ---

    @abstractmethod
    def _send(self, twist: Twist, now: float) -> None:
        """Pass a velocity on to the hardware."""

    @abstractmethod
    def _brake(self, now: float) -> None:
        """Let the hardware stop as fast as it can."""

    @abstractmethod
    def _set_power(self, percent: float, now: float) -> None:
        """Let the motors use so much of their force, 0 to 100."""

    @abstractmethod
    def _rolled(self, now: float) -> Way:
        """How far the wheels have carried the base since it was switched on."""

    @abstractmethod
    def _velocity(self, now: float) -> Twist:
        """What the wheels measure."""

    # --- velocities ---

    def set_velocity(self, twist: Twist, now: float) -> None:
        with self._lock:
            self._replace("a velocity came in between - send none while it moves by itself")
            self._send(twist, now)

    def stop(self, now: float) -> None:
        with self._lock:
            self._replace("the drive was stopped - start it again")
            self._brake(now)

    # --- power ---

    def set_idle_power(self, percent: float) -> Pending[None]:
        _within(percent, "idle power", least=0.0)
        with self._lock:
            self._idle_power = percent
            if self._motion is None:
                self._set_power(percent, self.manager.clock.now())
        return completed(self.manager.clock, None)

    def set_move_power(self, percent: float) -> Pending[None]:
        _within(percent, "move power", least=1.0)
        self._move_power = percent
        return completed(self.manager.clock, None)

    # --- motions ---

    def move_delta(self, distance: float, velocity: float, acceleration: float) -> Pending[None]:
        _finite(distance, "distance", "metres")
        _positive(velocity, "velocity", "m/s")
        _positive(acceleration, "acceleration", "m/s²")
        velocity = min(velocity, self.max_linear)
        acceleration = min(acceleration, self._limits.linear)
        return self._begin(MoveDelta(Trapezoid(distance, velocity, acceleration)))

    def turn_delta(self, angle: float, velocity: float, acceleration: float) -> Pending[None]:
        _finite(angle, "angle", "radians")
        _positive(velocity, "velocity", "rad/s")
        _positive(acceleration, "acceleration", "rad/s²")
        velocity = min(velocity, self.max_angular)
        acceleration = min(acceleration, self._limits.angular)
        return self._begin(TurnDelta(Trapezoid(angle, velocity, acceleration)))

    def move_and_turn(
        self,
        linear: float,
        linear_acceleration: float,
        angular: float,
        angular_acceleration: float,
    ) -> None:
        _finite(linear, "linear velocity", "m/s")
        _finite(angular, "angular velocity", "rad/s")
        _positive(linear_acceleration, "linear acceleration", "m/s²")
        _positive(angular_acceleration, "angular acceleration", "rad/s²")
        goal = Twist(_cut(linear, self.max_linear), _cut(angular, self.max_angular))
        acceleration = _slower(Twist(linear_acceleration, angular_acceleration), self._limits)
        self._begin(Ramp(self._velocity(self.manager.clock.now()), goal, acceleration))

    def halt(self, how: Stop = Stop.SMOOTH) -> Pending[None]:
        if how is Stop.ABRUPT:
            return self._begin(Brake())
        start = self._velocity(self.manager.clock.now())
        return self._begin(SlowDown(start, _slower(SMOOTH, self._limits)))

    @property
    def _limits(self) -> Twist:
        """The accelerations that motions may plan with, m/s² and rad/s²."""
        share = _HEADROOM * self._move_power / FULL_POWER
        return Twist(self.max_acceleration * share, self.max_angular_acceleration * share)

    # --- the timer ---

    def _begin(self, motion: Motion) -> Pending[None]:
        """Run a motion in place of the one before."""
        clock = self.manager.clock
        pending: Pending[None] = Pending(clock, on_cancel=lambda: self.stop(clock.now()))
        with self._lock:
            if not self.is_active:
                raise HriError(f"{self.id}: the drive is closed - obtain it first")
            self._replace("another command took its place - wait for the one before")
            now = clock.now()
            self._motion, self._pending = motion, pending
            self._began = self._due = now
            self._origin = self._rolled(now)
            self._set_power(self._move_power, now)
            self._tick()
        return pending

    def _tick(self) -> None:
        with self._lock:
            motion, now = self._motion, self.manager.clock.now()
            if motion is None:
                return
            try:
                twist = motion.step(now - self._began, self._reading(now))
            except HriError as error:
                self._end(now).fail(HriError(f"{self.id}: {error}"))
                return
            if twist is None:
                self._end(now).complete(None)
                return
            if motion.is_braking:
                self._brake(now)
            else:
                self._send(twist, now)
            self._due = max(self._due + PERIOD, now)
            self._timer = self.manager.clock.call_at(self._due, self._tick)

    def _reading(self, now: float) -> Reading:
        rolled, origin = self._rolled(now), self._origin
        way = Way(rolled.linear - origin.linear, rolled.angular - origin.angular)
        return Reading(way, self._velocity(now))

    def _end(self, now: float) -> Pending[None]:
        """Let the base rest; the call that is over now."""
        self._forget()
        self._brake(now)
        self._set_power(self._idle_power, now)
        return self._pending

    def _replace(self, reason: str) -> None:
        """End the motion that runs because something else is asked for."""
        if self._motion is not None:
            self._forget()
            self._pending.fail(Interrupted(f"{self.id}: {reason}"))

    def _forget(self) -> None:
        self._motion = None
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


def _cut(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))


def _slower(one: Twist, other: Twist) -> Twist:
    return Twist(min(one.linear, other.linear), min(one.angular, other.angular))


def _finite(value: float, name: str, unit: str) -> None:
    if not math.isfinite(value):
        raise HriError(f"the {name} is {value} - give a finite number of {unit}")


def _positive(value: float, name: str, unit: str) -> None:
    if not (math.isfinite(value) and value > 0):
        raise HriError(f"the {name} is {value} - give {unit} above 0")


def _within(percent: float, name: str, least: float) -> None:
    if not least <= percent <= FULL_POWER:
        raise HriError(f"the {name} is {percent} - give a percentage from {least:g} to 100")
