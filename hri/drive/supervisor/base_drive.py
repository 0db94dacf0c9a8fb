"""The drive of a base: it asks the supervisor, which has the last word."""

from __future__ import annotations

import math
from typing import ClassVar

from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.drive.supervisor.base_devices import OnBase
from hri.drive.supervisor.steering import FULL_POWER, Steering
from hri.drive.velocity_limits import Cap, within, within_hardware
from hri.hal.drive import PATIENCE, DriveSystem, Stop, longest_move, too_long
from hri.hal.emergency_stop import EmergencyStop
from hri.hal.manner import FREELY, Manner
from hri.hal.motion import REST, Brake, Motion, MoveDelta, Ramp, SlowDown, TurnDelta
from hri.hal.motion_profile import Trapezoid
from hri.hal.pending import Pending, completed
from hri.hal.rank import PROGRAM, Rank, Writer
from hri.hal.resource import Description

SMOOTH = Twist(0.4, 1.6)
"""How fast a smooth stop slows down: m/s² and rad/s²."""
_HEADROOM = 0.8
"""Share of the greatest acceleration that motions plan with; the rest is left to catch up with."""
_MOVE_RAMP, _TURN_RAMP = 0.7, 0.6
"""Seconds at least from rest to the peak: with less, the limited jerk carries it past its goal."""


class BaseDrive(OnBase, DriveSystem, EmergencyStop):
    """One command at a time, with the rank of whoever gave it; a stop always wins.

    A velocity counts until the next command, and no longer than the supervisor believes it. All
    drives of one base share what they are doing, see `hri.drive.supervisor.steering`.
    """

    parameters: ClassVar[tuple[str, ...]] = ("longest_move",)

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        longest_move(description)

    def _open(self) -> None:
        super()._open()
        limits = self.bus.limits
        self.max_acceleration = min(limits.acceleration, limits.deceleration)
        self.max_angular_acceleration = min(
            limits.angular_acceleration, limits.angular_deceleration
        )
        self.max_linear, self.max_angular = self._slowest.forward, self._slowest.angular
        self.bus.begin()

    def deactivate(self) -> None:
        if not self.is_active:
            return
        steering, ended = self._steering, None
        try:
            with self._lock, steering.lock:
                if steering.driven_by in (None, self):
                    ended = steering.forget()
                super().deactivate()
        finally:
            steering.interrupt(ended, "the drive was closed - open it again")

    def _close(self) -> None:
        self._steering.idle_power = 0.0
        if self._steering.driven_by in (None, self):
            self._steering.try_to_rest(self)

    @property
    def _steering(self) -> Steering:
        """What all drives of this base share."""
        bus = self.bus
        return self.manager.shared(Steering, (bus.id,), lambda: Steering(bus))

    @property
    def _slowest(self) -> Cap:
        """The speed cap that holds even when people are near; faster plans may lag and fail."""
        return within_hardware(self.bus.limits.cap(is_near=True), self.bus.fastest)

    # --- the emergency stop is the base's ---

    @property
    def is_latched(self) -> bool:
        return self.bus.is_latched

    def stop_latched(self, because: str) -> None:
        self.bus.stop_latched(because)
        self._end_motion()

    def stop_spoken(self, because: str, said: float) -> None:
        self.bus.stop_spoken(because, said)
        self._end_motion()

    @property
    def is_spoken(self) -> bool:
        return self.bus.is_spoken

    def unlatch(self) -> None:
        self.bus.unlatch()

    def unlatch_spoken(self, said: float) -> bool:
        return self.bus.unlatch_spoken(said)

    def explain(self) -> str:
        return self.bus.explain()

    # --- who steers ---

    def claim(self, writer: Writer) -> None:
        self._steering.claim(writer)

    def leave(self, writer: Writer, now: float) -> None:
        self.let_go(writer, now)
        self._steering.leave(writer)

    def let_go(self, writer: Writer, now: float) -> None:
        steering = self._steering
        with steering.lock:
            if steering.is_free_for(writer):
                self.stop(now)
            else:
                steering.take_back(writer)

    # --- velocities ---

    def set_velocity(
        self,
        twist: Twist,
        now: float,
        until: float = math.inf,
        by: Writer = PROGRAM,
        manner: Manner = FREELY,
    ) -> None:
        self._refuse_closed()
        steering = self._steering
        steering.refuse_while_stopping(self)
        if by.rank is Rank.NOBODY:
            steering.take_back(by)
            return
        reason = "a velocity came in between - send none while it moves"
        with steering.instead(self, reason, by):
            steering.ask(by, self._possible(twist), min(now, until - PATIENCE), manner)

    def _possible(self, twist: Twist) -> Twist:
        """The same curve, no faster than the base; what is not finite is for others to refuse."""
        if not (math.isfinite(twist.linear) and math.isfinite(twist.angular)):
            return twist
        fastest = self.bus.fastest
        return within(twist, Cap(fastest.linear, fastest.linear, fastest.angular))

    def stop(self, now: float) -> None:
        if self.is_active:  # closing it was a stop
            self._end_motion()

    def _end_motion(self) -> None:
        steering = self._steering
        reason = "the drive was stopped - start it again"
        with steering.stopping(), steering.instead(self, reason):
            steering.stop()

    # --- power ---

    def set_idle_power(self, percent: float) -> Pending[None]:
        _within(percent, "idle power", least=0.0)
        with self._steering.lock:
            self._refuse_closed()
            self._steering.idle_power = percent
            if self._steering.run is None:
                self.bus.set_power(percent, self.manager.clock.now())
        return completed(self.manager.clock, None)

    def set_move_power(self, percent: float) -> Pending[None]:
        _within(percent, "move power", least=1.0)
        with self._steering.lock:
            self._refuse_closed()
            self._steering.move_power = percent
        return completed(self.manager.clock, None)

    # --- motions ---

    def move_delta(self, distance: float, velocity: float, acceleration: float) -> Pending[None]:
        _finite(distance, "distance", "meters")
        self._refuse_too_long(distance)
        _positive(velocity, "velocity", "m/s")
        _positive(acceleration, "acceleration", "m/s²")
        fastest = self.max_linear if distance > 0 else min(self.max_linear, self._slowest.backward)
        acceleration = min(acceleration, self._limits.linear, abs(distance) / _MOVE_RAMP**2)
        return self._begin(MoveDelta(Trapezoid(distance, min(velocity, fastest), acceleration)))

    def turn_delta(self, angle: float, velocity: float, acceleration: float) -> Pending[None]:
        _finite(angle, "angle", "radians")
        _positive(velocity, "velocity", "rad/s")
        _positive(acceleration, "acceleration", "rad/s²")
        velocity = min(velocity, self.max_angular)
        acceleration = min(acceleration, self._limits.angular, abs(angle) / _TURN_RAMP**2)
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
        self._refuse_closed()
        goal = Twist(_cut(linear, self.max_linear), _cut(angular, self.max_angular))
        acceleration = _slower(Twist(linear_acceleration, angular_acceleration), self._limits)
        begun = self._begin(Ramp(self._velocity, goal, acceleration))
        if begun.is_done:
            begun.result()  # nobody else would be told why it ended at once

    def halt(self, how: Stop = Stop.SMOOTH) -> Pending[None]:
        self._refuse_closed()
        steering = self._steering
        with steering.stopping():
            steering.slow_down()
            if how is Stop.ABRUPT:
                return steering.begin(self, Brake())
            return steering.begin(self, SlowDown(self._velocity, _slower(SMOOTH, self._limits)))

    def _begin(self, motion: Motion) -> Pending[None]:
        self._refuse_closed()
        self._steering.refuse_while_stopping(self)
        return self._steering.begin(self, motion)

    @property
    def _velocity(self) -> Twist:
        return self.bus.report().velocity or REST

    @property
    def _limits(self) -> Twist:
        """The accelerations that motions may plan with, m/s² and rad/s²."""
        share = _HEADROOM * self._steering.move_power / FULL_POWER
        return Twist(self.max_acceleration * share, self.max_angular_acceleration * share)

    def _refuse_closed(self) -> None:
        if not self.is_active:
            raise HriError(f"{self.id}: the drive is closed - obtain it first")

    def _refuse_too_long(self, distance: float) -> None:
        if abs(distance) > (longest := self.longest_move):
            remedy = (
                f"if you meant {distance:g} cm, give {distance / 100:g} or use "
                f'obtain("{self.id}", "IDriveSystem"), the interface of 2003'
            )
            raise too_long(self.id, f"{distance:g} m", longest, remedy)


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
