"""What is tried on the simulated robot is what drives a real base: one scenario on both."""

from __future__ import annotations

from typing import Any

import pytest

from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.signals import Event, Twist
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.drive import DriveSystem
from hri.hal.emergency_stop import EmergencyStop
from hri.hal.rank import Outranked
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.robot import Robot

MOVING = str(paths.house() / "apps" / "companion" / "moving.xml")


class Ride:
    """A robot with the network alone that drives the companion, and what happens to it."""

    def __init__(self, config: str) -> None:
        self.robot = Robot(MOVING, config, clock=FakeClock())
        self.clock, self.notes = self.robot.clock, list[Any]()
        self.robot.events.subscribe("drive.*", self._note)

    def _note(self, event: Event) -> None:
        note = event.name, event.properties.get("reason")
        if note != next(reversed(self.notes), None):  # how often a motion is told depends on time
            self.notes.append(note)

    def go(self, drive: DriveSystem, bus: BaseBus, twist: Twist, seconds: float = 2.0) -> None:
        """Ask for a velocity for a while; note how fast that becomes."""
        end = self.clock.now() + seconds
        while self.clock.now() < end:
            drive.set_velocity(twist, self.clock.now())
            self.robot.wait(0.05)
        velocity = bus.state.velocity
        self.notes.append((round(velocity.linear, 3), round(velocity.angular, 3)))

    def refused(self, deed: Any) -> None:
        try:
            deed()
        except HriError as error:
            self.notes.append((type(error).__name__, str(error).partition(": ")[2]))


def scenario(config: str) -> list[Any]:
    ride = Ride(config)
    with ride.robot as robot:
        robot.move(0.2)
        robot.wait(1.0)
        drive = robot.resources.obtain("drive", DriveSystem)
        (bus,) = robot.resources.opened(BaseBus)
        ride.notes.append(bus.is_latched)
        ride.go(drive, bus, Twist(0.4))
        ride.go(drive, bus, Twist(-0.4))
        ride.go(drive, bus, Twist(0.0, 1.4))
        robot.wait(0.5)
        ride.notes.append(bus.state.velocity)
        bus.teleop(Twist(0.1))
        ride.refused(lambda: drive.set_velocity(Twist(-0.1), ride.clock.now()))
        robot.wait(0.5)
        assert isinstance(drive, EmergencyStop)
        drive.stop_latched("you said stop")
        ride.refused(lambda: drive.move_delta(0.1, 0.1, 0.4).result())
        ride.go(drive, bus, Twist(0.2))
        drive.unlatch()
        robot.wait(0.2)
        ride.go(drive, bus, Twist(0.2))
        bus.hear_person(4.0)
        ride.notes.append(bus.state.allowed.forward)
    return ride.notes


def test_a_simulated_base_and_a_create_2_do_the_same() -> None:
    simulated, real = scenario("simulated"), scenario("create2")
    assert simulated == real
    assert ("drive.stopped", "e-stop") in simulated
    assert ("drive.stopped", "timeout") in simulated
    assert (0.3, 0.0) in simulated
    assert (-0.15, 0.0) in simulated
    assert (0.0, 1.0) in simulated
    assert Outranked.__name__ in {note[0] for note in simulated if isinstance(note, tuple)}


def test_the_limits_of_a_simulated_base_are_parameters_of_its_drive() -> None:
    drive = Description("drive", "Hri.SimulatedDrive", {"near_forward": "0.2"})
    with ResourceManager([drive], FakeClock()) as resources:
        assert resources.obtain("drive", DriveSystem).max_linear == pytest.approx(0.2)
    wrong = Description("drive", "Hri.SimulatedDrive", {"near_forward": "fast"})
    with pytest.raises(AuthoringError, match="near_forward"):
        ResourceManager([wrong], FakeClock()).check()
