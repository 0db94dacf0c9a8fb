"""The end of the bridge that connects, and connects again."""

from __future__ import annotations

import errno
import logging
import math
import selectors
import socket
import time
from contextlib import suppress

from hri.core.errors import HriError
from hri.core.quoting import escaped
from hri.core.token import load_token
from hri.net import control
from hri.net.malleable_protocol import Message
from hri.net.peer import Peer, PeerLimits
from hri.net.tcp_port import TcpPort

log = logging.getLogger("hri.net")

FIRST_PAUSE, LONGEST_PAUSE = 0.1, 2.0
"""Seconds between two attempts to connect; doubles from the first to the longest."""
TO_CONNECT = 5.0
"""Seconds that one attempt may take."""


class Client(TcpPort):
    """Connects to a server, and again whenever the connection is lost."""

    def __init__(
        self, host: str, port: int, limits: PeerLimits | None = None, *, shows_token: bool = False
    ) -> None:
        """`shows_token`: begin each connection with the token of this user, if there is one."""
        super().__init__(host, port, limits)
        self._shows_token = shows_token
        self._shown = ""
        self._addresses: list[tuple[int, tuple[str, int]]] = []
        self._dialing: socket.socket | None = None
        self._pause = FIRST_PAUSE
        self._next = -math.inf
        self._thread.start()

    def _tend(self, now: float) -> float:
        if self._peers:
            return math.inf
        if now >= self._next:
            if self._dialing is not None:
                self._give_up(self._dialing, errno.ETIMEDOUT)
            self._next = now + self._dial()
        return self._next

    def _dial(self) -> float:
        """Begin the next attempt; in how many seconds to look after it."""
        try:
            if not self._addresses:
                self._addresses = _addresses(self.host, self.port)
        except (OSError, ValueError) as error:  # a name that cannot be one is a ValueError
            return self._rest(str(error))
        family, address = self._addresses.pop(0)
        try:
            self._dialing = socket.socket(family, socket.SOCK_STREAM)
        except OSError as error:  # a family that this machine has not, or no file left
            return self._try_next(str(error))
        self._dialing.setblocking(False)
        code = self._dialing.connect_ex(address)
        if code not in (0, errno.EINPROGRESS, errno.EWOULDBLOCK):
            return self._give_up(self._dialing, code)
        self._selector.register(self._dialing, selectors.EVENT_WRITE, self._answered)
        return TO_CONNECT

    def _answered(self, mask: int) -> None:
        """The attempt has an end, good or bad."""
        assert self._dialing is not None
        dialed = self._dialing
        code = dialed.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR) or _own_echo(dialed)
        if code:
            self._next = time.perf_counter() + self._give_up(dialed, code)
            return
        self._selector.unregister(dialed)
        self._dialing = None
        self._addresses.clear()
        self._pause = FIRST_PAUSE
        # Also when this connection is lost at once, the next one is not tried in a rush.
        self._next = time.perf_counter() + FIRST_PAUSE
        self._shown = ""
        self._add(dialed, self.address, self._introduction())

    def _introduction(self) -> bytes:
        """The line that shows the token; empty when it was shown on this connection."""
        try:
            token = load_token() if self._shows_token else None
        except HriError as error:
            log.warning("%s: goes without the token: %s", self.address, error)
            return b""
        if token is None or token == self._shown:
            return b""
        self._shown = token
        return control.introduction(token)

    def _obey(self, message: Message, peer: Peer) -> bool:
        if (why := control.why_refused(message)) is not None:
            log.warning("%s: %s", self.address, escaped(why))
            if line := self._introduction():  # it may have been made only now
                peer.send(line)
        return False

    def _give_up(self, dialed: socket.socket, code: int) -> float:
        """End an attempt; in how many seconds to try the next address."""
        with suppress(KeyError):
            self._selector.unregister(dialed)
        dialed.close()
        self._dialing = None
        return self._try_next(errno.errorcode.get(code, str(code)))

    def _try_next(self, why: str) -> float:
        return 0.0 if self._addresses else self._rest(why)

    def _rest(self, why: str) -> float:
        log.debug("%s: no connection: %s", self.address, why)
        pause = self._pause
        self._pause = min(2 * pause, LONGEST_PAUSE)
        return pause

    def _hang_up(self) -> None:
        if self._dialing is not None:
            self._dialing.close()


def _own_echo(dialed: socket.socket) -> int:
    """An error code when a socket has connected with itself, else 0.

    The system does that occasionally, when no program listens on an ephemeral port.
    """
    try:
        is_own = dialed.getsockname() == dialed.getpeername()
    except OSError as error:
        return error.errno or errno.ENOTCONN
    return errno.ECONNREFUSED if is_own else 0


def _addresses(host: str, port: int) -> list[tuple[int, tuple[str, int]]]:
    """What a host's name stands for, IPv4 first, since servers listen on 127.0.0.1."""
    found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    found.sort(key=lambda entry: entry[0] != socket.AF_INET)
    return [(entry[0], entry[4]) for entry in found]  # type: ignore[misc]
