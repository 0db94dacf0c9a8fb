"""The kinds of bases, each with its protocol and its emulator.

A new one is a protocol, a bus of two lines here, and its entry point.
"""

from __future__ import annotations

from hri.drive.bases.arduino import ArduinoBridge
from hri.drive.bases.create2 import Create2
from hri.drive.supervisor.base_bus import BaseBus


class Create2Bus(BaseBus):
    """An iRobot Create 2, or a Roomba of the 500 and 600 series."""

    protocol = Create2
    line = "Hri.EmulatedCreate2"


class ArduinoBus(BaseBus):
    """An Arduino or its like with the ROSArduinoBridge protocol."""

    protocol = ArduinoBridge
    line = "Hri.EmulatedArduino"
