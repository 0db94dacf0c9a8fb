"""Any board that speaks the text protocol of ROSArduinoBridge, such as an Arduino or a Pico.

A letter, arguments, a carriage return; an answer in one line. Facts are from its firmware
(hbrobotics/ros_arduino_bridge, 2012 to 2017) and from that of joshnewans (2022), which most
tutorials use; `config/firmware/` has a sketch of our own. Such a base speaks only when it is asked,
so `poll` asks for all sensors in one go, and the answers come back in that order.

Our firmware answers a line that carries a check (`hri.drive.bases.line_check`) with one that does.
The greeting has such a line, which all others take for one without; once an answer comes with its
check, all lines carry one, and what comes without it makes no sense.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Self

from hri.core.signals import Twist
from hri.drive.bases.line_check import checked, without_check
from hri.drive.bases.odometer import Encoders, Odometer
from hri.drive.bases.protocol import BaseProtocol, BaseReport, Greeting, Sensors, within
from hri.hal.resource import Description

ANSWER_TIME = 0.1
"""Seconds after which an answer that has not come is lost."""
QUIET = 0.05
"""Seconds without an answer after which no late one is to be expected."""
LONGEST_LINE = 64
"""Bytes; no answer is longer."""
BATTERY_EVERY = 100
"""Rounds of questions between two looks at the battery."""
ACKNOWLEDGED = b"OK"
"""Answers a velocity, so it may come at any time."""
NUMBERS = re.compile(rb"-?\d{1,10}(?: -?\d{1,10})?")
STOP = b"m 0 0"
BAUD_QUESTION = b"b"
BAUD_ANSWER = re.compile(rb"(?:^|[\r\n]) ?57600\r\n")

SHAPE = {
    "counts_per_turn": (1440.0, 1.0, 1e6),
    "wheel_diameter_cm": (6.5, 0.5, 100.0),
    "track_cm": (20.0, 1.0, 200.0),
    "max_speed": (0.4, 0.01, 3.0),
    "frame_rate": (30.0, 1.0, 1000.0),
    "cliff_counts": (200.0, 0.0, 1023.0),
}
"""Default, least and most: encoder counts for a turn of the wheel; diameter and distance of the
wheels, cm; m/s of the rim; control frames a second of the firmware (its PID_RATE); and what a
cliff sensor counts at least of a floor."""
BATTERY = {
    "battery_pin": (-1.0, -1.0, 99.0),
    "volts_per_count": (5 / 1023 * 3, 1e-6, 1.0),
    "empty_volts": (6.6, 0.1, 100.0),
    "full_volts": (8.4, 0.1, 100.0),
}
"""Default, least and most: the analog pin, -1 for none; its volts for a count, of 5 V by 10 bits
behind a divider by three; and the battery's ends, those of two lithium cells."""
VOLTAGES = (0.5, 1.2)
"""Of a battery that is there, as parts of its voltage when it is empty, and full."""
COUNTS = range(-(2**31), 2**31)
"""What an encoder's counter can hold."""
BUMPER_PRESSED = 0
"""What a bumper's pin reads when it is pressed: the switch goes to ground."""
BUTTON_PRESSED = 1
"""What a button's pin reads when it is pressed, or its wire is broken: the switch opens, and the
pin is pulled up. So an emergency stop that fails counts as pressed."""


@dataclass(frozen=True, slots=True)
class Wiring:
    """Which sensor is on which pin, by place."""

    bumps: dict[str, int] = field(default_factory=dict)
    """Digital pins of switches to ground."""
    cliffs: dict[str, int] = field(default_factory=dict)
    """Analog pins of infrared sensors that look down; they count the light from the floor."""
    sonars: dict[str, int] = field(default_factory=dict)
    """Digital pins of ultrasonic sensors."""
    buttons: dict[str, int] = field(default_factory=dict)
    """Digital pins of switches to ground that open when someone presses."""


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked, and how the answer is to be taken."""

    text: bytes
    kind: str
    """Name of a table of the report, or "counts"."""
    place: str = ""
    most: int = 1
    """The greatest number that can be an answer."""


class ArduinoBridge(BaseProtocol):
    """Its parameters are those of SHAPE and BATTERY, and the wiring.

    `bumps`, `cliffs`, `sonars` and `buttons` are lists such as "left:7 right:8", a place and a pin
    each.
    Sonars want our firmware: that of 2012 waits for an echo for up to a second.
    """

    title = "Arduino with ROSArduinoBridge"
    parameters = (*SHAPE, *BATTERY, "bumps", "cliffs", "sonars", "buttons")
    baud = 57_600
    period = 0.01
    timeout = 2.0  # of the firmware of 2012 to 2022; ours stops after 0.5 s
    boot = 2.0  # opening the port resets many boards, and their boot loader listens that long
    question: ClassVar[bytes] = b"\r" + BAUD_QUESTION + b"\r"

    def __init__(
        self,
        wiring: Wiring | None = None,
        shape: dict[str, float] | None = None,
        battery: dict[str, float] | None = None,
    ) -> None:
        """`shape` and `battery` are what differs from the defaults of SHAPE and BATTERY."""
        self.wiring = wiring or Wiring()
        self.shape = {name: value[0] for name, value in SHAPE.items()} | (shape or {})
        self.battery = {name: value[0] for name, value in BATTERY.items()} | (battery or {})
        self.track = self.shape["track_cm"] / 100
        fastest = self.shape["max_speed"]
        self.limits = Twist(fastest, 2 * fastest / self.track)
        self.sensors = Sensors(
            bumps=tuple(self.wiring.bumps),
            cliffs=tuple(self.wiring.cliffs),
            cliff_signals=tuple(self.wiring.cliffs),
            buttons=tuple(self.wiring.buttons),
            ranges=tuple(self.wiring.sonars),
        )
        turn = math.pi * self.shape["wheel_diameter_cm"] / 100
        self._meters_per_count = turn / self.shape["counts_per_turn"]
        self._odometer = Odometer(Encoders(self._meters_per_count, self.track, 32, fastest))
        self._line = bytearray()
        self._asked = -math.inf
        self._heard = -math.inf
        self._owed: list[Question] = []
        self._is_confused = False
        self._has_checks = False
        """Whether the base has shown that it knows checks."""
        self._rounds = 0
        self._counts = (0, 0)
        self._numbers: dict[str, dict[str, int]] = {}

    @classmethod
    def described(cls, description: Description) -> Self:
        shape = {name: description.number_within(name, *SHAPE[name]) for name in SHAPE}
        battery = {name: description.number_within(name, *BATTERY[name]) for name in BATTERY}
        if battery["empty_volts"] >= battery["full_volts"]:
            what = f"full_volts is {battery['full_volts']:g}"
            remedy = f"write more than empty_volts, {battery['empty_volts']:g}"
            raise description.error("full_volts", what, remedy)
        names = ("bumps", "cliffs", "sonars", "buttons")
        wiring = Wiring(*(_pins(description, name) for name in names))
        return cls(wiring, shape, battery)

    @classmethod
    def recognizes(cls, answer: bytes) -> bool:
        return BAUD_ANSWER.search(answer) is not None

    def greeting(self) -> Sequence[Greeting]:
        """Stops the wheels, waits for a boot loader, pulls up switches' pins, asks for checks."""
        pins = (*self.wiring.bumps.values(), *self.wiring.buttons.values())
        pulled_up = b"".join(b"c %d 0\rw %d 1\r" % (pin, pin) for pin in pins)
        # A board that knows no checks takes this one for a word, which it does not read.
        asked = checked(BAUD_QUESTION) + b"\r"
        return (
            Greeting(self.emergency_stop, self.boot),  # not every port resets its board
            Greeting(self.emergency_stop, QUIET),
            Greeting(pulled_up + asked, QUIET),
        )

    def velocity(self, twist: Twist) -> bytes:
        per_frame = self._meters_per_count * self.shape["frame_rate"]
        return self._line_of(b"m %d %d" % tuple(round(o / per_frame) for o in self._rims(twist)))

    @property
    def stop(self) -> bytes:
        return self._line_of(STOP)

    @property
    def emergency_stop(self) -> bytes:
        """The first return ends what another began to write; the rest any board obeys."""
        return b"\r" + (STOP + b"\r") * 2

    def _line_of(self, text: bytes) -> bytes:
        return (checked(text) if self._has_checks else text) + b"\r"

    def poll(self, now: float) -> bytes:
        if self._owed and now - self._asked > ANSWER_TIME:
            self._give_up(now)
        if self._is_confused and now - self._heard > QUIET:
            self._is_confused = False
            self._line.clear()
        if self._owed or self._is_confused or now - self._asked < self.period:
            return b""
        self._asked = now
        self._owed = self._questions()
        self._rounds += 1
        return b"".join(self._line_of(question.text) for question in self._owed)

    def _questions(self) -> list[Question]:
        """Encoders, switches and cliffs each time; sonars in turn, as each holds up the board."""
        asked = [Question(b"e", "counts")]
        wiring, battery_pin = self.wiring, int(self.battery["battery_pin"])
        for kind, pins in (("bumps", wiring.bumps), ("buttons", wiring.buttons)):
            asked += [Question(b"d %d" % pin, kind, place) for place, pin in pins.items()]
        asked += [
            Question(b"a %d" % pin, "cliffs", place, 1023) for place, pin in wiring.cliffs.items()
        ]
        if wiring.sonars:
            place, pin = list(wiring.sonars.items())[self._rounds % len(wiring.sonars)]
            asked.append(Question(b"p %d" % pin, "sonars", place, 10_000))
        if battery_pin >= 0 and self._rounds % BATTERY_EVERY == 0:
            asked.append(Question(b"a %d" % battery_pin, "battery", "", 1023))
        return asked

    def feed(self, data: bytes, now: float) -> list[BaseReport]:
        found = []
        for byte in data:
            if byte not in b"\r\n":
                if len(self._line) <= LONGEST_LINE:
                    self._line.append(byte)
                continue
            line = bytes(self._line)
            self._line.clear()
            if not line.strip() or (text := self._text_of(line)) == ACKNOWLEDGED:
                continue
            self._heard = now
            if not (self._owed and self._takes(text, now)):
                self.senseless += len(line)
            elif not self._owed:
                found.append(self._report(now))
        return found

    def _text_of(self, line: bytes) -> bytes:
        """What a line says; nothing where its check is wrong, or missing from one that has them."""
        text = without_check(line)
        if text is None:
            is_stop_heard = line == ACKNOWLEDGED  # a stop carries no check
            return line.strip() if is_stop_heard or not self._has_checks else b""
        self._has_checks = True
        return text.strip()

    def _takes(self, line: bytes, now: float) -> bool:
        """Whether a line is the next answer of a round; what makes no sense ends the round."""
        question = self._owed[0]
        numbers = [int(word) for word in line.split()] if NUMBERS.fullmatch(line) else []
        if question.kind == "counts" and len(numbers) == 2 and all(n in COUNTS for n in numbers):
            self._counts = numbers[0], numbers[1]
        elif question.kind != "counts" and len(numbers) == 1 and 0 <= numbers[0] <= question.most:
            self._numbers.setdefault(question.kind, {})[question.place] = numbers[0]
        else:
            self._give_up(now)
            return False
        del self._owed[0]
        if not self._owed:
            self._odometer.add(*self._counts, now)
        return True

    def _give_up(self, now: float) -> None:
        """Ask again when the base has fallen silent, so that no answer is taken for another's."""
        self._owed = []
        self._is_confused, self._heard = True, now

    def _report(self, now: float) -> BaseReport:
        numbers = self._numbers
        cliffs, sonars = numbers.get("cliffs", {}), numbers.get("sonars", {})
        least = self.shape["cliff_counts"]
        told = self._voltage()
        empty, full = self.battery["empty_volts"], self.battery["full_volts"]
        voltage = within(told, VOLTAGES[0] * empty, VOLTAGES[1] * full)
        return BaseReport(
            time=now,
            rolled=self._odometer.rolled,
            velocity=self._odometer.velocity,
            bumps={place: n == BUMPER_PRESSED for place, n in numbers.get("bumps", {}).items()},
            buttons={name: n == BUTTON_PRESSED for name, n in numbers.get("buttons", {}).items()},
            cliffs={place: count < least for place, count in cliffs.items()},
            cliff_signals=dict(cliffs),
            # A sonar that hears no echo answers 0.
            ranges={place: cm / 100 if cm else math.inf for place, cm in sonars.items()},
            battery=None if voltage is None else self._charge(voltage),
            voltage=voltage,
            battery_fault=f"says {told:.3g} V" if told is not None and voltage is None else "",
            mode="ready",
        )

    def _voltage(self) -> float | None:
        counts = self._numbers.get("battery", {}).get("")
        return None if counts is None else counts * self.battery["volts_per_count"]

    def _charge(self, voltage: float) -> float:
        """A battery rests below the full voltage and works above the empty one; voltages beyond
        them count as full or empty."""
        empty, full = self.battery["empty_volts"], self.battery["full_volts"]
        return min(1.0, max(0.0, (voltage - empty) / (full - empty)))


def _pins(description: Description, name: str) -> dict[str, int]:
    """The pins that a parameter such as "left:7 right:8" names. Raises AuthoringError."""
    pins = {}
    for word in description.text(name).split():
        place, colon, pin = word.partition(":")
        if not (
            place.isidentifier() and colon and pin.isascii() and pin.isdigit() and int(pin) < 100
        ):
            remedy = 'write a place and a pin for each, such as "left:7 right:8"'
            raise description.error(name, f'{name}: "{word}"', remedy)
        pins[place] = int(pin)
    return pins
