"""The devices of a base, the same for every one of them: they sit on its bus.

<Device id="cliff_left" type="Hri.BaseCliffSensor">
  <Parameter name="sensor" value="left"/>
</Device>
"""

from __future__ import annotations

from typing import ClassVar

from hri.core.errors import did_you_mean
from hri.core.geometry import along_arc
from hri.core.signals import Pose2D, RangeReading, Twist
from hri.drive.bases.protocol import BaseReport, within
from hri.drive.supervisor.base_bus import STALE, BaseBus
from hri.drive.supervisor.link import State
from hri.drive.supervisor.plausibility import MOST_VOLTAGE
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.cliff_sensor import CliffSensor
from hri.hal.drive import Odometry
from hri.hal.motion import REST, Way
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Resource


class OnBase(Resource):
    """A device of a base."""

    bus: BaseBus

    def _open(self) -> None:
        super()._open()
        self._declare_base()
        self.bus = self.use(self._base_id(), BaseBus)

    def _declare_base(self) -> None:
        """Declare the base where the configuration does not name it."""

    def _base_id(self) -> str:
        """Id of the base."""
        return self.description.bus


class OfSensor(OnBase):
    """One of several sensors of a kind, chosen by the parameter `sensor`."""

    parameters: ClassVar[tuple[str, ...]] = ("sensor",)
    kind: ClassVar[str]
    """The field of `Sensors` that names them."""

    def _open(self) -> None:
        super()._open()
        self.sensor = self.description.text("sensor")
        known = getattr(self.bus.protocol.described(self.bus.description).sensors, self.kind)
        if self.sensor not in known and not self._is_any():
            what = f'the base has no sensor "{self.sensor}" of that kind'
            raise self.description.error("sensor", what, did_you_mean(self.sensor, known))

    def _is_any(self) -> bool:
        """Whether it may stand for all of them."""
        return False


class BaseOdometry(OnBase, Odometry):
    """Adds up what the wheels say they rolled; between two states the way counts as one arc."""

    parameters: ClassVar[tuple[str, ...]] = ("polling_interval",)

    def _open(self) -> None:
        super()._open()
        self._pose = Pose2D()
        self._rolled: Way | None = None
        self.bus.watch(self._follow)

    def _close(self) -> None:
        self.bus.unwatch(self._follow)
        super()._close()

    def pose(self, now: float) -> Pose2D:
        return self._pose

    def velocity(self, now: float) -> Twist:
        return self.bus.report().velocity or REST

    def _follow(self, state: State) -> None:
        if state.report is None:
            return
        rolled = state.report.rolled
        before, self._rolled = self._rolled or rolled, rolled
        linear, angular = rolled.linear - before.linear, rolled.angular - before.angular
        self._pose = along_arc(self._pose, linear, angular)


class BaseBumper(OfSensor, Bumper):
    """A switch of the base, or all of them without the parameter `sensor`."""

    kind = "bumps"

    def _is_any(self) -> bool:
        return not self.sensor

    def is_pressed(self, now: float) -> bool:
        report = self.bus.state.report
        if report is None or self.bus.age(now) > STALE:
            return True
        return report.bumps.get(self.sensor, True) if self.sensor else any(report.bumps.values())


class BaseCliffSensor(OfSensor, CliffSensor):
    """A cliff sensor of the base."""

    kind = "cliffs"

    def is_cliff(self, now: float) -> bool:
        report = self.bus.state.report
        return report is None or self.bus.age(now) > STALE or report.cliffs.get(self.sensor, True)


class BaseRangeSensor(OfSensor, RangeSensor):
    """A range sensor of the base; x, y (cm) and yaw say where it is, which governs the speed."""

    kind = "ranges"

    def read(self, now: float) -> RangeReading:
        report = self.bus.report()
        distance = report.ranges.get(self.sensor, 0.0)
        return RangeReading(self.id, distance, now - self.bus.age(now), 0)


class BaseBattery(OnBase, Battery):
    """The battery, as the base measures it; unknown while the base says nothing."""

    def level(self, now: float) -> float | None:
        report = self._heard(now)
        return None if report is None else within(report.battery, 0.0, 1.0)

    def voltage(self, now: float) -> float | None:
        report = self._heard(now)
        return None if report is None else within(report.voltage, 0.0, MOST_VOLTAGE)

    def _heard(self, now: float) -> BaseReport | None:
        return self.bus.state.report if self.bus.age(now) <= STALE else None
