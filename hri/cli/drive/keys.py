"""The keys of teleoperation: their meaning, and how long a press lasts."""

from __future__ import annotations

import re
from dataclasses import dataclass

from hri.core.signals import Twist
from hri.hal.motion import REST

DEAD_MAN = 0.3
"""Seconds that a key press lasts; a held key repeats, a released one stops the base."""
DIRECTIONS: dict[str, tuple[int, int]] = {
    "up": (1, 0),
    "down": (-1, 0),
    "left": (0, 1),
    "right": (0, -1),
    "w": (1, 0),
    "s": (-1, 0),
    "a": (0, 1),
    "d": (0, -1),
    "q": (1, 1),
    "e": (1, -1),
}
"""Which way the base goes and turns: forward, and to the left."""
FASTER, SLOWER, STOP, RELEASE, QUIT = ("+", "="), ("-",), (" ",), ("r",), ("x", "escape", "ctrl-c")
SHARES = (0.1, 0.2, 0.35, 0.5, 0.75, 1.0)
"""Shares of the speed limit, chosen by FASTER and SLOWER."""
TURNING = 0.5
"""Largest share of the turning limit that keys request, since turning is hard to aim."""
FIRST_SHARE = 2
HELP = (
    "arrows or w a s d: drive while held    q e: curves    + -: faster, slower",
    "space: stop and latch    r: release    x: quit",
)

ESCAPES = {b"\x1b[A": "up", b"\x1b[B": "down", b"\x1b[C": "right", b"\x1b[D": "left"}
ESCAPES |= {sequence.replace(b"[", b"O"): key for sequence, key in ESCAPES.items()}
"""What a terminal sends for arrows."""


SEQUENCE = re.compile(rb"\x1b(?:[\[O][0-9;?]*(?P<end>[@-~])?)?")
"""A sequence of a terminal; complete when it has its end."""
LONGEST_SEQUENCE = 16
"""Bytes; longer input is not a sequence."""
CONTROL_C = 0x03


class KeyReader:
    """Finds keys in the bytes of a terminal, which may send a sequence in parts. So Escape alone
    has no meaning here: it may be the beginning of an arrow.
    """

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[str]:
        """The keys that these bytes complete, without unknown sequences."""
        data, self._rest, keys = self._rest + data, b"", []
        while data:
            sequence = SEQUENCE.match(data)
            if sequence is None:
                keys += _plain(data[0])
                data = data[1:]
                continue
            found = sequence.group()
            if sequence["end"] is None and found == data and len(found) < LONGEST_SEQUENCE:
                self._rest = found
                break
            keys += [ESCAPES[found]] if found in ESCAPES else []
            data = data[len(found) :]
        return keys


def _plain(byte: int) -> list[str]:
    """A key of one byte; nothing for other bytes."""
    if byte == CONTROL_C:
        return ["ctrl-c"]
    return [chr(byte).lower()] if 0x20 <= byte < 0x7F else []


@dataclass
class Steering:
    """The velocity that the keys request; time in seconds."""

    step: int = FIRST_SHARE
    """Index of SHARES."""
    _direction: tuple[int, int] = (0, 0)
    _pressed_at: float = float("-inf")

    @property
    def share(self) -> float:
        """Share of the speed limit."""
        return SHARES[self.step]

    def press(self, key: str, now: float) -> None:
        """Handle a key that steers or changes the speed; others are ignored."""
        if key in DIRECTIONS:
            self._direction, self._pressed_at = DIRECTIONS[key], now
        elif key in FASTER:
            self.step = min(len(SHARES) - 1, self.step + 1)
        elif key in SLOWER:
            self.step = max(0, self.step - 1)

    def let_go(self) -> None:
        """Treat all keys as released."""
        self._direction = (0, 0)

    def twist(self, fastest: Twist, slowest_back: float, now: float) -> Twist:
        """The requested velocity, within the limits forward, turning, and backward (m/s, above
        0).
        """
        ahead, aside = self._direction
        if now - self._pressed_at > DEAD_MAN:
            return REST
        linear = fastest.linear if ahead >= 0 else slowest_back
        turn = fastest.angular * TURNING
        return Twist(ahead * linear * self.share, aside * turn * self.share)
