"""What all emulated bases have in common: a serial line on which bytes take their time."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections import deque
from typing import ClassVar

BITS = 10
"""On the line for each byte: a start bit, eight, and a stop bit."""
MOST_WAITING = 8192
"""Bytes that a base keeps to send; what comes on top is lost."""


class Wire:
    """Bytes on their way out, one after the other at the speed of the line."""

    def __init__(self, baud: int) -> None:
        self._seconds = BITS / baud
        self._sent: deque[tuple[float, bytes]] = deque()
        self._free = -math.inf
        self._waiting = 0

    def send(self, data: bytes, now: float) -> None:
        """Put bytes on the line behind those that are there."""
        if not data or self._waiting + len(data) > MOST_WAITING:
            return
        start = max(now, self._free)
        self._free = start + len(data) * self._seconds
        self._waiting += len(data)
        self._sent.append((start, data))

    def arrived(self, now: float) -> bytes:
        """The bytes that have come since the last call."""
        arrived = bytearray()
        while self._sent:
            start, data = self._sent[0]
            count = min(len(data), int((now - start) / self._seconds + 1e-6))
            if count <= 0:
                break
            arrived += data[:count]
            if count < len(data):
                self._sent[0] = start + count * self._seconds, data[count:]
                break
            self._sent.popleft()
        self._waiting -= len(arrived)
        return bytes(arrived)


class Emulator(ABC):
    """A base that is not there."""

    baud: ClassVar[int]

    @abstractmethod
    def feed(self, data: bytes, now: float) -> bytes:
        """What comes out of it until `now`, when these bytes come in then; call it often.

        Never raises, whatever comes in.
        """

    def set_rts(self, is_on: bool) -> None:  # noqa: B027 - many have no such wire
        """What the port does with the wire "request to send"."""
