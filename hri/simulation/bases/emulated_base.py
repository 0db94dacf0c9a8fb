"""Emulated bases as resources: in the simulated world, on a port in memory.

A base of a configuration whose port is "simulated" declares the one that it needs.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

from hri.core.errors import did_you_mean
from hri.drive.bases.arduino import ArduinoBridge
from hri.drive.bases.create2 import Create2
from hri.drive.supervisor.line import BaseLine
from hri.hal.port import Port
from hri.simulation.bases.body import PLACES, RoomBody
from hri.simulation.bases.emulated_arduino import EmulatedArduino, limits
from hri.simulation.bases.emulated_create2 import EmulatedCreate2
from hri.simulation.bases.emulated_line import EmulatedPort, Line
from hri.simulation.bases.emulator import Emulator
from hri.simulation.in_world import InWorld

AUTO_STOP = 0.5
"""Seconds without a velocity after which our firmware stops the wheels."""


class EmulatedBase(InWorld, BaseLine):
    """A line to the base of the simulated world; its parameters are those of the protocol.

    What goes wrong on it is `port.line.faults`, its plug `port.is_plugged`.
    """

    port: EmulatedPort

    def connect(self) -> Port:
        return self.port

    def _open(self) -> None:
        super()._open()
        seed = self.world.seed_for(f"{self.id} bytes")
        self.port = EmulatedPort(Line(self._emulator(), seed=seed), self.id)

    @abstractmethod
    def _emulator(self) -> Emulator:
        """The base at the other end."""


class Create2Line(EmulatedBase):
    """A Create 2."""

    parameters: ClassVar[tuple[str, ...]] = Create2.parameters

    def _emulator(self) -> Emulator:
        return EmulatedCreate2(RoomBody(self.world), self.world.seed_for(self.id))


class ArduinoLine(EmulatedBase):
    """An Arduino with our firmware."""

    parameters: ClassVar[tuple[str, ...]] = ArduinoBridge.parameters

    def _emulator(self) -> Emulator:
        told = ArduinoBridge.described(self.description)
        for name, places in (("cliffs", told.wiring.cliffs), ("sonars", told.wiring.sonars)):
            for place in places:
                if place not in PLACES:
                    what = f'the emulated base has no place "{place}"'
                    raise self.description.error(name, what, did_you_mean(place, PLACES))
        body = RoomBody(self.world, limits(told.shape))
        pin = int(told.battery["battery_pin"])
        return EmulatedArduino(
            told.wiring,
            body,
            pin,
            auto_stop=AUTO_STOP,
            shape=told.shape,
            knows_checks=True,
            battery=told.battery,
        )
