"""Checks of lines of text: what was damaged on the way is known by it, and does nothing.

A line that ends with ` *` and two hexadecimal digits carries a check: the CRC-8 of all that stands
before (polynomial 0x07, begun with 0). It finds every burst of up to 8 damaged bits; of all else
that is damaged, one in 256 is taken for whole.
"""

from __future__ import annotations

POLYNOMIAL = 0x07
SIZE = len(b" *00")


def checked(text: bytes) -> bytes:
    """The text with its check."""
    return b"%b *%02X" % (text, _crc(text))


def has_check(line: bytes) -> bool:
    """Whether a line carries a check, right or wrong."""
    return line[-SIZE : -SIZE + 2] == b" *"


def without_check(line: bytes) -> bytes | None:
    """The text of a line with its check; None where the check is missing or wrong."""
    text = line[:-SIZE]
    return text if checked(text) == line else None


def _crc(text: bytes) -> int:
    crc = 0
    for byte in text:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1) & 0xFF ^ (POLYNOMIAL if crc & 0x80 else 0)
    return crc
