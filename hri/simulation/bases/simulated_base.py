"""The base of the simulated world, with the sensors of its configuration."""

from __future__ import annotations

from typing import ClassVar

from hri.core.signals import Twist
from hri.drive.supervisor.base_bus import LIMITS, refuse_wrong_limits
from hri.drive.supervisor.base_drive import BaseDrive
from hri.drive.supervisor.in_process_bus import DeviceLine, InProcessBus, declare_base
from hri.hal.motion import Way
from hri.hal.resource import Description
from hri.simulation.base import ORDINARY
from hri.simulation.in_world import InWorld, world_id

BASE = "Hri.SimulatedBase"
"""Type of the base that a simulated drive declares."""


class SimulatedDrive(InWorld, BaseDrive):
    """The motors of the simulated base, driven together; its limits are parameters of the drive."""

    parameters: ClassVar[tuple[str, ...]] = (*BaseDrive.parameters, *LIMITS)

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        refuse_wrong_limits(description)

    def _declare_base(self) -> None:
        numbers = {
            "linear": ORDINARY.linear,
            "angular": ORDINARY.angular,
            "track": ORDINARY.track,
            "acceleration": ORDINARY.acceleration,
            "angular_acceleration": ORDINARY.angular_acceleration,
        }
        declare_base(self.manager, self._base_id(), BASE, self.description, numbers)

    def _base_id(self) -> str:
        return f"{world_id(self.manager, self.description.bus)}_base"


class SimulatedBase(InProcessBus):
    """The base of a simulated world, whose id it has with "_base" behind it."""

    is_simulated = True
    line = "Hri.SimulatedWheels"


class SimulatedWheels(InWorld, DeviceLine):
    """The wheels of the simulated base."""

    def roll(self, twist: Twist, now: float) -> None:
        self.world.command(twist, now)

    def brake(self, now: float) -> None:
        self.world.brake(now)

    def rolled(self, now: float) -> Way:
        self.world.advance(now)
        return Way(self.world.base.travelled, self.world.base.odometry.heading)

    def velocity(self, now: float) -> Twist:
        self.world.advance(now)
        return self.world.base.velocity

    def set_power(self, percent: float, now: float) -> None:
        self.world.hold(self.id, percent > 0)
