"""A base whose wheels and sensors are devices of this program, on a line in memory.

The simulated base is one, and so is a base of two motors that have drivers. To the supervisor it
is a base like any other: it is told velocities, and it reports.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator, Sequence
from typing import Any, ClassVar, Self

from hri.core.signals import Twist
from hri.drive.bases.protocol import BaseProtocol, BaseReport, Greeting, Sensors
from hri.hal.motion import Way
from hri.hal.resource import Description

PERIOD = 0.02
"""Seconds between two reports."""
TIMEOUT = 0.5
"""Seconds without a velocity after which the base stops by itself."""
STOP = b"s"
GO = b"v"
"""Begins a velocity; m/s and rad/s follow, as doubles."""
_TWIST = struct.Struct("<dd")
SPEED = (0.5, 0.01, 20.0)
"""Default, least and most of `linear` and `angular`, m/s and rad/s."""
TRACK = (0.3, 0.001, 5.0)
"""The same of `track`, meters."""


class InProcess(BaseProtocol):
    """Its parameters: `linear`, `angular` (the fastest, m/s and rad/s), `track` (meters), and
    `bumps`, `cliffs`, `ranges`: lists such as "left:bumper_left right:bumper_right", a place and
    the id of a device each."""

    title = "base of devices of this program"
    parameters: ClassVar[tuple[str, ...]] = (
        "linear",
        "angular",
        "track",
        "bumps",
        "cliffs",
        "ranges",
    )
    baud = 0
    period = PERIOD
    timeout = TIMEOUT
    question = b""

    def __init__(self, limits: Twist, track: float, sensors: Sensors) -> None:
        self.limits, self.track, self.sensors = limits, track, sensors
        self._come = bytearray()

    @classmethod
    def described(cls, description: Description) -> Self:
        linear, angular = (description.number_within(n, *SPEED) for n in ("linear", "angular"))
        names = {n: tuple(devices(description, n)) for n in ("bumps", "cliffs", "ranges")}
        track = description.number_within("track", *TRACK)
        return cls(Twist(linear, angular), track, Sensors(**names))

    @classmethod
    def recognizes(cls, answer: bytes) -> bool:
        return False  # it is on no port that anyone could ask

    def greeting(self) -> Sequence[Greeting]:
        return ()

    def velocity(self, twist: Twist) -> bytes:
        slowed = self._slowed(twist)
        return GO + _TWIST.pack(slowed.linear, slowed.angular)

    @property
    def stop(self) -> bytes:
        return STOP

    @property
    def emergency_stop(self) -> bytes:
        return STOP

    def feed(self, data: bytes, now: float) -> list[BaseReport]:
        *lines, rest = (bytes(self._come) + data).split(b"\n")
        self._come = bytearray(rest)
        reports = []
        for line in lines:
            try:
                reports.append(_report(json.loads(line), now))
            except (ValueError, TypeError, KeyError):
                self.senseless += len(line)
        return reports


def devices(description: Description, kind: str) -> dict[str, str]:
    """The ids of the devices of a kind, "bumps", "cliffs" or "ranges", by their places."""
    pairs = (pair.partition(":") for pair in description.text(kind).split())
    return {place: id for place, _, id in pairs}


def commands(data: bytes) -> Iterator[Twist | None]:
    """The commands in bytes that such a base is told: velocities, None for a stop."""
    at = 0
    while at < len(data):
        is_stop = data[at : at + 1] == STOP
        yield None if is_stop else Twist(*_TWIST.unpack_from(data, at + 1))
        at += 1 if is_stop else 1 + _TWIST.size


def encoded(report: BaseReport) -> bytes:
    """What such a base measures of a report, as it sends it."""
    rolled, velocity = report.rolled, report.velocity or Twist()
    motion = rolled.linear, rolled.angular, velocity.linear, velocity.angular
    return json.dumps([motion, report.bumps, report.cliffs, report.ranges]).encode() + b"\n"


def _report(told: Sequence[Any], now: float) -> BaseReport:
    (way, turned, linear, angular), bumps, cliffs, ranges = told
    rolled, velocity = Way(way, turned), Twist(linear, angular)
    return BaseReport(now, rolled, velocity, bumps, cliffs, ranges=ranges, mode="ready")
