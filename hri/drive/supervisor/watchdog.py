"""The sibling of the supervisor that stops the base when the supervisor itself falls silent.

It is forked when the port is opened, inherits its descriptor, and knows only the bytes that
stop this base. Each hears the other: a supervisor whose watchdog is silent lets the base rest.
"""

from __future__ import annotations

import math
import os
import select
import signal
import socket
import termios
from collections.abc import Collection
from contextlib import suppress
from typing import NoReturn

HUSH = 0.12
"""Seconds without a heartbeat after which the watchdog stops the base. A little more than what the
supervisor takes for a gap: where the watchdog spoke, the supervisor knows."""
EVERY = 0.02
"""Seconds between two heartbeats."""
AGAIN = 0.05
"""Seconds between two stops for as long as the supervisor is silent."""
LAST_STOPS = 3
"""Stops that it sends when the supervisor is gone, before it goes too."""
DEAF = 0.16
"""Seconds without an answer after which the supervisor lets the base rest until one comes."""
DEAD = 0.5
"""Seconds without an answer after which the supervisor takes the watchdog for dead."""
BEAT = b"."
MOST_DESCRIPTORS = 1024
"""More than the supervisor ever has open."""


class Watchdog:
    """The supervisor's side: send heartbeats, notice when they are not answered."""

    def __init__(self, port: int, stop: bytes, now: float) -> None:
        """`port`: the descriptor of the open port; `stop`: what stops the base from any state."""
        self._line, theirs = socket.socketpair()
        self._heard, self._said = now, -math.inf
        self._has_ended = False
        self.pid = os.fork()
        if self.pid == 0:
            _guard(theirs.fileno(), port, stop)
        theirs.close()
        self._line.setblocking(False)

    def fileno(self) -> int:
        """Its descriptor, to wait for its answers."""
        return self._line.fileno()

    def beat(self, now: float) -> None:
        """Say that the supervisor lives, and hear whether the watchdog does; call it often."""
        if now - self._said < EVERY:
            return
        self._said = now
        # A line that is full or broken shows as silence.
        with suppress(OSError):
            self._line.send(BEAT)
        try:
            self._has_ended = not self._line.recv(4096)
            self._heard = now
        except BlockingIOError:
            return  # no answer yet
        except OSError:
            self._has_ended = True  # killed with a heartbeat unread

    def is_late(self, now: float) -> bool:
        """Whether it cannot be relied on at this moment."""
        return now - self._heard > DEAF

    def is_dead(self, now: float) -> bool:
        """Whether it has ended, or stood still for so long that another one is needed."""
        return self._has_ended or now - self._heard > DEAD

    def close(self) -> None:
        """Let it stop the base a last time and go, by itself."""
        self._line.close()
        with suppress(OSError):
            # One that stands still cannot notice that nobody needs it.
            os.kill(self.pid, signal.SIGCONT)


def _guard(line: int, port: int, stop: bytes) -> NoReturn:
    """The watchdog's whole life."""
    status = 1
    try:
        os.setsid()  # what ends the supervisor's group must not end us with it
        for name in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(name, signal.SIG_IGN)
        os.set_blocking(line, False)
        _close_all_but({0, 1, 2, line, port})
        _watch(line, port, stop)
        status = 0
    finally:
        write_last_stops(port, stop)
        os._exit(status)


def _watch(line: int, port: int, stop: bytes) -> None:
    """Until the supervisor has gone."""
    patience = HUSH
    while True:
        if not select.select([line], [], [], patience)[0]:
            write_stop(port, stop)
            patience = AGAIN
        elif _hears(line):
            patience = HUSH
        else:
            return


def _hears(line: int) -> bool:
    """Answer a heartbeat; false when nobody is there any more."""
    try:
        return bool(os.read(line, 4096)) and os.write(line, BEAT) > 0
    except BlockingIOError:
        return True  # it hears no answers, and stops by itself
    except OSError:
        return False  # killed with an answer unread


def write_stop(port: int, stop: bytes) -> None:
    """Write past whatever still waits on the line of an open port; what has gone is left alone."""
    with suppress(OSError, termios.error):
        termios.tcflush(port, termios.TCOFLUSH)
    with suppress(OSError):
        os.write(port, stop)


def write_last_stops(port: int, stop: bytes) -> None:
    """Write some stops, AGAIN seconds apart, since a byte may get lost; returns after the last."""
    for _ in range(LAST_STOPS):
        write_stop(port, stop)
        select.select([], [], [], AGAIN)


def _close_all_but(keep: Collection[int]) -> None:
    first = 3
    for last in sorted(fd for fd in keep if fd >= first):
        os.closerange(first, last)
        first = last + 1
    os.closerange(first, MOST_DESCRIPTORS)
