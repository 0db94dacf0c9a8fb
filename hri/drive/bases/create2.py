"""The iRobot Create 2, and Roombas of the 500 and 600 series: their Open Interface.

Numbers are from "iRobot Create 2 Open Interface (OI) Specification based on the iRobot Roomba
600" (2016 and 2018). The base sends what it senses by itself, every 15 ms. It is kept in its safe
mode, in which its own firmware stops it at a cliff, when a wheel drops, and on a charger; the mode
it reports is then "passive". It has no command timeout: it drives on until it is told to stop.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping, Sequence
from typing import ClassVar, Self

from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.drive.bases.odometer import Encoders, Odometer
from hri.drive.bases.protocol import BaseProtocol, BaseReport, Greeting, Note, Sensors, within
from hri.hal.resource import Description

# Opcodes.
START, SAFE, LEDS, SONG, PLAY, DOCK, DRIVE_DIRECT, STREAM, PAUSE_STREAM = (
    128, 131, 139, 140, 141, 143, 145, 148, 150,
)  # fmt: skip

SLOT = 0.015
"""Seconds between two updates of the sensors; nobody should ask or tell more often."""
HEADER = 19
"""The first byte of each packet of the stream."""
MODES = ("off", "passive", "safe", "full")
FORMATS = {
    7: "B", 8: "B", 9: "B", 10: "B", 11: "B", 12: "B", 13: "B", 14: "B", 15: "B", 16: "B",
    17: "B", 18: "B", 19: "h", 20: "h", 21: "B", 22: "H", 23: "h", 24: "b", 25: "H", 26: "H",
    27: "H", 28: "H", 29: "H", 30: "H", 31: "H", 32: "B", 33: "H", 34: "B", 35: "B", 36: "B",
    37: "B", 38: "B", 39: "h", 40: "h", 41: "h", 42: "h", 43: "H", 44: "H", 45: "B", 46: "H",
    47: "H", 48: "H", 49: "H", 50: "H", 51: "H", 52: "B", 53: "B", 54: "h", 55: "h", 56: "h",
    57: "h", 58: "B",
}  # fmt: skip
"""Each sensor packet by its number, in the words of `struct`, big-endian."""

BUMPS_AND_DROPS, PRESSED, CHARGING, VOLTAGE, CHARGE, CAPACITY, MODE, LEFT_COUNT, RIGHT_COUNT = (
    7, 18, 21, 22, 25, 26, 35, 43, 44,
)  # fmt: skip
BUMPS = {"left": 0x02, "right": 0x01}
WHEEL_DROPS = {"left": 0x08, "right": 0x04}
BUTTONS = {
    "clean": 0x01, "spot": 0x02, "dock": 0x04, "minute": 0x08, "hour": 0x10, "day": 0x20,
    "schedule": 0x40, "clock": 0x80,
}  # fmt: skip
"""A Create 2 has the first three; those that a model lacks are never pressed."""
CLIFFS = {"left": 9, "front_left": 10, "front_right": 11, "right": 12}
CLIFF_SIGNALS = {"left": 28, "front_left": 29, "front_right": 30, "right": 31}
LIGHT_BUMPS = {
    "left": 46,
    "front_left": 47,
    "center_left": 48,
    "center_right": 49,
    "front_right": 50,
    "right": 51,
}
STREAMED = (
    BUMPS_AND_DROPS, *CLIFFS.values(), PRESSED, CHARGING, VOLTAGE, CHARGE, CAPACITY,
    *CLIFF_SIGNALS.values(), MODE, LEFT_COUNT, RIGHT_COUNT, *LIGHT_BUMPS.values(),
)  # fmt: skip
"""What the base is asked for: 64 bytes of the 172 that a slot has room for."""
CHARGES = (1, 2, 3)
"""Charging states in which current flows: reconditioning, full, trickle."""

WAKE = 1.0
"""Seconds that the wire RTS is let go to wake it: the cable of the Create 2 ties it to the pin BRC,
and it wakes when that goes low. Three pulses of 0.05 to 0.5 s would change its baud rate; a second
is what the specification proposes against that."""
WOKEN = 1.0
"""Seconds until it hears."""
TRACK = 0.235
FASTEST = 0.5
"""Of a wheel's rim, m/s."""
METERS_PER_COUNT = math.pi * 0.072 / 508.8
MOST_CAPACITY = 0x7FFF
"""mAh; the base says more of an empty battery, whose charge it takes for less than 0."""
VOLTAGES = (5.0, 25.0)
"""Of a battery of 14.4 V, with which it can still run, and by which it is not destroyed."""
MOST_LIGHT = 4095
"""Counts of a light bumper: 12 bits."""
LIGHT_AT_10_CM = (200.0, 1.0, 4095.0)
"""Default, least and most of what a light bumper counts 10 cm from white paper. The default is a
guess, not a measurement: hold a sheet there and read it."""
LIGHT_REACH = 0.3
"""Meters beyond which too little light comes back to mean anything."""
SONG_LENGTH = 16
LONGEST_COMMAND = 3 + 2 * SONG_LENGTH
"""Bytes: a song."""
NOTE_UNIT = 1 / 64
"""Seconds; a duration is a byte of them."""
LONGEST_NOTE = 255 * NOTE_UNIT
PITCHES = range(31, 128)


class Create2(BaseProtocol):
    """Safe mode, drive direct, sensor stream.

    `ranges` come from the light bumpers, by the inverse-square law from what they count 10 cm
    from white paper (parameter `light_at_10_cm`): the dark leg of a table seems farther away than
    it is. That is fit to slow down by, and no measure.
    """

    title = "iRobot Create 2 or Roomba"
    parameters = ("light_at_10_cm",)
    baud = 115_200
    period = SLOT
    timeout = None
    track = TRACK
    limits = Twist(FASTEST, 2 * FASTEST / TRACK)
    sensors = Sensors(
        bumps=tuple(BUMPS),
        cliffs=tuple(CLIFFS),
        cliff_signals=tuple(CLIFF_SIGNALS),
        wheel_drops=tuple(WHEEL_DROPS),
        buttons=tuple(BUTTONS),
        ranges=tuple(LIGHT_BUMPS),
    )
    question: ClassVar[bytes] = bytes([START, STREAM, 1, MODE])
    resync: ClassVar[bytes] = bytes(4)  # what a velocity may lack; none is an opcode
    farewell: ClassVar[bytes] = bytes([PAUSE_STREAM, 0, START])

    def __init__(self, light_at_10_cm: float = LIGHT_AT_10_CM[0]) -> None:
        self._light_at_10_cm = light_at_10_cm
        self._stream = PacketParser(STREAMED)
        self._odometer = Odometer(Encoders(METERS_PER_COUNT, TRACK, 16, FASTEST))

    @classmethod
    def described(cls, description: Description) -> Self:
        return cls(description.number_within("light_at_10_cm", *LIGHT_AT_10_CM))

    @classmethod
    def recognizes(cls, answer: bytes) -> bool:
        return bool(PacketParser((MODE,)).feed(answer))

    def greeting(self) -> Sequence[Greeting]:
        request = bytes([STREAM, len(STREAMED), *STREAMED])
        return (
            Greeting(self.emergency_stop, SLOT),
            Greeting(bytes([START]), 0.05),
            Greeting(bytes([SAFE]), 0.05),
            Greeting(self.stop, SLOT),
            Greeting(request, SLOT),
        )

    def waking(self) -> Sequence[Greeting]:
        return Greeting(self.emergency_stop, WAKE, rts=False), Greeting(b"", WOKEN, rts=True)

    def velocity(self, twist: Twist) -> bytes:
        left, right = self._rims(twist)
        return drive_direct(round(right * 1000), round(left * 1000))

    @property
    def stop(self) -> bytes:
        return drive_direct(0, 0)

    @property
    def emergency_stop(self) -> bytes:
        """Zeros first: they end any command that broke off, and alone they mean nothing.

        Then safe mode, in which it obeys: on its way to the dock it would not.
        """
        return bytes(LONGEST_COMMAND) + bytes([SAFE]) + self.stop * 2

    def feed(self, data: bytes, now: float) -> list[BaseReport]:
        packets = self._stream.feed(data)
        self.senseless = self._stream.senseless
        return [self._report(values, now) for values in packets]

    def _report(self, values: Mapping[int, int], now: float) -> BaseReport:
        self._odometer.add(values[LEFT_COUNT], values[RIGHT_COUNT], now)
        flags, lights = values[BUMPS_AND_DROPS], {p: values[n] for p, n in LIGHT_BUMPS.items()}
        charge, capacity, millivolts = values[CHARGE], values[CAPACITY], values[VOLTAGE]
        level = charge / capacity if 0 < capacity <= MOST_CAPACITY else None
        level, voltage = within(level, 0.0, 1.0), within(millivolts / 1000, *VOLTAGES)
        faults = [f"says {charge} of {capacity} mAh"] if level is None else []
        faults += [f"says {millivolts / 1000:g} V"] if voltage is None else []
        return BaseReport(
            time=now,
            rolled=self._odometer.rolled,
            velocity=self._odometer.velocity,
            bumps={place: bool(flags & bit) for place, bit in BUMPS.items()},
            cliffs={place: bool(values[packet] & 1) for place, packet in CLIFFS.items()},
            cliff_signals={place: values[packet] for place, packet in CLIFF_SIGNALS.items()},
            wheel_drops={place: bool(flags & bit) for place, bit in WHEEL_DROPS.items()},
            buttons={name: bool(values[PRESSED] & bit) for name, bit in BUTTONS.items()},
            # A sensor that is left out counts as one that says nothing.
            ranges={p: self._range(n) for p, n in lights.items() if 0 <= n <= MOST_LIGHT},
            battery=level,
            voltage=voltage,
            battery_fault=" and ".join(faults),
            is_charging=values[CHARGING] in CHARGES,
            mode=MODES[values[MODE]] if values[MODE] < len(MODES) else "off",
        )

    def _range(self, light: int) -> float:
        distance = 0.1 * math.sqrt(self._light_at_10_cm / max(1, light))
        return distance if distance <= LIGHT_REACH else math.inf

    def song(self, notes: Sequence[Note]) -> bytes:
        if not 1 <= len(notes) <= SONG_LENGTH:
            what = f"a song of {len(notes)} notes"
            raise HriError(f"{self.title}: {what} - write 1 to {SONG_LENGTH}")
        played = bytes(byte for note in notes for byte in (self._pitch(note), self._units(note)))
        return bytes([SONG, 0, len(notes)]) + played + bytes([PLAY, 0])

    def _pitch(self, note: Note) -> int:
        if note.pitch not in PITCHES:
            what = f"it cannot sing a pitch of {note.pitch}"
            raise HriError(f"{self.title}: {what} - write {PITCHES.start} to {PITCHES[-1]}")
        return note.pitch

    def _units(self, note: Note) -> int:
        if not 0 <= note.duration <= LONGEST_NOTE:
            what = f"it cannot sing for {note.duration} s"
            raise HriError(f"{self.title}: {what} - write 0 to {LONGEST_NOTE:.2f}")
        return round(note.duration / NOTE_UNIT)

    def leds(self, power: float, is_dock_lit: bool = False) -> bytes:
        color = round(255 * min(1.0, max(0.0, power)))
        return bytes([LEDS, 0x04 if is_dock_lit else 0, color, 255])

    def dock(self) -> bytes:
        return bytes([DOCK])


def drive_direct(right: int, left: int) -> bytes:
    """Velocities of both wheels, mm/s, -500 to 500."""
    return struct.pack(">Bhh", DRIVE_DIRECT, right, left)


class PacketParser:
    """Finds the packets of a sensor stream: [19] [n] [number, data]... [checksum].

    The sum of all bytes ends in a zero byte. As we know what we asked for, n and the numbers must
    fit as well: garbage cannot pass for a packet, nor delay us by more than one.
    """

    def __init__(self, packets: Sequence[int]) -> None:
        self._packets = tuple(packets)
        self._format = struct.Struct(">BB" + "".join("B" + FORMATS[p] for p in packets) + "B")
        self._head = bytes([HEADER, self._format.size - 3])
        self._buffer = bytearray()
        self.senseless = 0
        """Bytes so far that belong to no packet."""

    def feed(self, data: bytes) -> list[dict[int, int]]:
        """The values by packet number, for each packet that these bytes complete."""
        found = []
        buffer, size = self._buffer, self._format.size
        buffer += data
        start = 0
        while (start := buffer.find(self._head, start)) >= 0 and len(buffer) - start >= size:
            values = self._values(buffer[start : start + size])
            start += 1 if values is None else size
            if values is not None:
                found.append(values)
        # What is left may be the beginning of a packet: from its head, or the head's first byte.
        keep = start if start >= 0 else len(buffer) - buffer.endswith(self._head[:1])
        del buffer[:keep]
        self.senseless += keep - size * len(found)
        return found

    def _values(self, packet: bytearray) -> dict[int, int] | None:
        """The contents of a packet; None for an invalid one."""
        if sum(packet) & 0xFF:
            return None
        fields = self._format.unpack(packet)[2:-1]
        if fields[::2] != self._packets:
            return None
        return dict(zip(fields[::2], fields[1::2], strict=True))
