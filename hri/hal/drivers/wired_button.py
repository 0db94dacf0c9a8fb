"""A button at the header of a board, or at a serial port."""

from __future__ import annotations

import errno
import logging
import math
from abc import ABC, abstractmethod
from typing import ClassVar

from hri.core.errors import NotAvailable
from hri.hal.button import TAP_S, Button
from hri.hal.drivers.gpio_line import GpioLine, Pull
from hri.hal.drivers.serial_port import SerialPort
from hri.hal.resource import Description

log = logging.getLogger("hri.resources")

PRESSED, RELEASED = ("1", "pressed"), ("0", "released")
"""What a board says at a serial port, as a line of text."""
LONGEST_LINE = 80
"""Characters."""
_WHY = {
    errno.ENOENT: ("it is not there", "use a board with such lines, or check the chip"),
    errno.EACCES: ("no permission", "add yourself to its group: sudo usermod -aG gpio $USER"),
    errno.EBUSY: ("something else uses the line", "close the other program, or take another line"),
    errno.EINVAL: ("it has no such input", "check the line: gpioinfo lists them"),
    errno.ENOTTY: ("it has no inputs", "check the chip: gpiodetect lists them"),
}


class Contact(ABC):
    """What a button closes."""

    @abstractmethod
    def look(self, now: float) -> tuple[bool, bool]:
        """Whether it is closed now, and whether it has been closed again since the last look."""

    @abstractmethod
    def close(self) -> None:
        """Let the device go."""


class WiredButton(Button):
    """A button between an input and ground, or one that a board reports at a serial port.

    `gpio` is the number of an input of `chip`, which `pull` holds "up" (the button is connected to
    ground), "down" (to 3.3 V), or not at all ("none": the board has a resistor). Or `port` is a
    serial port: of `signal` "text" a board writes the lines "pressed" and "released", or 1 and 0,
    of "cts" the button connects RTS and CTS of an adapter.
    """

    parameters: ClassVar[tuple[str, ...]] = ("gpio", "chip", "pull", "port", "baud", "signal")
    is_hardware = True

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        if ("gpio" in description.parameters) == ("port" in description.parameters):
            what = f"{description.id} is a button at nothing, or at two things"
            raise description.error("port", what, "name gpio or port, one of them")
        description.choice("pull", "up", [pull.name.lower() for pull in Pull])
        description.choice("signal", "text", list(SIGNALS))
        description.count("gpio", 0, 0, 1023)
        description.count("baud", 115_200, 300, 4_000_000)

    def _open(self) -> None:
        self._shown_until = -math.inf
        if port := self.description.text("port"):
            signal = self.description.text("signal", "text")
            self._contact: Contact = SIGNALS[signal](self._serial(port))
        else:
            self._contact = GpioContact(self._line())

    def _line(self) -> GpioLine:
        chip, number = (
            self.description.text("chip", "/dev/gpiochip0"),
            self.description.text("gpio"),
        )
        pull = Pull[self.description.text("pull", "up").upper()]
        try:
            return GpioLine(chip, int(self.description.number("gpio", 0)), pull)
        except OSError as error:
            why, remedy = _WHY.get(error.errno or 0, (error.strerror, "check gpio and chip"))
            raise self.not_available(f"{chip}, line {number}: {why}", remedy) from error

    def _serial(self, path: str) -> SerialPort:
        port = SerialPort(path, int(self.description.number("baud", 115_200)))
        now = self.manager.clock.now()
        if not port.open(now):
            why, _, remedy = port.reason.partition(" - ")
            raise self.not_available(why, remedy)
        return port

    def is_pressed(self, now: float) -> bool:
        is_closed, was_closed = self._contact.look(now)
        if was_closed:
            self._shown_until = now + TAP_S
        return is_closed or now < self._shown_until

    def _close(self) -> None:
        self._contact.close()


class GpioContact(Contact):
    """At the header of a board."""

    def __init__(self, line: GpioLine) -> None:
        self._line = line

    def look(self, now: float) -> tuple[bool, bool]:
        was_active = self._line.was_active()
        return self._line.is_active(), was_active

    def close(self) -> None:
        self._line.close()


class SerialContact(Contact):
    """At a serial port; while that is unplugged it is open, and it is looked for."""

    def __init__(self, port: SerialPort) -> None:
        self._port = port
        self._is_lost = False

    def look(self, now: float) -> tuple[bool, bool]:
        try:
            if not self._port.open(now):
                return False, False
            self._is_lost = False
            return self._read(now)
        except NotAvailable as error:
            if not self._is_lost:
                log.warning("%s", error)
            self._is_lost = True
            return False, False

    @abstractmethod
    def _read(self, now: float) -> tuple[bool, bool]:
        """As `look`. Raises NotAvailable when the port has gone."""

    def close(self) -> None:
        self._port.close()


class TextContact(SerialContact):
    """A board writes a line at each change."""

    def __init__(self, port: SerialPort) -> None:
        super().__init__(port)
        self._rest, self._is_closed = "", False

    def look(self, now: float) -> tuple[bool, bool]:
        is_closed, was_closed = super().look(now)
        if self._is_lost:
            self._rest, self._is_closed = "", False
        return is_closed, was_closed

    def _read(self, now: float) -> tuple[bool, bool]:
        was_closed = False
        *lines, rest = (self._rest + self._port.read(now).decode("latin-1")).split("\n")
        self._rest = rest[-LONGEST_LINE:]
        for word in (line.strip().lower() for line in lines):
            if word in PRESSED or word in RELEASED:
                self._is_closed = word in PRESSED
                was_closed = was_closed or self._is_closed
        return self._is_closed, was_closed


class CtsContact(SerialContact):
    """The button connects the wires RTS and CTS of an adapter."""

    def _read(self, now: float) -> tuple[bool, bool]:
        return self._port.is_clear_to_send(now), False


SIGNALS = {"text": TextContact, "cts": CtsContact}
