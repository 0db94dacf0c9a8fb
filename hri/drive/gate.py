"""The last arithmetic before the wheels: nothing passes that is too fast, too sudden or stale."""

from __future__ import annotations

import math

from hri.core.signals import Twist
from hri.drive.velocity_limits import GateLimits
from hri.hal.motion import REST
from hri.hal.motion_profile import toward

ANGULAR_FACTOR = 4.0
"""Turning may change this many times as fast, in radians, as driving does in meters: on a base with
wheels half a meter apart both ask the same of the wheels."""
_LEAST_LINEAR = 0.005
_LEAST_ANGULAR = 0.02
"""Slower than this, wheels only hum: it counts as rest."""


class VelocityGate:
    """Follows commands within limits; comes to rest by itself when they stop coming."""

    def __init__(self, limits: GateLimits | None = None) -> None:
        self.limits = limits or GateLimits()
        self.refused = 0
        """How many commands were not finite; each was taken for a stop."""
        self.current = REST
        """What was sent to the base last."""
        self.target = REST
        """Where that is heading."""
        self.reason = "done"
        """Why it last headed for rest: "done", "timeout", "obstacle", "somebody comes", or what
        `halt` was told."""
        self._command = REST
        self._command_time = -math.inf
        self._time = -math.inf

    @property
    def is_moving(self) -> bool:
        return self.current != REST

    def is_asked(self, now: float) -> bool:
        """Whether someone asks for motion, or it has not come to rest since."""
        is_fresh = now - self._command_time <= self.limits.timeout_s
        return self.is_moving or (is_fresh and self._command != REST)

    def command(self, twist: Twist, now: float) -> None:
        """Ask for a velocity, valid until the timeout."""
        if not (math.isfinite(twist.linear) and math.isfinite(twist.angular)):
            self.refused += 1
            twist = REST
        self._command, self._command_time = twist, now

    def halt(self, reason: str = "halt") -> None:
        """Stand still at once and forget the command."""
        self._command, self._command_time = REST, -math.inf
        self.current = self.target = REST
        self.reason = reason

    def brake(self, now: float) -> None:
        """Stand still at once, for someone who comes; the command stays."""
        self._step_to(now)
        if self.target != REST:
            self.reason = "somebody comes"
        self.current = self.target = REST

    def velocity(
        self,
        now: float,
        *,
        speed: float = 1.0,
        max_forward: float = math.inf,
        fastest: float = math.inf,
    ) -> Twist:
        """What to send to the base.

        `speed` is a factor on the command; `max_forward` limits driving forward alone (m/s), so
        that a base that stands before a wall can still turn away and back off; `fastest` limits
        driving either way.
        """
        dt = self._step_to(now)
        is_stale = now - self._command_time > self.limits.timeout_s
        wanted = REST if is_stale else self._limited(self._command, speed)
        ahead, back = max(0.0, min(max_forward, fastest)), max(0.0, fastest)
        target = _at_least(max(-back, min(wanted.linear, ahead)), wanted.angular)
        if target == REST != self.target:
            self.reason = "timeout" if is_stale else "done" if wanted == REST else "obstacle"
        self.target = target
        self.current = self._approached(dt)
        return self.current

    def _step_to(self, now: float) -> float:
        """Seconds since the last call; after a long gap the base has stopped by itself."""
        dt = max(0.0, now - self._time)
        self._time = now
        if dt > self.limits.timeout_s:
            self.current = REST
            return 0.0
        return dt

    def _limited(self, twist: Twist, speed: float) -> Twist:
        """The command within the speed limits; both parts shrink alike, so that arcs keep shape."""
        linear, angular = twist.linear * speed, twist.angular * speed
        linear_excess = abs(linear) / self.limits.max_linear
        angular_excess = abs(angular) / self.limits.max_angular
        excess = max(1.0, linear_excess, angular_excess)
        return _at_least(linear / excess, angular / excess)

    def _approached(self, dt: float) -> Twist:
        up, down = self.limits.acceleration * dt, self.limits.deceleration * dt
        linear = approach(self.current.linear, self.target.linear, up, down)
        up, down = up * ANGULAR_FACTOR, down * ANGULAR_FACTOR
        return Twist(linear, approach(self.current.angular, self.target.angular, up, down))


def approach(value: float, target: float, up: float, down: float) -> float:
    """One step from a velocity toward another: by `up` away from zero, by `down` toward it.

    On the way to the other sign it stops at zero first.
    """
    if value * target < 0:
        target = 0.0
    return toward(value, target, up if abs(target) > abs(value) else down)


def _at_least(linear: float, angular: float) -> Twist:
    """The velocity, or rest where the wheels would only hum."""
    if abs(linear) >= _LEAST_LINEAR:
        return Twist(linear, angular)
    return Twist(0.0, angular) if abs(angular) >= _LEAST_ANGULAR else REST
