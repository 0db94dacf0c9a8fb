"""Your own base: what is said on its serial line.

The supervisor owns the port, watches the base and stops it; this is only bytes out and bytes in.
Here the base takes `v LEFT RIGHT`, the speeds of its wheels in mm/s, and prints twenty times a
second `LEFT RIGHT`, how far they have rolled in mm. It must stop by itself when it hears nothing.
"""

import re
from collections.abc import Sequence
from typing import Self

from hri.core import Twist
from hri.drive.bases.odometer import Encoders, Odometer
from hri.drive.bases.protocol import BaseProtocol, BaseReport, Greeting, Sensors
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal import Description

WAYS = re.compile(rb"(-?\d{1,9}) (-?\d{1,9})")
LONGEST = 64  # bytes of a line


class ThingProtocol(BaseProtocol):
    """How your base speaks; see hri/drive/bases/arduino.py for one with sensors."""

    title = "thing"
    baud = 115_200
    period = 0.05  # seconds between two reports
    timeout = 0.5  # seconds without a word after which it stops by itself
    question = b"?\n"  # what base are you?
    resync = b"\n"  # ends a line that was cut off
    track = 0.2  # meters between the wheels
    limits = Twist(0.3, 3.0)  # the fastest it goes, m/s, and turns, rad/s
    sensors = Sensors()

    def __init__(self) -> None:
        self._odometer = Odometer(Encoders(0.001, self.track, 32, self.limits.linear))
        self._line = b""

    @classmethod
    def described(cls, description: Description) -> Self:
        return cls()

    @classmethod
    def recognizes(cls, answer: bytes) -> bool:
        return answer.startswith(b"thing")

    def greeting(self) -> Sequence[Greeting]:
        return (Greeting(self.stop),)

    def velocity(self, twist: Twist) -> bytes:
        left, right = self._rims(twist)
        return b"v %d %d\n" % (round(1000 * left), round(1000 * right))

    @property
    def stop(self) -> bytes:
        return b"v 0 0\n"

    @property
    def emergency_stop(self) -> bytes:
        return self.resync + self.stop

    def feed(self, data: bytes, now: float) -> list[BaseReport]:
        *lines, self._line = (self._line + data).split(b"\n")
        self._line = self._line[-LONGEST:]
        reports = []
        for line in lines:
            if ways := WAYS.fullmatch(line.strip()):
                self._odometer.add(int(ways[1]), int(ways[2]), now)
                rolled, velocity = self._odometer.rolled, self._odometer.velocity
                reports.append(BaseReport(now, rolled, velocity, mode="ready"))
        return reports


class Thing(BaseBus):
    """The bus of a configuration, on which drive and odometry sit."""

    protocol = ThingProtocol
    line = ""  # nothing emulates it
