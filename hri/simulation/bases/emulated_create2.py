"""An emulated iRobot Create 2, by its Open Interface specification (2016, 2018).

What it senses is renewed every 15 ms, and only in these slots it stops by itself: in safe mode, at
a cliff ahead, when a wheel drops, and on the charger. It then is in passive mode, as the real one,
in which its buttons let it set off by itself.
"""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable, Iterable, Sequence

from hri.drive.bases.create2 import (
    BUMPS,
    BUMPS_AND_DROPS,
    BUTTONS,
    CAPACITY,
    CHARGE,
    CHARGING,
    CLIFF_SIGNALS,
    CLIFFS,
    FORMATS,
    HEADER,
    LEFT_COUNT,
    LIGHT_AT_10_CM,
    LIGHT_BUMPS,
    METERS_PER_COUNT,
    MODE,
    PRESSED,
    RIGHT_COUNT,
    SLOT,
    TRACK,
    VOLTAGE,
    WHEEL_DROPS,
)
from hri.simulation.bases.body import Body
from hri.simulation.bases.emulator import Emulator, Wire

OFF, PASSIVE, SAFE, FULL = range(4)
GROUPS = {
    0: range(7, 27), 1: range(7, 17), 2: range(17, 21), 3: range(21, 27), 4: range(27, 35),
    5: range(35, 43), 6: range(7, 43), 100: range(7, 59), 101: range(43, 59),
    106: range(46, 52), 107: range(54, 59),
}  # fmt: skip
"""Sensor packets that are asked for under one number."""
LENGTHS = {
    7: 0, 128: 0, 129: 1, 131: 0, 132: 0, 133: 0, 134: 0, 135: 0, 136: 0, 137: 4, 138: 1, 139: 3,
    140: 2, 141: 1, 142: 1, 143: 0, 144: 3, 145: 4, 146: 4, 148: 1, 149: 1, 150: 1, 162: 2, 163: 4,
    164: 4, 165: 1, 167: 15, 168: 3, 173: 0,
}  # fmt: skip
"""Number of bytes after each opcode, or of those that give the number of further bytes."""
DISTANCE, ANGLE = 19, 20
STRAIGHT = (-0x8000, 0x7FFF)
"""Radii that mean none."""
SMALL_RADIUS = 170
"""Millimeters; in a curve so narrow, a cliff stops it backward too."""
FLOOR, NO_FLOOR, FLICKER = 1500, 8, 12
"""Counts of a cliff sensor, and how much they vary."""
MOST_LIGHT = 4095
SEEKING = 100
"""Millimeters a second on the way to the dock, wherever that is, and while it cleans."""
SETTING_OFF = {"clean", "spot", "dock"}
"""Buttons that make it drive by itself."""
CAPACITY_MAH = 2696
VOLTS = (12.4, 16.2)
"""Of an empty and of a full battery."""
SLEEPY = 300.0
"""Seconds in passive mode without a byte, a motion or a button after which it falls asleep."""
LONGEST_GAP = 1.0
"""Seconds; after a longer pause between calls, only the end of it is streamed."""


class EmulatedCreate2(Emulator):
    """Set `overrides[packet] = value` to fake a sensor reading.

    It falls asleep after SLEEPY seconds of rest in passive mode. While asleep, it ignores bytes and
    is silent until the wire RTS, tied to its pin BRC, is asserted; then it waits for a start.
    """

    baud = 115_200

    def __init__(self, body: Body | None = None, seed: int = 0) -> None:
        self.body = body or Body()
        self.mode = OFF
        self.is_asleep = False
        self._is_rts_on = True
        self._active = 0.0
        """When something last happened to it."""
        self.overrides: dict[int, int] = {}
        self.leds = (0, 0, 0)
        self.songs: dict[int, bytes] = {}
        self.played: list[int] = []
        """Numbers of the last songs it played."""
        self._random = random.Random(seed)
        self._wire = Wire(self.baud)
        self._command = bytearray()
        self._streamed: tuple[int, ...] = ()
        self._is_streaming = False
        self._slot: int | None = None
        """The last one; none before time began."""
        self._asked = (0, 0)
        """Commanded wheel velocities, right and left, mm/s."""
        self._zero = self.body.rolled
        """What the wheels had rolled when its counters began."""
        self._origins = {DISTANCE: (0.0, 0.0), ANGLE: (0.0, 0.0)}
        """What the wheels had rolled when these ways were last asked for."""
        self._held: set[str] = set()
        """Buttons that were pressed in the last slot."""
        self._values: dict[int, int] = {}
        self._sense(0.0)

    @property
    def is_rolling(self) -> bool:
        """Whether its motors are commanded to roll."""
        return self._asked != (0, 0)

    def feed(self, data: bytes, now: float) -> bytes:
        last = int(now / SLOT + 1e-6)
        before = last if self._slot is None else self._slot
        self._slot = max(before, last - round(LONGEST_GAP / SLOT))
        while self._slot < last:
            self._slot += 1
            self._tick(self._slot * SLOT)
        if self.is_asleep:
            return b""
        if data:
            self._active = now
        for byte in data:
            self._take(byte, now)
        return self._wire.arrived(now)

    def set_rts(self, is_on: bool) -> None:
        if is_on and not self._is_rts_on:
            self.is_asleep = False
        self._is_rts_on = is_on

    # --- sensing ---

    def _tick(self, now: float) -> None:
        self.body.advance(now)
        self._sense(now)
        self._protect(now)
        self._heed_buttons(now)
        self._rest(now)
        if self._is_streaming and self.mode != OFF and not self.is_asleep:
            packed = zip(self._streamed, self._packed(self._streamed), strict=True)
            content = b"".join(bytes([packet]) + data for packet, data in packed)
            packet = bytes([HEADER, len(content)]) + content
            self._wire.send(packet + bytes([-sum(packet) & 0xFF]), now)

    def _protect(self, now: float) -> None:
        """What its own firmware does in safe mode."""
        right, left = self._asked
        turns_narrowly = right != left and abs(self._radius) < SMALL_RADIUS
        at_cliff = any(self._values[packet] for packet in CLIFFS.values())
        is_falling = at_cliff and (right + left > 0 or (right + left < 0 and turns_narrowly))
        is_lifted = bool(self._values[BUMPS_AND_DROPS] & sum(WHEEL_DROPS.values()))
        if self.mode == SAFE and (is_falling or is_lifted or self.body.is_on_charger):
            self._enter(PASSIVE, now)

    def _heed_buttons(self, now: float) -> None:
        """Clean, or look for the dock, in passive mode."""
        newly, self._held = self.body.held - self._held, set(self.body.held)
        if self.mode == PASSIVE and newly & SETTING_OFF:
            self._roll(SEEKING, SEEKING, now)

    def _rest(self, now: float) -> None:
        """Fall asleep when nothing happens for long."""
        if self.mode != PASSIVE or self.is_rolling or self._held:
            self._active = now
        elif now - self._active > SLEEPY:
            self._enter(OFF, now)
            self.is_asleep = True

    @property
    def _radius(self) -> float:
        """Radius of the commanded curve, mm; infinity straight ahead."""
        right, left = self._asked
        return TRACK * 500 * (right + left) / (right - left) if right != left else math.inf

    def _sense(self, now: float) -> None:
        body, level = self.body, self.body.battery(now)
        bumps = body.bumps(now)
        flags = sum(bit for place, bit in BUMPS.items() if place in bumps)
        flags += sum(bit for place, bit in WHEEL_DROPS.items() if place in body.hanging)
        values = dict.fromkeys(FORMATS, 0)
        left, right = (now - then for now, then in zip(body.rolled, self._zero, strict=True))
        values |= {
            BUMPS_AND_DROPS: flags,
            PRESSED: sum(bit for name, bit in BUTTONS.items() if name in body.held),
            CHARGING: 2 if body.is_on_charger else 0,
            VOLTAGE: round(1000 * (VOLTS[0] + (VOLTS[1] - VOLTS[0]) * level)),
            23: 1500 if body.is_on_charger else -250,
            24: 25,
            CHARGE: round(CAPACITY_MAH * level),
            CAPACITY: CAPACITY_MAH,
            34: int(body.is_on_charger) * 2,
            LEFT_COUNT: int(left / METERS_PER_COUNT) & 0xFFFF,
            RIGHT_COUNT: int(right / METERS_PER_COUNT) & 0xFFFF,
        }
        for place, packet in CLIFFS.items():
            is_edge = body.is_over_edge(place)
            values[packet] = int(is_edge)
            mean = NO_FLOOR if is_edge else FLOOR
            values[CLIFF_SIGNALS[place]] = max(0, mean + self._random.randint(-FLICKER, FLICKER))
        for bit, (place, packet) in enumerate(LIGHT_BUMPS.items()):
            values[packet] = self._light(body.distance(place, now))
            values[45] |= (values[packet] > LIGHT_AT_10_CM[0] / 4) << bit
        self._values = values

    def _light(self, distance: float) -> int:
        light = LIGHT_AT_10_CM[0] * (0.1 / max(0.001, distance)) ** 2
        return min(MOST_LIGHT, round(light))

    def _packed(self, packets: Sequence[int]) -> list[bytes]:
        """Sensor packets as they go over the line."""
        # Requested values follow commands at once; the others have their slots.
        values = self._values | self._told() | self.overrides
        for packet in self._origins.keys() & set(packets) - self.overrides.keys():
            values[packet] = self._way(packet)
        return [struct.pack(">" + FORMATS[packet], values[packet]) for packet in packets]

    def _way(self, packet: int) -> int:
        """Millimeters or degrees since it was last asked for them."""
        (left, right), origin = self.body.rolled, self._origins[packet]
        self._origins[packet] = left, right
        left, right = left - origin[0], right - origin[1]
        if packet == DISTANCE:
            return _clipped((left + right) / 2 * 1000)
        return _clipped(math.degrees((right - left) / TRACK))

    def _told(self) -> dict[int, int]:
        """Its mode, its requested stream and its commanded motion."""
        right, left = self._asked
        return {
            MODE: self.mode,
            38: len(self._streamed),
            39: _clipped((right + left) / 2),
            40: -0x8000 if math.isinf(self._radius) else _clipped(self._radius),
            41: right,
            42: left,
        }

    # --- commands ---

    def _take(self, byte: int, now: float) -> None:
        """One byte that comes in."""
        if self.mode == OFF:
            # It waits for a start, and for nothing else.
            self._command.clear()
            if byte in (128, 7):
                self._run(byte, b"", now)
            return
        if not self._command and byte not in LENGTHS:
            return
        self._command.append(byte)
        opcode = self._command[0]
        if len(self._command) > self._length():
            data = bytes(self._command[1:])
            self._command.clear()
            self._run(opcode, data, now)

    def _length(self) -> int:
        """Bytes that the command on its way has after its opcode, as far as that is known."""
        opcode, data = self._command[0], self._command[1:]
        if opcode == 140 and len(data) >= 2:
            return 2 + 2 * data[1]
        if opcode in (148, 149) and data:
            return 1 + data[0]
        return LENGTHS[opcode]

    def _run(self, opcode: int, data: bytes, now: float) -> None:
        actions: dict[int, Callable[[bytes, float], None]] = {
            7: self._reset,
            137: self._drive,
            139: self._light_leds,
            140: self._learn_song,
            141: self._play,
            143: self._seek_dock,
            142: self._answer,
            145: self._drive_direct,
            146: self._drive_pwm,
            148: self._stream,
            149: lambda data, now: self._send(data[1:], now),
            150: self._pause,
        }
        modes = {128: PASSIVE, 131: SAFE, 132: FULL, 133: PASSIVE, 173: OFF}
        if opcode in modes:
            self._enter(modes[opcode], now)
        elif opcode in actions:
            actions[opcode](data, now)

    def _enter(self, mode: int, now: float) -> None:
        if mode == SAFE and self.body.is_on_charger:
            mode = PASSIVE
        if mode in (OFF, PASSIVE) or self.mode == PASSIVE:
            self._roll(0, 0, now)
        if mode == OFF:
            self._is_streaming = False
        self.mode = mode

    def _seek_dock(self, data: bytes, now: float) -> None:
        self._enter(PASSIVE, now)
        self._roll(SEEKING, SEEKING, now)

    def _reset(self, data: bytes, now: float) -> None:
        self._enter(OFF, now)
        self._streamed = ()
        self._zero = self.body.rolled
        self._origins = dict.fromkeys(self._origins, self.body.rolled)
        self._wire.send(b"bl-start\r\n2015-08-24-1648-L   \r\n", now)

    def _roll(self, right: int, left: int, now: float) -> None:
        self._asked = right, left
        self.body.roll(left / 1000, right / 1000, now)

    def _drive_direct(self, data: bytes, now: float) -> None:
        right, left = (max(-500, min(500, v)) for v in struct.unpack(">hh", data))
        if self.mode in (SAFE, FULL):
            self._roll(right, left, now)

    def _drive_pwm(self, data: bytes, now: float) -> None:
        right, left = (max(-255, min(255, v)) * 500 // 255 for v in struct.unpack(">hh", data))
        self._drive_direct(struct.pack(">hh", right, left), now)

    def _drive(self, data: bytes, now: float) -> None:
        velocity, radius = struct.unpack(">hh", data)
        if radius in STRAIGHT:
            right = left = velocity
        elif abs(radius) == 1:
            right, left = velocity * radius, -velocity * radius
        else:
            share = TRACK * 500 / (radius or 1)
            right, left = round(velocity * (1 + share)), round(velocity * (1 - share))
        clipped = (max(-500, min(500, rim)) for rim in (right, left))
        self._drive_direct(struct.pack(">hh", *clipped), now)

    def _light_leds(self, data: bytes, now: float) -> None:
        self.leds = data[0], data[1], data[2]

    def _learn_song(self, data: bytes, now: float) -> None:
        self.songs[data[0] % 5] = data[2:]

    def _play(self, data: bytes, now: float) -> None:
        self.played = [*self.played[-9:], data[0]]

    def _answer(self, data: bytes, now: float) -> None:
        self._send(GROUPS.get(data[0], data), now)

    def _send(self, packets: Iterable[int], now: float) -> None:
        known = [packet for packet in packets if packet in FORMATS]
        self._wire.send(b"".join(self._packed(known)), now)

    def _stream(self, data: bytes, now: float) -> None:
        self._streamed = tuple(p for p in data[1:] if p in FORMATS)
        self._is_streaming = True

    def _pause(self, data: bytes, now: float) -> None:
        self._is_streaming = bool(data[0] & 1)


def _clipped(value: float) -> int:
    return max(-0x7FFF, min(0x7FFF, round(value)))
