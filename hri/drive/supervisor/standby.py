"""The program as the third process that can stop the base, beside the supervisor and its watchdog.

The supervisor lends the program the open port and a handle on its watchdog, and sends heartbeats on
a separate line. A thread of the program listens: when the heartbeats cease, it writes the emergency
stop itself. When the supervisor has ended, the thread also ends a watchdog that stands still,
leaves the base to itself, and gives the port back, so that the next supervisor can open it.
"""

from __future__ import annotations

import math
import os
import signal
import socket
import threading
from collections.abc import Sequence
from contextlib import suppress

from hri.drive.supervisor.watchdog import BEAT, EVERY, LastWords, Silence

PATIENCE = 0.13
"""Seconds without a heartbeat after which the program stops the base. The watchdog is due before
it, and the supervisor takes less for a gap: when it goes on, it knows that it was away."""
LEND, WITHDRAW = b"+", b"-"
"""Words beside the heartbeat: two descriptors come with this one; give back what you have."""
LONGEST_WORD = 16
MOST_LENT = 2
"""Descriptors: the port, and a handle on the watchdog's process."""
GIVING_BACK = 1.0
"""Seconds that a closing program waits at most until the thread has given the port back."""


class Lifeline:
    """The supervisor's side: lend the port, and show that the supervisor lives. Never blocks."""

    def __init__(self, line: socket.socket) -> None:
        self._line = line
        self._said = -math.inf
        self._word = BEAT
        self._port: int | None = None
        self._watchdog: int | None = None
        """A descriptor of its process, until it has been sent."""
        line.setblocking(False)

    def lend(self, port: int, watchdog: int) -> None:
        """From the next heartbeat on the program has this port, and may end this process."""
        self.withdraw()
        self._word, self._port = LEND, port
        # Without such handles, which old systems lack, a frozen watchdog keeps the port.
        with suppress(AttributeError, OSError):
            self._watchdog = os.pidfd_open(watchdog)

    def withdraw(self) -> None:
        """From the next heartbeat on the program has no port; the port has gone, or will."""
        self._word, self._port = WITHDRAW, None
        self._forget_watchdog()

    def beat(self, now: float) -> None:
        """Say what is due; call it often. What finds the line full is said again."""
        if self._word == BEAT and now - self._said < EVERY:
            return
        self._said = now
        lent = [each for each in (self._port, self._watchdog) if each is not None]
        with suppress(OSError):
            socket.send_fds(self._line, [self._word], lent if self._word == LEND else [])
            self._word = BEAT
            self._forget_watchdog()

    def _forget_watchdog(self) -> None:
        if self._watchdog is not None:
            os.close(self._watchdog)
        self._watchdog = None


class Standby:
    """The program's side: a thread that listens, whatever the program's own loop does."""

    def __init__(self, line: socket.socket, words: LastWords) -> None:
        self._line, self._words = line, words
        self._lent: Sequence[int] = ()
        self._thread = threading.Thread(target=self._stand_by, name="base standby", daemon=True)
        self._thread.start()

    def wait(self) -> None:
        """Wait until the port has been given back; call it when the supervisor has ended."""
        self._thread.join(GIVING_BACK)

    def _stand_by(self) -> None:
        with self._line:
            try:
                self._listen()
                self._end()
            finally:
                self._give_back()

    def _listen(self) -> None:
        """Until the supervisor has ended."""
        silence = Silence(self._words, PATIENCE)
        while True:
            self._line.settimeout(silence.patience)
            try:
                word, lent, *_ = socket.recv_fds(
                    self._line, LONGEST_WORD, MOST_LENT, socket.MSG_CMSG_CLOEXEC
                )
            except TimeoutError:
                silence.answer(self._port)
                continue
            except OSError:
                return
            if not word:
                return
            self._obey(word, lent)
            silence = Silence(self._words, PATIENCE)

    def _obey(self, word: bytes, lent: Sequence[int]) -> None:
        if word in (LEND, WITHDRAW):
            self._give_back()
            self._lent = lent

    def _end(self) -> None:
        """The supervisor has ended, and did not take the port back before: it was killed."""
        if self._port is None:
            return
        self._words.write_stop(self._port)
        for watchdog in self._lent[1:]:
            with suppress(AttributeError, OSError):  # it has ended by itself
                signal.pidfd_send_signal(watchdog, signal.SIGKILL)
        self._words.write_all(self._port)

    @property
    def _port(self) -> int | None:
        return self._lent[0] if self._lent else None

    def _give_back(self) -> None:
        lent, self._lent = self._lent, ()
        for each in lent:
            with suppress(OSError):
                os.close(each)
