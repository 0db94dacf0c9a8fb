"""The sibling of the supervisor that stops the base when the supervisor itself falls silent.

It is forked when the port is opened, inherits its descriptor, and knows only the bytes that
stop this base and those that leave it to itself. Each hears the other: a supervisor whose watchdog
is silent lets the base rest.
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
from dataclasses import dataclass
from typing import NoReturn

from hri.drive.bases.protocol import BaseProtocol

HUSH = 0.12
"""Seconds without a heartbeat after which the watchdog stops the base. A little more than what the
supervisor takes for a gap: where the watchdog spoke, the supervisor knows."""
EVERY = 0.02
"""Seconds between two heartbeats."""
AGAIN = 0.05
"""Seconds between two stops for as long as the supervisor is silent."""
LAST_STOPS = 3
"""Stops that it sends when the supervisor is gone, before it goes too."""
FAREWELLS = 2
"""Farewells behind them, where the base has one."""
ABANDONED = 5.0
"""Seconds of stops for a silent supervisor, after which the base gets its farewell. A supervisor
that goes on after so long latches; a program that lives has replaced it by then."""
DEAF = 0.16
"""Seconds without an answer after which the supervisor lets the base rest until one comes."""
DEAD = 0.5
"""Seconds without an answer after which the supervisor takes the watchdog for dead."""
BEAT = b"."
MOST_DESCRIPTORS = 1024
"""More than the supervisor ever has open."""


class Watchdog:
    """The supervisor's side: send heartbeats, notice when they are not answered."""

    def __init__(self, port: int, words: LastWords, now: float) -> None:
        """`port`: the descriptor of the open port."""
        self._line, theirs = socket.socketpair()
        self._heard, self._said = now, -math.inf
        self._has_ended = False
        self.pid = os.fork()
        if self.pid == 0:
            _guard(theirs.fileno(), port, words)
        self._handle: int | None = None
        with suppress(AttributeError, OSError):  # old systems lack such handles
            self._handle = os.pidfd_open(self.pid)
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

    def kill(self) -> None:
        """End it without a last word: the supervisor lives, and another takes its place."""
        if self._handle is not None:
            with suppress(OSError):
                signal.pidfd_send_signal(self._handle, signal.SIGKILL)

    def close(self) -> None:
        """Let it stop the base, leave it to itself, and go, without being waited for."""
        self._line.close()
        with suppress(OSError):
            # One that stands still cannot notice that nobody needs it.
            os.kill(self.pid, signal.SIGCONT)
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None


@dataclass(frozen=True, slots=True)
class LastWords:
    """What anyone who holds the port may say to the base: stop, and then do as you like.

    The farewell never goes without stops before it. Whoever says a stop also says the farewell when
    nobody will drive any more: the last word decides in what state the base is left.
    """

    stop: bytes
    """Stops the base from any state, and leaves it in one in which it obeys."""
    farewell: bytes = b""
    """Leaves a base that stands to itself, so that it may sleep or charge."""

    @classmethod
    def of(cls, protocol: BaseProtocol) -> LastWords:
        return cls(protocol.emergency_stop, protocol.farewell)

    def write_stop(self, port: int) -> None:
        """Write past whatever still waits on the line of an open port."""
        with suppress(OSError, termios.error):
            termios.tcflush(port, termios.TCOFLUSH)
        with suppress(OSError):  # what has gone is left alone
            os.write(port, self.stop)

    def write_farewells(self, port: int) -> None:
        """Leave a base that was stopped to itself; some times, since a byte may get lost."""
        for _ in range(FAREWELLS if self.farewell else 0):
            select.select([], [], [], AGAIN)
            with suppress(OSError):
                os.write(port, self.farewell)

    def write_all(self, port: int) -> None:
        """Some stops, AGAIN seconds apart, and then the farewells; returns after the last."""
        self.write_stop(port)
        for _ in range(LAST_STOPS - 1):
            select.select([], [], [], AGAIN)
            self.write_stop(port)
        self.write_farewells(port)


def _guard(line: int, port: int, words: LastWords) -> NoReturn:
    """The watchdog's whole life."""
    status = 1
    try:
        os.setsid()  # what ends the supervisor's group must not end us with it
        for name in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(name, signal.SIG_IGN)
        os.set_blocking(line, False)
        _close_all_but({0, 1, 2, line, port})
        _watch(line, port, words)
        status = 0
    finally:
        words.write_all(port)
        os._exit(status)


def _watch(line: int, port: int, words: LastWords) -> None:
    """Until the supervisor has gone."""
    silence = Silence(words, HUSH)
    while True:
        if not select.select([line], [], [], silence.patience)[0]:
            silence.answer(port)
        elif _hears(line):
            silence = Silence(words, HUSH)
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


class Silence:
    """What is done while no heartbeat comes: stops, and after ABANDONED seconds of them the
    farewell. A base without one is stopped on and on."""

    def __init__(self, words: LastWords, patience: float) -> None:
        """`patience`: seconds without a heartbeat after which the first stop is due."""
        self._words = words
        self._stops = 0
        self.patience: float | None = patience
        """Seconds to wait for a heartbeat until `answer` is due; None for as long as it takes."""

    def answer(self, port: int | None) -> None:
        """No heartbeat came for `patience`; without a port nothing is written."""
        self._stops += 1
        self.patience = AGAIN
        if port is not None:
            self._words.write_stop(port)
        if self._words.farewell and self._stops * AGAIN >= ABANDONED:
            self.patience = None
            if port is not None:
                self._words.write_farewells(port)


def _close_all_but(keep: Collection[int]) -> None:
    first = 3
    for last in sorted(fd for fd in keep if fd >= first):
        os.closerange(first, last)
        first = last + 1
    os.closerange(first, MOST_DESCRIPTORS)
