"""A base of devices of this program behind its supervisor, which runs on the program's clock.

A drive without a serial line, the simulated one or one of two motors, declares such a
base: its wheels are on a `DeviceLine`, and all range sensors, bumpers and cliff sensors of the
configuration belong to it.
"""

from __future__ import annotations

import logging
import math
from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import ClassVar, TypeVar

from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Pose2D, RangeReading, Twist
from hri.drive.bases.in_process import PERIOD, InProcess, commands, devices, encoded
from hri.drive.bases.protocol import BaseReport, Sensors
from hri.drive.mechanics import mechanics_of, sensors
from hri.drive.supervisor.base_bus import (
    LIMITS,
    SIMULATED,
    STALE,
    BaseBus,
    refuse_wrong_limits,
)
from hri.drive.supervisor.base_drive import BaseDrive
from hri.drive.supervisor.controller import SAME
from hri.drive.supervisor.line import BaseLine
from hri.hal.bumper import Bumper
from hri.hal.cliff_sensor import CliffSensor
from hri.hal.motion import Response, Way
from hri.hal.port import Port
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description, Resource

KINDS: Mapping[str, type[Resource]] = {
    "bumps": Bumper,
    "cliffs": CliffSensor,
    "ranges": RangeSensor,
}
"""The sensors of such a base, by the parameter that lists them."""
ORDINARY_WORDS = frozenset({"bumper", "cliff", "range", "sensor"})
"""Words of an id that do not say where a sensor is."""

log = logging.getLogger("hri.drive")

R = TypeVar("R", bound=Resource)
V = TypeVar("V")


class InProcessBus(BaseBus):
    """Its devices report through the supervisor; what they are is in its description."""

    protocol = InProcess
    response = Response(5.0, 0.06, 0.045, Way(0.001, math.radians(0.1)))

    def set_power(self, percent: float, now: float) -> None:
        self._wheels.set_power(percent, now)

    def _line(self) -> BaseLine:
        self._wheels = self.use(self._declared_line(), DeviceLine)
        return self._wheels

    def _protocol(self) -> InProcess:
        protocol = self.protocol.described(self.description)
        protocol.sensors = self._wheels.sensors
        return protocol

    def _mounts(self) -> Mapping[str, Pose2D]:
        places = {id: place for place, id in devices(self.description, "ranges").items()}
        mounts = mechanics_of(self.manager, places).mounts
        there = self._wheels.sensors.ranges
        return {places[id]: mount for id, mount in mounts.items() if places[id] in there}


class DeviceDrive(BaseDrive):
    """The drive of such a base, which it declares; the limits of the base are its parameters."""

    base_type: ClassVar[str]
    """Type of the base."""
    parameters: ClassVar[tuple[str, ...]] = (*BaseDrive.parameters, *LIMITS)

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        refuse_wrong_limits(description)

    @abstractmethod
    def _abilities(self) -> Mapping[str, float]:
        """What the hardware can do: the numbers among the parameters of the base."""

    def _declare_base(self) -> None:
        """Declare it with all sensors that the configuration has."""
        of = self.description
        hardware = {name: repr(number) for name, number in self._abilities().items()}
        places = {name: _listed(sensors(self.manager, kind)) for name, kind in KINDS.items()}
        limits = {name: text for name, text in of.parameters.items() if name in LIMITS}
        parameters = {"port": SIMULATED, **hardware, **places, **limits}
        id = self._base_id()
        base = Description(id, self.base_type, parameters, of.bus, of.members, of.place, of.places)
        self.manager.declare(base)


def _listed(ids: Iterable[str]) -> str:
    """Each id behind the place that it names: "front:range_front"."""
    places: dict[str, str] = {}
    for id in ids:
        place = "_".join(word for word in id.split("_") if word.lower() not in ORDINARY_WORDS)
        places[id if place in places else place] = id
    return " ".join(f"{place}:{id}" for place, id in places.items())


class DeviceLine(BaseLine):
    """The wheels of such a base, and its sensors; the line that leads to them is always open."""

    parameters: ClassVar[tuple[str, ...]] = InProcess.parameters

    def _open(self) -> None:
        super()._open()
        self._bumps = self._sensors("bumps", Bumper)
        self._cliffs = self._sensors("cliffs", CliffSensor)
        self._ranges = self._sensors("ranges", RangeSensor)

    @property
    def sensors(self) -> Sensors:
        """Those that are there, by their places."""
        return Sensors(
            bumps=tuple(self._bumps), cliffs=tuple(self._cliffs), ranges=tuple(self._ranges)
        )

    def connect(self) -> Port:
        return _DevicePort(self)

    def report(self, now: float) -> BaseReport:
        """What its devices measure; one that fails says nothing."""
        return BaseReport(
            now,
            self.rolled(now),
            self.velocity(now),
            bumps=_read(self._bumps, lambda sensor: sensor.is_pressed(now)),
            cliffs=_read(self._cliffs, lambda sensor: sensor.is_cliff(now)),
            ranges=_read(self._ranges, lambda sensor: _distance(sensor.read(now), now)),
        )

    @abstractmethod
    def roll(self, twist: Twist, now: float) -> None:
        """Go on with this velocity."""

    @abstractmethod
    def brake(self, now: float) -> None:
        """Stand still as fast as the hardware can."""

    @abstractmethod
    def rolled(self, now: float) -> Way:
        """How far the wheels have carried the base since it was switched on."""

    @abstractmethod
    def velocity(self, now: float) -> Twist:
        """What the wheels measure."""

    @abstractmethod
    def set_power(self, percent: float, now: float) -> None:
        """Let the motors use a share of their force, 0 to 100."""

    def _sensors(self, kind: str, interface: type[R]) -> Mapping[str, R]:
        """The sensors of a kind by their places; one that is not there is left out of reports."""
        found = {}
        for place, id in devices(self.description, kind).items():
            try:
                found[place] = self.use(id, interface)
            except HriError as error:
                log.info("%s - the base goes without it", error)
        return found


class _DevicePort(Port):
    """The line in memory: a velocity is carried out at once, a report follows each PERIOD."""

    def __init__(self, line: DeviceLine) -> None:
        self._line = line
        self._is_open = False
        self._due = -math.inf
        self._reason = ""

    @property
    def is_open(self) -> bool:
        return self._is_open

    @property
    def reason(self) -> str:
        return "" if self._is_open else self._reason

    def open(self, now: float) -> bool:
        self._is_open = self._line.is_active
        return self._is_open

    def read(self, now: float) -> bytes:
        if now < self._due - SAME:
            return b""
        self._due = now + PERIOD
        try:
            return encoded(self._line.report(now))
        except Exception as error:  # a base that says nothing stands, and may speak again
            log.debug("%s: %s", self._line.id, error)
            return b""

    def write(self, data: bytes, now: float) -> bool:
        with self._guarded():
            for twist in commands(data):
                if twist is None:
                    self._line.brake(now)
                else:
                    self._line.roll(twist, now)
        return True

    def close(self) -> None:
        self._is_open = False

    @contextmanager
    def _guarded(self) -> Iterator[None]:
        """Wheels that fail are as good as gone."""
        try:
            yield
        except Exception as error:
            if not isinstance(error, HriError):
                log.error("%s: %s", self._line.id, error, exc_info=error)
            self._is_open, self._reason = False, str(error)
            raise NotAvailable(f"{self._line.id}: {error}") from error


def _distance(reading: RangeReading, now: float) -> float | None:
    """Meters; a sensor that has stopped measuring says nothing."""
    return reading.distance if now - reading.time <= STALE else None


def _read(sensors: Mapping[str, R], value: Callable[[R], V | None]) -> dict[str, V]:
    """What the sensors say, without those that fail."""
    read = {}
    for place, sensor in sensors.items():
        try:
            said = value(sensor)
        except Exception as error:  # a driver that breaks is a sensor that says nothing
            log.debug("%s: %s", sensor.id, error)
            continue
        if said is not None:
            read[place] = said
    return read
