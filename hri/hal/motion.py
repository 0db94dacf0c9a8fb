"""Motions of a base, step by step: pure arithmetic on the time and on what the wheels measure."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.hal.motion_profile import Trapezoid, toward

PERIOD = 0.02
"""Seconds between two commands."""
REST = Twist()
STANDING = Twist(0.001, 0.002)
"""What is slower, in m/s and rad/s, stands."""
_SETTLE = 1.0
"""Seconds after its planned end that a motion may take for the last millimeter."""


@dataclass(frozen=True, slots=True)
class Way:
    """How far the wheels have carried the base."""

    linear: float = 0.0
    """Meters ahead."""
    angular: float = 0.0
    """Radians to the left, whole turns included."""


@dataclass(frozen=True, slots=True)
class Response:
    """How a base follows what it is told."""

    gain: float
    """Meters a second for each meter that a motion lags behind."""
    move_lead: float
    """Seconds it takes to follow when it drives; the profile is read earlier by this."""
    turn_lead: float
    """The same when it turns."""
    near: Way
    """A motion that ends within this has arrived; not finer than the wheels measure."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What the wheels measure."""

    travelled: Way
    """Since the motion began."""
    velocity: Twist
    response: Response

    @property
    def stands(self) -> bool:
        """Whether the base is at rest."""
        return (
            abs(self.velocity.linear) <= STANDING.linear
            and abs(self.velocity.angular) <= STANDING.angular
        )


class Motion(ABC):
    """One command to the base, from its beginning to its end."""

    is_braking: ClassVar[bool] = False
    """True for one that lets the hardware brake, whatever velocity it says."""

    @abstractmethod
    def step(self, elapsed: float, reading: Reading) -> Twist | None:
        """The velocity for the next PERIOD, `elapsed` seconds after the start; None at the end.

        Raises HriError when the base does not follow.
        """


@dataclass(frozen=True, slots=True)
class _Axis:
    """What differs between driving and turning."""

    name: str
    lag: float
    """Meters or radians; a base that is so far behind is held up."""
    scale: float
    unit: str

    def told(self, way: float) -> str:
        return f"{way * self.scale:.1f} {self.unit}"


_LINEAR = _Axis("moved", 0.25, 100.0, "cm")
_ANGULAR = _Axis("turned", 0.8, math.degrees(1), "degrees")


class MoveDelta(Motion):
    """Straight on along a profile; what the wheels lag behind, or drift aside, is made up for."""

    def __init__(self, profile: Trapezoid) -> None:
        self.profile = profile

    def step(self, elapsed: float, reading: Reading) -> Twist | None:
        done, response = reading.travelled, reading.response
        near, lead = response.near.linear, response.move_lead
        linear = _followed(self.profile, _LINEAR, elapsed, done.linear, near, lead, reading)
        return None if linear is None else Twist(linear, -response.gain * done.angular)


class TurnDelta(Motion):
    """On the spot along a profile."""

    def __init__(self, profile: Trapezoid) -> None:
        self.profile = profile

    def step(self, elapsed: float, reading: Reading) -> Twist | None:
        done, response = reading.travelled, reading.response
        near, lead = response.near.angular, response.turn_lead
        angular = _followed(self.profile, _ANGULAR, elapsed, done.angular, near, lead, reading)
        return None if angular is None else Twist(-response.gain * done.linear, angular)


def _followed(
    profile: Trapezoid,
    axis: _Axis,
    elapsed: float,
    done: float,
    near: float,
    lead: float,
    reading: Reading,
) -> float | None:
    """The velocity that follows the profile; None when the base has arrived and stands.

    It is the mean over the next period: so the commands add up to the whole way.
    """
    lag = profile.position(elapsed) - done
    if abs(lag) > axis.lag or elapsed > profile.duration + _SETTLE:
        raise HriError(
            f"it {axis.name} {axis.told(done)} of {axis.told(profile.distance)}"
            " - see what holds it up"
        )
    if elapsed >= profile.duration and abs(lag) <= near:
        return None if reading.stands else 0.0
    start = elapsed + lead
    ahead = profile.position(start + PERIOD) - profile.position(start)
    velocity = ahead / PERIOD + reading.response.gain * lag
    return max(-profile.velocity, min(profile.velocity, velocity))


class Ramp(Motion):
    """Toward a velocity with even accelerations, from a velocity at the start; has no end."""

    def __init__(self, start: Twist, goal: Twist, acceleration: Twist) -> None:
        self.start, self.goal, self.acceleration = start, goal, acceleration

    def step(self, elapsed: float, reading: Reading) -> Twist | None:
        time = elapsed + PERIOD
        return Twist(
            toward(self.start.linear, self.goal.linear, self.acceleration.linear * time),
            toward(self.start.angular, self.goal.angular, self.acceleration.angular * time),
        )


class SlowDown(Ramp):
    """Down to rest with even decelerations; over when the base stands."""

    def __init__(self, start: Twist, deceleration: Twist) -> None:
        super().__init__(start, REST, deceleration)

    def step(self, elapsed: float, reading: Reading) -> Twist | None:
        wanted = super().step(elapsed, reading)
        return None if wanted == REST and reading.stands else wanted


class Brake(Motion):
    """To rest as fast as the hardware can; over when the base stands."""

    is_braking = True

    def step(self, elapsed: float, reading: Reading) -> Twist | None:
        return None if reading.stands else REST
