"""What in a report must not be driven into, or at all."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum

from hri.drive.bases.protocol import BaseReport
from hri.drive.supervisor.cause import Cause, spelled
from hri.drive.supervisor.cliffs import Light, edges


class Kind(StrEnum):
    """What a sensor is about; also the name of the cause when it stops the base."""

    CLIFF = "cliff"
    BUMP = "bump"
    WHEEL_DROP = "wheel drop"
    BUTTON = "button"
    RANGE = "range"
    WHEELS = "wheels"
    BATTERY = "battery"


TITLES: Mapping[Kind, str] = {
    Kind.CLIFF: "cliff sensor",
    Kind.BUMP: "bumper",
    Kind.WHEEL_DROP: "wheel drop switch",
    Kind.BUTTON: "button",
    Kind.RANGE: "range sensor",
    Kind.WHEELS: "wheels",
    Kind.BATTERY: "battery",
}
"""What people call the sensors."""
SENSED: Mapping[Kind, str] = {
    Kind.CLIFF: "sees an edge",
    Kind.BUMP: "touches something",
}
BEHIND = ("back", "rear")
"""Words in the place of a sensor that looks where the base backs off to."""
DOUBTED = (*SENSED, Kind.WHEEL_DROP, Kind.BUTTON)
"""Sensors that count as hazards when they cannot be believed; for ranges, `governor` does it."""


@dataclass(frozen=True, slots=True)
class Sensor:
    """One sensor of a base, by what it is and where."""

    kind: Kind
    place: str = ""

    def __str__(self) -> str:
        return f"{spelled(self.place)} {TITLES[self.kind]}".strip()


@dataclass(frozen=True, slots=True)
class Fault:
    """A sensor that cannot be believed."""

    sensor: Sensor
    complaint: str
    """The rest of a sentence: "is stuck at 0.42"."""

    @property
    def words(self) -> str:
        """ "my left cliff sensor is stuck at 1200"."""
        return f"my {self.sensor} {self.complaint}"


@dataclass(frozen=True, slots=True)
class Hazard:
    """Something that forbids to drive on to its side of the base."""

    sensor: Sensor
    cause: Cause
    is_sensed: bool = True
    """False where a sensor that cannot be believed is taken for one that sees something."""

    @property
    def side(self) -> int:
        """1 when it is to the left, -1 to the right, 0 when that is not known."""
        place = self.sensor.place
        return ("left" in place) - ("right" in place)

    @property
    def is_behind(self) -> bool:
        """Whether it forbids to back off; every other one forbids to drive ahead."""
        return any(word in self.sensor.place for word in BEHIND)


def hazards_of(
    report: BaseReport, lights: Mapping[str, Light], faults: Iterable[Fault]
) -> list[Hazard]:
    """Edges and touches, and sensors of them that cannot be believed."""
    seen = [Sensor(Kind.CLIFF, place) for place in edges(report.cliffs, lights)]
    seen += [Sensor(Kind.BUMP, place) for place, pressed in report.bumps.items() if pressed]
    doubted = {f.sensor: f for f in faults if f.sensor.kind in DOUBTED}
    sensed = [_sensed(sensor) for sensor in seen if sensor not in doubted]
    return sensed + [_assumed(fault) for fault in doubted.values()]


def dropped_wheel(report: BaseReport) -> Cause | None:
    """Why it must stand when a wheel hangs in the air."""
    place = next((place for place, drops in report.wheel_drops.items() if drops), None)
    if place is None:
        return None
    because = f"my {spelled(place)} wheel hangs in the air - put me on the floor and release me"
    return Cause(Kind.WHEEL_DROP.value, because)


def pressed_buttons(report: BaseReport) -> list[Sensor]:
    """The buttons that someone presses."""
    return [Sensor(Kind.BUTTON, name) for name, is_pressed in report.buttons.items() if is_pressed]


def pressing(button: Sensor) -> Cause:
    """Why it must stand when someone presses a button."""
    return Cause(Kind.BUTTON.value, f"someone pressed my {button}")


def _sensed(sensor: Sensor) -> Hazard:
    because = f"my {sensor} {SENSED[sensor.kind]}"
    return Hazard(sensor, Cause(sensor.kind.value, because))


def _assumed(fault: Fault) -> Hazard:
    return Hazard(fault.sensor, Cause("fault", fault.words), is_sensed=False)
