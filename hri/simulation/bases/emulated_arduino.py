"""An emulated board with the firmware of ROSArduinoBridge, or with that of `config/firmware`."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from hri.drive.bases.arduino import BATTERY, BUMPER_PRESSED, BUTTON_PRESSED, SHAPE, STOP, Wiring
from hri.drive.bases.line_check import checked, has_check, without_check
from hri.simulation.base import HardwareLimits
from hri.simulation.bases.body import Body
from hri.simulation.bases.emulator import Emulator, Wire

LONGEST = 48
"""Most characters of a command."""
CHECKED_S = 2.0
"""Seconds for which, after one of WEIGHTY and then any line with a check, the next of WEIGHTY needs
one, unless it is STOP."""
WEIGHTY = b"mrux"
FLOOR, NO_FLOOR = 700, 30
"""Counts of a cliff sensor."""
MOST_COUNTS = 1023
"""Of an analog pin."""
SONAR_REACH = 4.0
"""Meters; beyond it no echo comes back, and the answer is 0."""
BOOT = 1.5
"""Seconds that it is deaf after a reset."""


def limits(shape: Mapping[str, float]) -> HardwareLimits:
    """What a base of this shape can do; its radius and its acceleration are guesses."""
    track, fastest = shape["track_cm"] / 100, shape["max_speed"]
    return HardwareLimits(
        linear=fastest,
        angular=2 * fastest / track,
        acceleration=1.5,
        angular_acceleration=3.0 / track,
        wheel=fastest,
        track=track,
        radius=0.6 * track,
    )


class EmulatedArduino(Emulator):
    """Counts, switches and sonars on the pins that the wiring names; all other pins read 0."""

    baud = 57_600

    def __init__(
        self,
        wiring: Wiring | None = None,
        body: Body | None = None,
        battery_pin: int = -1,
        auto_stop: float = 2.0,
        shape: Mapping[str, float] | None = None,
        knows_checks: bool = False,
        battery: Mapping[str, float] | None = None,
    ) -> None:
        """`auto_stop`: seconds without a velocity after which the wheels stop; `battery`, `shape`:
        what differs from the defaults of BATTERY, SHAPE; `knows_checks`: as our firmware does."""
        self._wiring = wiring or Wiring()
        shape = {name: value[0] for name, value in SHAPE.items()} | dict(shape or {})
        self.body = body or Body(limits(shape))
        self._battery = {name: value[0] for name, value in BATTERY.items()} | dict(battery or {})
        self._battery_pin, self._auto_stop = battery_pin, auto_stop
        self.overrides: dict[int, int] = {}
        """Readings of analog pins, regardless of their wiring."""
        self._meters_per_count = (
            math.pi * shape["wheel_diameter_cm"] / 100 / shape["counts_per_turn"]
        )
        self._rim_speed = self._meters_per_count * shape["frame_rate"]
        self._wire = Wire(self.baud)
        self._command = bytearray()
        self._knows_checks = knows_checks
        self._checked_until = -math.inf
        """Until when it does nothing of weight without a check."""
        self._commanded = 0.0
        self._now = 0.0
        self._deaf_until = -math.inf
        self._origin = (0.0, 0.0)
        self.is_rolling = False
        """Whether its motors are commanded to roll."""

    def feed(self, data: bytes, now: float) -> bytes:
        if self.is_rolling and now - self._commanded > self._auto_stop:
            self._roll(0, 0, max(self._now, self._commanded + self._auto_stop))
        self._now = now
        self.body.advance(now)
        if now < self._deaf_until:
            self._reset_counts(0, 0, now)
            data = b""
        for byte in data:
            if byte == 13:
                self._run(bytes(self._command), now)
                self._command.clear()
            elif len(self._command) < LONGEST:
                self._command.append(byte)
        return self._wire.arrived(now)

    def reset(self, now: float, boot: float = BOOT) -> None:
        """Restart, as when someone presses its button, or its power fails: deaf for a while."""
        self._roll(0, 0, now)
        self._reset_counts(0, 0, now)
        self._command.clear()
        self._checked_until, self._deaf_until = -math.inf, now + boot

    def _run(self, command: bytes, now: float) -> None:
        if not self._knows_checks or not has_check(command):
            is_refused = now < self._checked_until and _is_weighty(command) and command != STOP
            self._wire.send(self._answer(b"" if is_refused else command, now) + b"\r\n", now)
            return
        text = without_check(command)
        if text is not None and (_is_weighty(text) or now < self._checked_until):
            self._checked_until = now + CHECKED_S
        self._wire.send(checked(self._answer(text or b"", now)) + b"\r\n", now)

    def _answer(self, command: bytes, now: float) -> bytes:
        words = command.split(b" ")
        numbers = [_atoi(word) for word in words[1:3]] + [0, 0]
        actions: dict[bytes, Callable[[int, int, float], str]] = {
            b"a": self._analog,
            b"b": lambda _first, _second, _now: f" {self.baud}",
            b"c": _agree,
            b"d": self._digital,
            b"e": self._counts,
            b"m": self._roll,
            b"p": self._ping,
            b"r": self._reset_counts,
            b"u": _agree,
            b"w": _agree,
            b"x": _agree,
        }
        action = actions.get(words[0][:1])
        return action(numbers[0], numbers[1], now).encode() if action else b"Invalid Command"

    def _roll(self, left: int, right: int, now: float) -> str:
        self._commanded = now
        self.is_rolling = (left, right) != (0, 0)
        fastest = self.body.base.limits.wheel
        rims = [max(-fastest, min(fastest, n * self._rim_speed)) for n in (left, right)]
        self.body.roll(rims[0], rims[1], now)
        return "OK"

    def _counts(self, _first: int, _second: int, _now: float) -> str:
        return " ".join(
            str(int((rolled - origin) / self._meters_per_count))
            for rolled, origin in zip(self.body.rolled, self._origin, strict=True)
        )

    def _reset_counts(self, _first: int, _second: int, _now: float) -> str:
        self._origin = self.body.rolled
        return "OK"

    def _digital(self, pin: int, _: int, now: float) -> str:
        pressed = self.body.bumps(now)
        for place, its_pin in self._wiring.bumps.items():
            if its_pin == pin:
                return str(BUMPER_PRESSED if place in pressed else 1 - BUMPER_PRESSED)
        for name, its_pin in self._wiring.buttons.items():
            if its_pin == pin:
                return str(BUTTON_PRESSED if name in self.body.held else 1 - BUTTON_PRESSED)
        return "0"

    def _analog(self, pin: int, _: int, now: float) -> str:
        if pin in self.overrides:
            return str(self.overrides[pin])
        for place, its_pin in self._wiring.cliffs.items():
            if its_pin == pin:
                return str(NO_FLOOR if self.body.is_over_edge(place) else FLOOR)
        if pin != self._battery_pin:
            return "0"
        empty, full = self._battery["empty_volts"], self._battery["full_volts"]
        volts = empty + (full - empty) * self.body.battery(now)
        return str(min(MOST_COUNTS, round(volts / self._battery["volts_per_count"])))

    def _ping(self, pin: int, _: int, now: float) -> str:
        for place, its_pin in self._wiring.sonars.items():
            if its_pin == pin:
                distance = self.body.distance(place, now)
                return str(round(distance * 100)) if distance < SONAR_REACH else "0"
        return "0"


def _agree(_first: int, _second: int, _now: float) -> str:
    return "OK"


def _is_weighty(command: bytes) -> bool:
    return bool(command) and command[0] in WEIGHTY


def _atoi(word: bytes) -> int:
    """A number as C reads it: as far as there are digits, in 16 bits."""
    sign, digits = (-1, word[1:]) if word[:1] == b"-" else (1, word)
    count = next((i for i, byte in enumerate(digits) if not 48 <= byte <= 57), len(digits))
    value = sign * int(digits[: min(count, 9)] or b"0")
    return (value + 0x8000) % 0x10000 - 0x8000
