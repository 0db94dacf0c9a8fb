"""The arithmetic of two driven wheels on one axle: meters, radians, seconds."""

from __future__ import annotations

from dataclasses import dataclass

from hri.core.signals import Twist


@dataclass(frozen=True, slots=True)
class WheelPair:
    """Where two wheels stand beside the middle of the axle; a wheel to the left has y > 0.

    The base is rigid: a wheel at y rolls with v - w y, where v is the velocity of the middle and
    w that of turning (Siegwart and Nourbakhsh, "Introduction to Autonomous Mobile Robots", 3.2).
    """

    first: float
    second: float
    """y of the wheels, meters; never the same."""

    @property
    def track(self) -> float:
        """Meters between the wheels."""
        return abs(self.first - self.second)

    def rolling(self, linear: float, angular: float) -> tuple[float, float]:
        """What both wheels do when the base does this: ways or velocities."""
        return linear - angular * self.first, linear - angular * self.second

    def base(self, first: float, second: float) -> Twist:
        """What the base does when the wheels do this; undoes `rolling`."""
        angular = (first - second) / (self.second - self.first)
        return Twist(first + angular * self.first, angular)
