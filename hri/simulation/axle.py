"""The wheels of the simulated base when each has its own motor."""

from __future__ import annotations

from dataclasses import replace

from hri.hal.wheels import WheelPair
from hri.simulation.base import Base


class Axle:
    """Makes one motion of what the motors ask of their wheels; a wheel is known by its y.

    A wheel without a motor stands still, as far out on the other side.
    """

    def __init__(self, base: Base) -> None:
        self._base = base
        self._asked: dict[float, float] = {}
        self._powered: set[float] = set()

    @property
    def is_held(self) -> bool:
        """Whether a motor with power keeps the base in its place."""
        return bool(self._powered)

    def mount(self, y: float) -> None:
        """Put a wheel there, meters to the left; the base's limits follow from its wheels."""
        self._asked[y] = 0.0
        limits, pair = self._base.limits, self._pair()
        self._base.limits = replace(
            limits,
            track=pair.track,
            angular=limits.linear / (pair.track / 2),
            angular_acceleration=limits.acceleration / (pair.track / 2),
        )

    def roll(self, y: float, velocity: float, now: float) -> None:
        """Ask a wheel for a velocity of its rim, m/s."""
        self._asked[y] = velocity
        pair = self._pair()
        rims = self._asked[pair.first], self._asked.get(pair.second, 0.0)
        self._base.command(pair.base(*rims), now)

    def brake(self, y: float, now: float) -> None:
        """Stop a wheel; when no other one is asked to roll, the base brakes."""
        self.roll(y, 0.0, now)
        if not any(self._asked.values()):
            self._base.brake(now)

    def power(self, y: float, is_on: bool) -> None:
        """Switch a motor's power."""
        if is_on:
            self._powered.add(y)
        else:
            self._powered.discard(y)

    def rolled(self, y: float) -> float:
        """Meters that a wheel has rolled ahead; the base has to be up to date."""
        return self._base.travelled - y * self._base.odometry.heading

    def velocity(self, y: float) -> float:
        """Velocity of a wheel's rim, m/s; the base has to be up to date."""
        return self._base.velocity.linear - y * self._base.velocity.angular

    def _pair(self) -> WheelPair:
        """The outermost two wheels."""
        left, right = max(self._asked), min(self._asked)
        return WheelPair(left, right if right != left else -left)
