"""Limits of a base's velocity, and the speed from which it can still stop: pure arithmetic."""

from __future__ import annotations

from dataclasses import dataclass

from hri.core.signals import Twist
from hri.hal.motion_profile import stopping_speed

START_GAP = 0.05
"""Meters beyond the clearance that must be free before a resting base sets off, so that noise
does not make it creep."""
REACTION = 0.1
"""Seconds from an obstacle to brakes: a report, a step, and what a small base takes to follow."""
LEAST = 0.01
"""Meters a second; slower is not worth the creeping."""
PRUDENCE = 0.7
"""Share of the deceleration that is counted on; the rest covers delays."""


@dataclass(frozen=True, slots=True)
class Cap:
    """The fastest that is allowed just now, all at or above 0."""

    forward: float
    """Meters a second."""
    backward: float
    angular: float
    """Radians a second, to either side."""


@dataclass(frozen=True, slots=True)
class BaseLimits:
    """The limits of a base, for any command; its hardware may be slower.

    The defaults are meant for a light base at home, and are not from a standard: see
    docs/safety.md.
    """

    forward: float = 0.5
    """Meters a second."""
    backward: float = 0.25
    """Meters a second; few bases see behind them."""
    angular: float = 1.5
    """Radians a second."""
    near_forward: float = 0.3
    """Meters a second where someone is near, or nobody knows."""
    near_backward: float = 0.15
    near_angular: float = 1.0
    acceleration: float = 0.5
    """Meters a second squared, away from rest."""
    deceleration: float = 1.0
    """Toward rest."""
    jerk: float = 5.0
    """Meters a second cubed."""
    angular_acceleration: float = 2.0
    """Radians a second squared."""
    angular_deceleration: float = 4.0
    angular_jerk: float = 20.0
    """Radians a second cubed."""

    def cap(self, is_near: bool) -> Cap:
        """The fastest that is allowed with or without people about."""
        if is_near:
            return Cap(
                min(self.near_forward, self.forward),
                min(self.near_backward, self.backward),
                min(self.near_angular, self.angular),
            )
        return Cap(self.forward, self.backward, self.angular)


def within_hardware(cap: Cap, fastest: Twist) -> Cap:
    """The cap, cut to what the hardware can do at all, m/s and rad/s."""
    return Cap(
        min(cap.forward, fastest.linear),
        min(cap.backward, fastest.linear),
        min(cap.angular, fastest.angular),
    )


def within(twist: Twist, cap: Cap) -> Twist:
    """The velocity within the cap; both parts shrink alike, so that a curve keeps its shape.

    Where driving is not allowed at all, turning still is.
    """
    most = cap.forward if twist.linear > 0 else cap.backward
    if most <= 0:
        return Twist(0.0, max(-cap.angular, min(cap.angular, twist.angular)))
    excess = max(1.0, abs(twist.linear) / most, abs(twist.angular) / max(cap.angular, 1e-9))
    return Twist(twist.linear / excess, twist.angular / excess)


def safe_speed(
    free: float,
    clearance: float,
    deceleration: float,
    is_moving: bool,
    reaction: float = REACTION,
) -> float:
    """The speed, m/s, from which it stops `clearance` before what is `free` meters away.

    It counts on a prudent share of the deceleration. A way that is NaN counts as none.
    """
    left = free - clearance - (0.0 if is_moving else START_GAP)
    speed = stopping_speed(left, reaction, deceleration * PRUDENCE)
    return speed if speed >= LEAST else 0.0
