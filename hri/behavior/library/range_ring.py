"""All range sensors of the robot as one ring around it (see `quadrants` for the geometry)."""

from __future__ import annotations

from hri.behavior.behavior import Context
from hri.behavior.device import DeviceBehavior
from hri.behavior.library.quadrants import Quadrant, clearance, quadrants
from hri.behavior.ports import DBL_MAX, Output, Param
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource_manager import ResourceManager


class FuzzyRangeSensorRing(DeviceBehavior):
    """Sends how far the nearest thing is on each side of the robot: front, left, back, right.

    Centimeters from the nearest edge of the robot's box, by the shortest reading of the sensors
    that cover the side; the largest number there is where nothing is in range or no sensor looks.
    """

    is_sensor = True
    sensor_ids = Param("", "ids with spaces between; empty takes all range sensors there are")
    ranges = Output[tuple[float, ...]]("doublearray", "front, left, back, right in centimeters")

    def start(self, context: Context) -> None:
        super().start(context)
        self._box = context.resources.dimensions
        self._sensors = []
        for id in self.sensor_ids.split() or _all_ids(context.resources):
            sensor, pose = self.obtain(id, RangeSensor), context.resources.pose_of(id)
            self._sensors.append((sensor, pose, quadrants(pose, self._box)))

    def compute(self, now: float, dt: float) -> None:
        nearest = [DBL_MAX] * len(Quadrant)
        for sensor, pose, sides in self._sensors:
            distance = clearance(pose, sensor.read(now).distance, self._box) * 100
            for side in sides:
                nearest[side] = min(nearest[side], distance)
        self.ranges.send(tuple(nearest))


def _all_ids(resources: ResourceManager) -> list[str]:
    """The range sensors of the configuration; a stand-in is reached through what it stands for."""
    stand_ins = {description.text("stand_in") for description in resources.descriptions.values()}
    return [id for id in resources.ids(RangeSensor) if id not in stand_ins]
