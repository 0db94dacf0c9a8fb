"""A serial port that never blocks, belongs to us alone, and is opened again after it was lost."""

from __future__ import annotations

import errno
import os
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

import serial
from serial.tools import list_ports

from hri.core.errors import NotAvailable
from hri.hal.drivers.serial_id import BY_ID, id_of
from hri.hal.port import CHUNK, Port

SOONEST, LATEST = 0.1, 2.0
"""Seconds to the first and to any later attempt to open a port again."""
_BUSY = (errno.EAGAIN, errno.EWOULDBLOCK, errno.EINTR)
_WHY = {
    errno.ENOENT: ("it is not there", "plug it in, or name another port"),
    errno.EACCES: ("no permission", "add yourself to the group of the port, such as dialout"),
    errno.EBUSY: ("something else uses it", "close the other program"),
    errno.EAGAIN: ("something else uses it", "close the other program"),
    errno.ENOTTY: ("it is not a serial port", "name one, such as /dev/ttyUSB0"),
    errno.EISDIR: ("it is a folder", "name a serial port, such as /dev/ttyUSB0"),
    errno.ENXIO: ("there is no device behind it", "plug it in, or name another port"),
}


class Backoff:
    """When to try again: soon at first, then ever more seldom."""

    def __init__(self, soonest: float = SOONEST, latest: float = LATEST) -> None:
        self._soonest, self._latest = soonest, latest
        self.reset()

    def reset(self) -> None:
        """It worked: the next failure is a first one."""
        self._wait, self._due = self._soonest, float("-inf")

    def is_due(self, now: float) -> bool:
        return now >= self._due

    def fail(self, now: float) -> None:
        self._due = now + self._wait
        self._wait = min(self._latest, 2 * self._wait)


class SerialPort(Port):
    """A port of this machine, through pyserial: eight bits, no parity, one stop bit.

    An adapter that was open once is waited for under whatever path it comes back, where the system
    knows it by an id; another one that takes its path is left alone.
    """

    def __init__(self, path: str, baud: int, by_id: str = BY_ID) -> None:
        """`by_id`: the folder with the ids of adapters; see `hri.hal.drivers.serial_id`."""
        self.path, self.baud = path, baud
        self._by_id, self._id = by_id, ""
        self._serial: serial.Serial | None = None
        self._reason = ""
        self._backoff = Backoff()

    @property
    def is_open(self) -> bool:
        return self._serial is not None

    @property
    def reason(self) -> str:
        return self._reason

    def open(self, now: float) -> bool:
        if self.is_open or not self._backoff.is_due(now):
            return self.is_open
        try:
            # Without a timeout of 0 pyserial would wait for the bytes that we ask for.
            path = self._id or self.path
            self._serial = serial.Serial(path, self.baud, timeout=0, exclusive=True)
            _hasten(self._serial)
            self._id = self._id or id_of(path, self._by_id)
            self._reason = ""
            self._backoff.reset()
        except (OSError, ValueError, OverflowError) as error:
            self._reason = self._said(error)
            self._backoff.fail(now)
        return self.is_open

    def read(self, now: float) -> bytes:
        try:
            return bytes(self._opened.read(CHUNK))
        except (OSError, TypeError, ValueError) as error:
            # TypeError: closed by another thread; ValueError: a descriptor too high for select.
            raise self._lost(error, now) from error

    def write(self, data: bytes, now: float) -> bool:
        # Not by pyserial: where the line is full its `write` spins, timeout or not.
        try:
            return os.write(self._opened.fileno(), data) == len(data)
        except OSError as error:
            if error.errno in _BUSY:
                return False
            raise self._lost(error, now) from error

    def discard(self) -> None:
        """Forget what was written and is not on the line yet, such as old velocities."""
        try:
            self._opened.reset_output_buffer()
        except OSError:
            return  # reading and writing tell that it has gone

    def set_rts(self, is_on: bool) -> None:
        # A port without that wire says so; reading and writing tell that one has gone.
        with suppress(OSError):
            self._opened.rts = is_on

    def is_clear_to_send(self, now: float) -> bool:
        """Whether the wire "clear to send" is asserted. Raises NotAvailable when it has gone."""
        try:
            return bool(self._opened.cts)
        except OSError as error:
            raise self._lost(error, now) from error

    def fileno(self) -> int:
        """Its descriptor, to wait for. Raises NotAvailable while it is closed."""
        return int(self._opened.fileno())

    def close(self) -> None:
        port, self._serial = self._serial, None
        if port is not None:
            try:
                port.close()
            except OSError:
                return  # it has gone by itself

    @property
    def _opened(self) -> serial.Serial:
        if self._serial is None:
            raise NotAvailable(f"{self.path}: the port is closed - open it first")
        return self._serial

    def _lost(self, error: Exception, now: float) -> NotAvailable:
        self.close()
        self._reason = f"{self.path}: the device has gone - see that it is plugged in"
        self._backoff.fail(now)
        return NotAvailable(self._reason)

    def _said(self, error: Exception) -> str:
        number = getattr(error, "errno", None)
        cause = error.__context__ if number is None else None
        number = getattr(cause, "errno", number)
        if number is None and cause is not None:
            number = next(
                (one for one in cause.args[:1] if isinstance(one, int)), None
            )  # of termios
        reason = os.strerror(number) if number else str(error)
        why, remedy = _WHY.get(number or 0, (reason, "name a serial port"))
        if self._id and number == errno.ENOENT:
            why, remedy = f"{os.path.basename(self._id)} is not there", "plug it in again"
        return f"{self.path}: {why} - {remedy}"


def _hasten(port: serial.Serial) -> None:
    """Let an adapter pass bytes on at once, instead of collecting them for up to 16 ms."""
    # Few kinds of ports know what that is; all of them work without.
    with suppress(AttributeError, NotImplementedError, OSError, ValueError):
        port.set_low_latency_mode(True)


@dataclass(frozen=True, slots=True)
class Listed:
    """A serial port of this machine."""

    path: str
    about: str
    """What its adapter says that it is; empty when it says nothing."""


def serial_ports() -> Sequence[Listed]:
    """The ports that a device seems to be connected to, sorted by path."""
    listed = []
    for port in sorted(list_ports.comports()):
        about = port.description if port.description not in (None, "n/a", port.name) else ""
        listed.append(Listed(port.device, about))
    return listed
