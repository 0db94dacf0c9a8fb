"""The range sensors of the configuration, watched for someone who comes."""

from __future__ import annotations

import logging

from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.drive.mechanics import mechanics_of, range_sensors
from hri.drive.supervisor.oncoming import Oncoming
from hri.hal.motion import Way
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource_manager import ResourceManager

BRAKES = 1.0
"""Meters a second squared that a small base brakes with at least when it is stopped at once."""

log = logging.getLogger("hri.drive")


class OncomingWatch:
    """Reads all range sensors there are, until it is released; one that is missing is left out."""

    def __init__(self, resources: ResourceManager) -> None:
        self._resources = resources
        self._sensors: dict[str, RangeSensor] = {}
        for id in range_sensors(resources):
            try:
                self._sensors[id] = resources.obtain(id, RangeSensor)
            except HriError as error:
                log.info("%s - it is not watched for people", error)
        mechanics = mechanics_of(resources, self._sensors)
        self._oncoming = Oncoming(mechanics.mounts, mechanics.radius)
        self._rolled = Way()

    def look(self, now: float, going: Twist, dt: float) -> None:
        """Take in what the sensors say; `going` is what the base did for the last `dt` seconds."""
        rolled = self._rolled
        self._rolled = Way(rolled.linear + going.linear * dt, rolled.angular + going.angular * dt)
        ranges = {id: sensor.read(now).distance for id, sensor in self._sensors.items()}
        self._oncoming.see(now, self._rolled, ranges)

    def speed(self, now: float) -> float:
        """The fastest at which the base still stands before who comes, m/s; infinite for nobody."""
        return self._oncoming.speed(now, BRAKES)

    def pace(self, now: float) -> float:
        """The speed that is enough near people, m/s."""
        return self._oncoming.pace(now)

    def release(self) -> None:
        """Give the sensors back."""
        for sensor in self._sensors.values():
            self._resources.release(sensor)
        self._sensors.clear()


def stopping_time(going: Twist) -> float:
    """Seconds until a base stands that is stopped at once."""
    return abs(going.linear) / BRAKES
