"""A velocity that follows targets with limited acceleration and jerk: pure arithmetic on time."""

from __future__ import annotations

import math

from hri.core.signals import Twist
from hri.drive.velocity_limits import BaseLimits, Cap, within
from hri.hal.manner import FREELY, Manner
from hri.hal.motion import REST

QUANTUM = 0.005
"""Seconds; velocities are computed in steps of this, however unevenly the limiter is asked."""


class Limiter:
    """Follows targets; `velocity` is never beyond the cap but while it brakes down to one."""

    def __init__(self, limits: BaseLimits) -> None:
        self._linear = _Axis(limits.acceleration, limits.deceleration, limits.jerk)
        self._angular = _Axis(
            limits.angular_acceleration, limits.angular_deceleration, limits.angular_jerk
        )
        self._left_over = 0.0

    @property
    def velocity(self) -> Twist:
        """Where it is."""
        return Twist(self._linear.velocity, self._angular.velocity)

    def halt(self) -> Twist:
        """Rest at once; the hardware brakes as it can."""
        self._linear.halt()
        self._angular.halt()
        self._left_over = 0.0
        return REST

    def step(self, target: Twist, cap: Cap, dt: float, manner: Manner = FREELY) -> Twist:
        """The velocity `dt` seconds later on the way to a target, cut to the cap.

        The accelerations of the manner bound this way, but not the braking down to a cap that has
        fallen.
        """
        target = within(target, cap)
        up, down = manner.acceleration, manner.deceleration
        quanta, self._left_over = divmod(self._left_over + dt, QUANTUM)
        if self._linear.rests_at(target.linear) and self._angular.rests_at(target.angular):
            return self.velocity
        for _ in range(int(quanta)):
            self._linear.step(target.linear, -cap.backward, cap.forward, up.linear, down.linear)
            self._angular.step(target.angular, -cap.angular, cap.angular, up.angular, down.angular)
        return self.velocity


class _Axis:
    """A velocity whose acceleration changes evenly, in steps of QUANTUM."""

    def __init__(self, acceleration: float, deceleration: float, jerk: float) -> None:
        self._acceleration, self._deceleration = acceleration, deceleration
        self._change = jerk * QUANTUM
        """Most that the acceleration changes in a step."""
        self.halt()

    def halt(self) -> None:
        self.velocity = self.acceleration = 0.0

    def rests_at(self, target: float) -> bool:
        """Whether it has this velocity, and keeps it."""
        return self.velocity == target and self.acceleration == 0.0

    def step(
        self,
        target: float,
        least: float,
        most: float,
        up: float = math.inf,
        down: float = math.inf,
    ) -> None:
        """One QUANTUM toward a target within least and most, with at most these accelerations."""
        if not least <= self.velocity <= most:
            self._brake(most if self.velocity > most else least)
            return
        if self.velocity * target < 0:
            target = 0.0  # through rest, where the limits of the other direction begin
        error = target - self.velocity
        side = math.copysign(1.0, error) if error else math.copysign(1.0, self.acceleration)
        grows = abs(target) > abs(self.velocity)
        limit = min(up, self._acceleration) if grows else min(down, self._deceleration)
        toward = self._toward(abs(error), self.acceleration * side, limit)
        self.acceleration = toward * side
        self.velocity += self.acceleration * QUANTUM
        if abs(target - self.velocity) < 1e-9 and abs(self.acceleration) <= self._change:
            self.velocity = target
        self.velocity = max(least, min(most, self.velocity))

    def _brake(self, bound: float) -> None:
        """Come down to a cap that has fallen: safety does not wait for the jerk."""
        most = self._deceleration * QUANTUM
        change = max(-most, min(most, bound - self.velocity))
        self.velocity += change
        self.acceleration = 0.0 if self.velocity == bound else change / QUANTUM

    def _toward(self, error: float, now: float, limit: float) -> float:
        """The greatest acceleration from which it can still be taken back without overshooting.

        Taken back in steps of c = _change, an acceleration between n c and (n + 1) c adds, with h
        for QUANTUM, h ((n + 1) a - c n (n + 1) / 2) to the velocity; solved for a.
        """
        change = self._change
        low = now - change
        high = max(low, min(now + change, limit))
        steps = math.floor((math.sqrt(1 + 8 * error / (QUANTUM * change)) - 1) / 2)
        most = error / QUANTUM / (steps + 1) + change * steps / 2
        return max(low, min(high, most))
