"""A serial line to an emulated base, and what can go wrong on it."""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from hri.core.errors import NotAvailable
from hri.hal.port import CHUNK, Port
from hri.simulation.bases.emulator import Emulator

MOST_WAITING = 8192
"""Bytes on their way in one direction; what comes on top is lost."""


@dataclass(slots=True)
class Faults:
    """What happens to the bytes on a line, in both directions; may be changed at any time."""

    delay: float = 0.0
    """Seconds that they are late, as behind an adapter that collects them."""
    report_delay: float = 0.0
    """Seconds that those from the base are late besides."""
    lost: float = 0.0
    """Part of the bytes that never come, 0 to 1."""
    damaged: float = 0.0
    """Part of the bytes that come as another one."""
    halved: float = 0.0
    """Part of the bursts of which only the first half comes."""


class _Direction:
    """Bytes that go one way."""

    def __init__(self, faults: Faults, seed: int, delay: Callable[[], float]) -> None:
        self._faults, self._delay = faults, delay
        self._random = random.Random(seed)
        self._on_the_way: deque[tuple[float, bytes]] = deque()
        self._waiting = 0

    def send(self, data: bytes, now: float) -> None:
        spoiled = self._spoiled(data)
        if spoiled and self._waiting + len(spoiled) <= MOST_WAITING:
            self._waiting += len(spoiled)
            self._on_the_way.append((now + self._delay(), spoiled))

    def arrived(self, now: float) -> list[tuple[float, bytes]]:
        """Bursts that have come, each with its time."""
        come = []
        while self._on_the_way and self._on_the_way[0][0] <= now:
            come.append(self._on_the_way.popleft())
            self._waiting -= len(come[-1][1])
        return come

    def _spoiled(self, data: bytes) -> bytes:
        faults, chance = self._faults, self._random.random
        if data and faults.halved and chance() < faults.halved:
            data = data[: len(data) // 2]
        if not (faults.lost or faults.damaged):
            return data
        kept = (byte for byte in data if chance() >= faults.lost)
        return bytes(
            b ^ self._random.randrange(1, 256) if chance() < faults.damaged else b for b in kept
        )


class Line:
    """Passes bytes to an emulated base and back, with the same faults for the same seed."""

    def __init__(self, emulator: Emulator, faults: Faults | None = None, seed: int = 0) -> None:
        self.emulator = emulator
        self.faults = faults or Faults()
        self._there = _Direction(self.faults, seed, lambda: self.faults.delay)
        self._back = _Direction(
            self.faults, seed + 1, lambda: self.faults.delay + self.faults.report_delay
        )

    def feed(self, data: bytes, now: float) -> bytes:
        """What comes back until `now`, when these bytes are sent then."""
        if data:
            self._there.send(data, now)
        for time, burst in self._there.arrived(now):
            self._back.send(self.emulator.feed(burst, time), time)
        self._back.send(self.emulator.feed(b"", now), now)
        return b"".join(burst for _, burst in self._back.arrived(now))


class EmulatedPort(Port):
    """A port in memory, whose other end is an emulated base; it can be pulled out."""

    def __init__(self, line: Line, path: str = "simulated") -> None:
        self.path, self.line = path, line
        self.is_plugged = True
        self.is_full = False
        """Whether it takes no bytes, as when nobody at the other end reads them."""
        self._is_open = False
        self._come = bytearray()

    @property
    def is_open(self) -> bool:
        return self._is_open

    @property
    def reason(self) -> str:
        return "" if self.is_plugged else f"{self.path}: the device has gone - plug it in"

    def open(self, now: float) -> bool:
        if self.is_plugged and not self._is_open:
            self._is_open = True
            self._come.clear()
            self.line.feed(b"", now)  # drop what came while it was closed
        return self._is_open

    def read(self, now: float) -> bytes:
        self._refuse_gone()
        self._come += self.line.feed(b"", now)
        data = bytes(self._come[:CHUNK])
        del self._come[:CHUNK]
        return data

    def write(self, data: bytes, now: float) -> bool:
        self._refuse_gone()
        if self.is_full:
            return False
        self._come += self.line.feed(data, now)
        del self._come[:-MOST_WAITING]
        return True

    def set_rts(self, is_on: bool) -> None:
        if self.is_plugged:
            self.line.emulator.set_rts(is_on)

    def close(self) -> None:
        self._is_open = False

    def _refuse_gone(self) -> None:
        if not self.is_plugged:
            self._is_open = False
        if not self._is_open:
            raise NotAvailable(self.reason or f"{self.path}: the port is closed - open it first")
