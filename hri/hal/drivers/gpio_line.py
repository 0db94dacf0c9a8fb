"""One input of a board's header, by the character device of Linux (`/dev/gpiochip0`).

The kernel collects the changes, with their debouncing, so that none is missed between two looks.
Layouts and numbers are those of version 2 of its interface, `include/uapi/linux/gpio.h` of Linux
5.10.
"""

from __future__ import annotations

import os
import struct
from enum import Enum

GET_LINE, GET_VALUES = 0xC250B407, 0xC010B40E
"""GPIO_V2_GET_LINE_IOCTL, GPIO_V2_LINE_GET_VALUES_IOCTL."""
ACTIVE_LOW, INPUT, RISING, FALLING = 1 << 1, 1 << 2, 1 << 4, 1 << 5
DEBOUNCE = 3
"""GPIO_V2_LINE_ATTR_ID_DEBOUNCE."""
DEBOUNCE_US = 5000
"""Microseconds in which the contacts of a button come to rest."""
REQUEST = struct.Struct("=64I 32s QI20x III4xQ 216x II20xi")
"""gpio_v2_line_request: offsets, consumer, config (flags, number of attributes; the first one's id,
padding, value and mask), number of lines, size of the buffer, descriptor."""
VALUES = struct.Struct("=QQ")
"""gpio_v2_line_values: bits, mask."""
EVENT = struct.Struct("=QIIII24x")
"""gpio_v2_line_event: time, what, offset, two counters, padding."""
PRESSED = 1
"""GPIO_V2_LINE_EVENT_RISING_EDGE: from at rest to active."""


class Pull(Enum):
    """The resistor within the board that holds an open line."""

    UP = 1 << 8
    DOWN = 1 << 9
    NONE = 1 << 10


class GpioLine:
    """An input that is active while a button is pressed.

    With a pull-up, or none, that is while it is connected to ground; with a pull-down, to 3.3 V.
    """

    def __init__(self, chip: str, line: int, pull: Pull) -> None:
        """Raises OSError when the chip cannot be opened or gives the line to nobody."""
        import fcntl  # not on Windows, which has no such lines

        self._control = fcntl.ioctl
        flags = INPUT | RISING | FALLING | pull.value
        if pull is not Pull.DOWN:
            flags |= ACTIVE_LOW
        request = bytearray(packed_request(line, flags))
        descriptor = os.open(chip, os.O_RDWR | os.O_CLOEXEC)
        try:
            self._control(descriptor, GET_LINE, request)
        finally:
            os.close(descriptor)
        self._descriptor: int = REQUEST.unpack(request)[-1]
        os.set_blocking(self._descriptor, False)

    def is_active(self) -> bool:
        """Whether it is active now. Raises OSError."""
        values = bytearray(VALUES.pack(0, 1))
        self._control(self._descriptor, GET_VALUES, values)
        return bool(VALUES.unpack(values)[0] & 1)

    def was_active(self) -> bool:
        """Whether it has become active since the last call. Raises OSError."""
        found = False
        while changes := self._changes():
            kinds = [change[1] for change in EVENT.iter_unpack(changes)]
            found = found or PRESSED in kinds
        return found

    def _changes(self) -> bytes:
        try:
            read = os.read(self._descriptor, 16 * EVENT.size)
        except BlockingIOError:
            return b""
        return read[: len(read) // EVENT.size * EVENT.size]

    def close(self) -> None:
        """Let it go; a second call does nothing."""
        if self._descriptor >= 0:
            os.close(self._descriptor)
            self._descriptor = -1


def packed_request(line: int, flags: int) -> bytes:
    """What asks the kernel for a line."""
    debounced = (DEBOUNCE, 0, DEBOUNCE_US, 1)
    return REQUEST.pack(line, *(0,) * 63, b"hri", flags, 1, *debounced, 1, 0, -1)
