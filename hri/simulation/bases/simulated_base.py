"""The base of the simulated world, with the sensors of its configuration."""

from __future__ import annotations

from collections.abc import Mapping

from hri.core.signals import Twist
from hri.drive.supervisor.in_process_bus import DeviceDrive, DeviceLine, InProcessBus
from hri.hal.motion import Way
from hri.simulation.base import ORDINARY
from hri.simulation.in_world import InWorld, world_id


class SimulatedDrive(InWorld, DeviceDrive):
    """The motors of the simulated base, driven together."""

    base_type = "Hri.SimulatedBase"

    def _abilities(self) -> Mapping[str, float]:
        return {
            "linear": ORDINARY.linear,
            "angular": ORDINARY.angular,
            "track": ORDINARY.track,
            "acceleration": ORDINARY.acceleration,
            "angular_acceleration": ORDINARY.angular_acceleration,
        }

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
