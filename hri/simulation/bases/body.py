"""The body of an emulated base: how it moves, and what presses, is missing or comes near."""

from __future__ import annotations

import math

from hri.core.geometry import placed
from hri.core.signals import Pose2D, Twist
from hri.hal.wheels import WheelPair
from hri.simulation.base import BUMPER_TRAVEL, WATCHDOG, Base, HardwareLimits
from hri.simulation.world import SimulatedWorld

CREATE_2 = HardwareLimits(
    linear=0.5,
    angular=4.25,
    acceleration=2.0,
    angular_acceleration=17.0,
    braking=2.0,
    wheel=0.5,
    track=0.235,
    radius=0.17,
)
"""Sizes and speeds of the Open Interface; how fast it speeds up and brakes is a guess."""
PLACES = {
    "left": 1.05, "front_left": 0.55, "center_left": 0.18, "front": 0.0,
    "center_right": -0.18, "front_right": -0.55, "right": -1.05,
}  # fmt: skip
"""Where a sensor sits on the rim, radians to the left of straight ahead."""
BUMPER_ANGLES = (-1.2, -0.8, -0.4, -0.15, 0.15, 0.4, 0.8, 1.2)
"""Where the ring in front is felt at."""
BOTH_SIDES = 0.2
"""Radians from straight ahead within which a push presses both switches."""


class Body:
    """A round base with two wheels on an endless flat floor.

    What happens to it is set by hand, in sets and tables by place.
    """

    def __init__(self, limits: HardwareLimits = CREATE_2) -> None:
        self.base = Base(lambda x, y, time: math.inf, limits=limits)
        self.pressed: set[str] = set()
        """Sides of the bumper that something presses."""
        self.over_edge: set[str] = set()
        """Cliff sensors with no floor below."""
        self.hanging: set[str] = set()
        """Wheels in the air."""
        self.held: set[str] = set()
        """Buttons that someone presses."""
        self.near: dict[str, float] = {}
        """Meters from the rim to the nearest object."""
        self.is_on_charger = False
        self._level = 1.0
        self._goal = Twist()
        self._commanded = 0.0

    def roll(self, left: float, right: float, now: float) -> None:
        """What the motors ask of the wheels, m/s; they go on with it."""
        self.advance(now)
        half = self.base.limits.track / 2
        self._goal = WheelPair(half, -half).base(left, right)
        self._command(now)

    def advance(self, now: float) -> None:
        """Let time pass; a time that has passed does nothing."""
        # The body has no watchdog: what the firmware asks of it holds.
        while self._goal != Twist() and now - self._commanded > WATCHDOG / 2:
            self._command(self._commanded + WATCHDOG / 2)
        self._advance(now)

    def _command(self, now: float) -> None:
        self._commanded = now
        if self._goal == Twist():
            self._brake(now)
        else:
            self._drive(self._goal, now)

    def _drive(self, twist: Twist, now: float) -> None:
        self.base.command(twist, now)

    def _brake(self, now: float) -> None:
        self.base.brake(now)

    def _advance(self, now: float) -> None:
        self.base.advance(now)

    @property
    def rolled(self) -> tuple[float, float]:
        """Meters that the wheels rolled ahead, left and right."""
        aside = self.base.odometry.heading * self.base.limits.track / 2
        return self.base.travelled - aside, self.base.travelled + aside

    def bumps(self, now: float) -> set[str]:
        """Sides of the bumper that are pressed."""
        return self.pressed

    def is_over_edge(self, place: str) -> bool:
        """Whether there is no floor below a place of the rim."""
        return place in self.over_edge

    def distance(self, place: str, now: float) -> float:
        """Meters from a place of the rim to what is ahead of it; infinity for nothing."""
        return self.near.get(place, math.inf)

    def battery(self, now: float) -> float:
        """0 (empty) to 1 (full)."""
        return self._level


class RoomBody(Body):
    """The base of a simulated world; values set by hand are added to simulated ones."""

    def __init__(self, world: SimulatedWorld, limits: HardwareLimits = CREATE_2) -> None:
        """From now on the base of that world has these limits."""
        super().__init__(limits)
        self._world = world
        self.base = world.base
        self.base.limits = limits
        mount, radius = world.beams.mount, limits.radius
        self._ring = {angle: mount(Pose2D(0.0, 0.0, angle)) for angle in BUMPER_ANGLES}
        self._beams = {
            place: mount(Pose2D(radius * math.cos(angle), radius * math.sin(angle), angle))
            for place, angle in PLACES.items()
        }

    def _drive(self, twist: Twist, now: float) -> None:
        self._world.command(twist, now)

    def _brake(self, now: float) -> None:
        self._world.brake(now)

    def _advance(self, now: float) -> None:
        self._world.advance(now)

    def bumps(self, now: float) -> set[str]:
        reach = self.base.limits.radius + BUMPER_TRAVEL
        felt = [a for a, beam in self._ring.items() if self._world.beam_length(beam, now) < reach]
        left = any(angle > -BOTH_SIDES for angle in felt)
        right = any(angle < BOTH_SIDES for angle in felt)
        sides = {side for side, is_felt in (("left", left), ("right", right)) if is_felt}
        if not felt and self._world.is_bumped(now) and not self.base.is_touching:
            sides = {"left", "right"}  # someone pushes against it
        return self.pressed | sides

    def is_over_edge(self, place: str) -> bool:
        angle, radius = PLACES[place], self.base.limits.radius
        spot = placed(self.base.pose, radius * math.cos(angle), radius * math.sin(angle))
        return super().is_over_edge(place) or self._world.is_drop(*spot)

    def distance(self, place: str, now: float) -> float:
        seen = self._world.beam_length(self._beams[place], now)
        return min(super().distance(place, now), seen)

    def battery(self, now: float) -> float:
        return self._world.battery_level(now)
