"""What the keys of the teleoperation mean, and for how long."""

from __future__ import annotations

import re
from dataclasses import dataclass

from hri.core.signals import Twist
from hri.hal.motion import REST

DEAD_MAN = 0.3
"""Seconds that a key counts for; a key that is held repeats, and one let go stops the base."""
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
"""Parts of the fastest that is allowed, chosen by FASTER and SLOWER."""
TURNING = 0.5
"""Part of the fastest turning that the keys ask for at most, since turning is hard to aim."""
FIRST_SHARE = 2
HELP = (
    "arrows or w a s d: drive while held    q e: curves    + -: faster, slower",
    "space: stop and latch    r: release    x: quit",
)

ESCAPES = {b"\x1b[A": "up", b"\x1b[B": "down", b"\x1b[C": "right", b"\x1b[D": "left"}
ESCAPES |= {sequence.replace(b"[", b"O"): key for sequence, key in ESCAPES.items()}
"""What a terminal sends for arrows."""


SEQUENCE = re.compile(rb"\x1b(?:[\[O][0-9;?]*(?P<end>[@-~])?)?")
"""A sequence of a terminal, whole when it has its end."""
LONGEST_SEQUENCE = 16
"""Bytes; what is longer is none."""
CONTROL_C = 0x03


class KeyReader:
    """Finds keys in what a terminal sends, also where it sends a sequence in parts.

    So Escape alone means nothing here: it may be the beginning of an arrow.
    """

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[str]:
        """The keys that these bytes complete; sequences that mean nothing here are left out."""
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
    """A key that is one byte; none for what is no key here."""
    if byte == CONTROL_C:
        return ["ctrl-c"]
    return [chr(byte).lower()] if 0x20 <= byte < 0x7F else []


@dataclass
class Steering:
    """Which velocity the keys ask for; time in seconds."""

    step: int = FIRST_SHARE
    """Index of SHARES."""
    _direction: tuple[int, int] = (0, 0)
    _pressed_at: float = float("-inf")

    @property
    def share(self) -> float:
        """Part of the fastest that is allowed."""
        return SHARES[self.step]

    def press(self, key: str, now: float) -> None:
        """A key that steers, or changes the speed; others mean nothing here."""
        if key in DIRECTIONS:
            self._direction, self._pressed_at = DIRECTIONS[key], now
        elif key in FASTER:
            self.step = min(len(SHARES) - 1, self.step + 1)
        elif key in SLOWER:
            self.step = max(0, self.step - 1)

    def let_go(self) -> None:
        """Nothing counts as held any more."""
        self._direction = (0, 0)

    def twist(self, fastest: Twist, slowest_back: float, now: float) -> Twist:
        """What is asked for, within the fastest forward, turning, and backward (m/s, above 0)."""
        ahead, aside = self._direction
        if now - self._pressed_at > DEAD_MAN:
            return REST
        linear = fastest.linear if ahead >= 0 else slowest_back
        turn = fastest.angular * TURNING
        return Twist(ahead * linear * self.share, aside * turn * self.share)
