"""Sensors that cannot be right: silent, out of range, stuck, jumping, or contradicting others.

A fault stays for HOLD seconds after it was seen last, so that a loose contact does not flicker.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Mapping

from hri.core.signals import Twist
from hri.drive.bases.protocol import BaseReport, Sensors, within
from hri.drive.supervisor.cliffs import Light
from hri.drive.supervisor.hazards import Fault, Kind, Sensor
from hri.hal.motion import Way

HOLD = 2.0
"""Seconds."""
STARTING = 0.5
"""Seconds in which a base may not have asked all its sensors yet."""
MOST_SIGNAL = 4095
"""Counts of the light from the floor: 12 bits in the Open Interface of the Create 2."""
MOST_RANGE = 30.0
"""Meters; no range sensor that such a base carries sees farther."""
MOST_VOLTAGE = 60.0
FULL_SCALES = (255, 1023, MOST_SIGNAL)
"""Counts of a converter of 8, 10 or 12 bits that a bright floor drives to its end."""
STUCK: Mapping[Kind, Way] = {Kind.RANGE: Way(1.0, 1.0), Kind.CLIFF: Way(1.0, 0.0)}
"""Meters and radians that the wheels carry the base while a reading stays the same to the last
digit. Along a wall the distance may well stay, but not while the base turns."""
PRESSED_WAY = 0.15
"""Meters backed off from what touched; a bumper that is still pressed then is stuck."""
JUMPS: Mapping[Kind, float] = {Kind.RANGE: 0.3, Kind.CLIFF: 800.0}
"""Meters, counts; a greater change from one report to the next is a jump."""
MOST_JUMPS = 6
"""Jumps to and fro within a second that no room explains."""
CONTRADICTION = 0.3
"""Seconds that two signals of one sensor may differ, as they do at an edge."""
ASLEEP = 1.0
"""Seconds that wheels may stand although they are asked to turn."""
ASKED = 0.08
"""Meters a second at a wheel that must show."""
STANDS = 0.01
"""Meters a second at a wheel that count as none, as does what it turns the other way."""


class Plausibility:
    """Looks at each report in the light of those before."""

    def __init__(self, sensors: Sensors, half_track: float) -> None:
        """`sensors`: what the base promises to report; half the way between its wheels, meters."""
        self._sensors, self._half_track = sensors, half_track
        self._analog: dict[Sensor, _Analog] = {}
        self._since: dict[Sensor, float] = {}
        """When a contradiction began."""
        self._pressed: dict[str, float] = {}
        """Meters rolled, lowest since the bumper closed, and where it closed."""
        self._seen: dict[Sensor, tuple[Fault, float]] = {}
        self._began = math.inf
        """When the first report came."""
        self._way = Way()
        """Rolled to and fro, all added up."""
        self._rolled: Way | None = None

    def step(
        self, now: float, report: BaseReport, lights: Mapping[str, Light], asked: Twist
    ) -> list[Fault]:
        """The faults there are after this report; `asked` is the velocity the wheels were told."""
        self._began = min(self._began, now)
        self._roll(report.rolled)
        for fault in self._found(now, report, lights, asked):
            self._seen[fault.sensor] = fault, now
        self._seen = {s: (f, t) for s, (f, t) in self._seen.items() if now - t <= HOLD}
        return [fault for fault, _ in self._seen.values()]

    def _found(
        self, now: float, report: BaseReport, lights: Mapping[str, Light], asked: Twist
    ) -> Iterator[Fault]:
        yield from self._silent(now, report)
        yield from self._analog_faults(now, report)
        yield from self._stuck_bumpers(report)
        yield from self._contradictions(now, report, lights)
        yield from self._wheels(now, report, asked)
        yield from _battery(report)

    def _roll(self, rolled: Way) -> None:
        if not _is_finite(rolled):
            return
        before = self._rolled or rolled
        self._way = Way(
            self._way.linear + abs(rolled.linear - before.linear),
            self._way.angular + abs(rolled.angular - before.angular),
        )
        self._rolled = rolled

    def _silent(self, now: float, report: BaseReport) -> Iterator[Fault]:
        is_starting = now - self._began <= STARTING
        for kind, promised, told in (
            (Kind.CLIFF, self._sensors.cliffs, report.cliffs),
            (Kind.BUMP, self._sensors.bumps, report.bumps),
            (Kind.RANGE, self._sensors.ranges, report.ranges),
            (Kind.WHEEL_DROP, self._sensors.wheel_drops, report.wheel_drops),
            (Kind.BUTTON, self._sensors.buttons, report.buttons),
        ):
            for place in promised:
                if place not in told and not is_starting:
                    yield Fault(Sensor(kind, place), "says nothing")

    def _analog_faults(self, now: float, report: BaseReport) -> Iterator[Fault]:
        readings: dict[Sensor, tuple[float, float]] = {
            Sensor(Kind.RANGE, place): (value, MOST_RANGE) for place, value in report.ranges.items()
        }
        for place, signal in report.cliff_signals.items():
            readings[Sensor(Kind.CLIFF, place)] = float(signal), MOST_SIGNAL
        for sensor, (value, most) in readings.items():
            analog = self._analog.setdefault(
                sensor, _Analog(JUMPS[sensor.kind], STUCK[sensor.kind])
            )
            complaint = analog.step(value, most, now, self._way)
            if complaint is not None:
                yield Fault(sensor, complaint)

    def _stuck_bumpers(self, report: BaseReport) -> Iterator[Fault]:
        for place, is_pressed in report.bumps.items():
            if not is_pressed:
                self._pressed.pop(place, None)
                continue
            farthest = max(self._pressed.get(place, -math.inf), report.rolled.linear)
            self._pressed[place] = farthest
            if farthest - report.rolled.linear > PRESSED_WAY:
                yield Fault(Sensor(Kind.BUMP, place), "is still pressed after I backed off")

    def _contradictions(
        self, now: float, report: BaseReport, lights: Mapping[str, Light]
    ) -> Iterator[Fault]:
        for place, is_edge in report.cliffs.items():
            sensor = Sensor(Kind.CLIFF, place)
            light = lights.get(place, Light.UNKNOWN)
            differs = light is (Light.LIT if is_edge else Light.DARK)
            if self._lasts(sensor, differs, CONTRADICTION, now):
                yield Fault(sensor, f"contradicts itself: flag {is_edge}, floor {light.value}")

    def _wheels(self, now: float, report: BaseReport, asked: Twist) -> Iterator[Fault]:
        sensor, measured = Sensor(Kind.WHEELS), report.velocity
        if not (_is_finite(report.rolled) and (measured is None or _is_finite(measured))):
            yield Fault(sensor, "say what is not a number")
            return
        if measured is None:
            return
        rims = zip(self._rims(asked), self._rims(measured), strict=True)
        stands = any(
            abs(told) >= ASKED and turns * math.copysign(1.0, told) <= STANDS
            for told, turns in rims
        )
        if self._lasts(sensor, stands, ASLEEP, now):
            yield Fault(sensor, "do not turn although they are told to - see what holds me up")

    def _rims(self, twist: Twist) -> tuple[float, float]:
        """How fast the wheels roll, left and right, m/s."""
        aside = self._half_track * twist.angular
        return twist.linear - aside, twist.linear + aside

    def _lasts(self, sensor: Sensor, holds: bool, patience: float, now: float) -> bool:
        if not holds:
            self._since.pop(sensor, None)
            return False
        return now - self._since.setdefault(sensor, now) > patience


class _Analog:
    """One reading that should neither freeze nor leap."""

    def __init__(self, jump: float, patience: Way) -> None:
        self._jump, self._patience = jump, patience
        self._value = math.nan
        self._changed_at = Way()
        """What was rolled at the last change."""
        self._leap = 0.0
        self._leaps: deque[float] = deque(maxlen=MOST_JUMPS)

    def step(self, value: float, most: float, now: float, way: Way) -> str | None:
        """What is wrong with it, if anything."""
        before, self._value = self._value, value
        if math.isnan(value) or value < 0 or (math.isfinite(value) and value > most):
            return f"says {value:g}, which cannot be"
        if value != before:
            self._changed_at = way
        if self._is_stuck(value, way):
            return f"is stuck at {value:g}"
        return "jumps to and fro" if self._is_jumping(value - before, now) else None

    def _is_stuck(self, value: float, way: Way) -> bool:
        # What sees nothing, no light or too much of it may well go on with that.
        if not 0 < value < math.inf or value in FULL_SCALES:
            return False
        return (
            way.linear - self._changed_at.linear > self._patience.linear
            and way.angular - self._changed_at.angular >= self._patience.angular
        )

    def _is_jumping(self, change: float, now: float) -> bool:
        # Out of reach and back is not a jump: that happens at the limit of any sensor.
        if math.isfinite(change) and abs(change) > self._jump:
            if change * self._leap < 0:
                self._leaps.append(now)
            self._leap = change
        return len(self._leaps) == MOST_JUMPS and now - self._leaps[0] <= 1.0


def _battery(report: BaseReport) -> Iterator[Fault]:
    level, voltage = report.battery, report.voltage
    said = report.battery_fault
    if level is not None and within(level, 0.0, 1.0) is None:
        said = f"says {level:.0%}"
    if voltage is not None and within(voltage, 0.0, MOST_VOLTAGE) is None:
        said = f"says {voltage:g} V"
    if said:
        yield Fault(Sensor(Kind.BATTERY), f"{said}, which cannot be")


def _is_finite(motion: Twist | Way) -> bool:
    return math.isfinite(motion.linear) and math.isfinite(motion.angular)
