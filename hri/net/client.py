"""The end of the bridge that connects, and connects again."""

from __future__ import annotations

import errno
import logging
import math
import selectors
import socket
import threading
import time
from collections import deque
from contextlib import suppress

from hri.core.errors import HriError
from hri.core.quoting import escaped
from hri.core.token import load_token
from hri.net import control
from hri.net.handshake import Handshake
from hri.net.malleable_protocol import Message
from hri.net.peer import Peer, PeerLimits
from hri.net.tcp_port import TcpPort

log = logging.getLogger("hri.net")

FIRST_PAUSE, LONGEST_PAUSE = 0.1, 2.0
"""Seconds between two attempts to connect; doubles from the first to the longest."""
TO_CONNECT = 5.0
"""Seconds that one attempt may take."""
TO_CHALLENGE = 0.5
"""Seconds for which lines wait for the server's challenge: before the proof it refuses them."""
MOST_WAITING = 100
"""Such lines; the oldest give way."""
OLDER = "asks for no proof of the token, so it gets none: the hri there is an older one"


class Client(TcpPort):
    """Connects to a server, and again whenever the connection is lost."""

    def __init__(
        self, host: str, port: int, limits: PeerLimits | None = None, *, proves_token: bool = False
    ) -> None:
        """`proves_token`: prove on each connection that this user's token is known, if any is."""
        super().__init__(host, port, limits)
        self._proves_token = proves_token
        self._handshake: Handshake | None = None
        """What has begun on this connection and is not answered."""
        self._proven = ""
        """The token that this connection's last handshake was for."""
        self._held: deque[bytes] | None = None
        """Lines that wait for the end of the handshake; None: lines are sent at once."""
        self._holding = threading.Lock()
        self._held_until = math.inf
        self._is_silent = False
        """Whether the server has left a handshake unanswered: no line waits for one again."""
        self._told: set[str] = set()
        self._addresses: list[tuple[int, tuple[str, int]]] = []
        self._dialing: socket.socket | None = None
        self._pause = FIRST_PAUSE
        self._next = -math.inf
        self._thread.start()

    def send(self, frame: bytes) -> None:
        with self._holding:
            if self._held is None:
                super().send(frame)
            else:
                self._held.append(frame)

    def _tend(self, now: float) -> float:
        if self._peers:
            if now >= self._held_until:
                self._is_silent = True
                self._release()
            return self._held_until
        self._held, self._held_until = None, math.inf  # what waited is lost like all that is sent
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
        self._proven = ""
        hello = self._hello()
        if hello and not self._is_silent:
            self._held = deque(maxlen=MOST_WAITING)
            self._held_until = time.perf_counter() + TO_CHALLENGE
        self._add(dialed, self.address, hello)

    def _hello(self) -> bytes:
        """The line that begins a handshake; empty when this connection had one for this token."""
        try:
            token = load_token() if self._proves_token else None
        except HriError as error:
            self._tell(f"goes without the token: {error}")
            return b""
        if token is None or token == self._proven:
            return b""
        self._proven = token
        self._handshake = Handshake(token)
        return self._handshake.hello

    def _obey(self, message: Message, peer: Peer) -> bool:
        if control.said(message, control.CHALLENGE) is not None:
            self._answer(message, peer)
        if (why := control.said(message, control.REFUSED)) is not None:
            level = logging.WARNING if self._may_warn() else logging.DEBUG
            log.log(level, "%s: %s", self.address, escaped(why))
            if self._handshake is not None:
                self._handshake = None
                self._tell(f"{OLDER} - update it, or start it with --trusted")
            elif line := self._hello():  # the token may have been made only now
                peer.send(line)
        return False

    def _answer(self, challenge: Message, peer: Peer) -> None:
        handshake, self._handshake = self._handshake, None
        if handshake is None:
            return  # nobody asked for it
        self._is_silent = False
        try:
            peer.send(handshake.answer(challenge, peer.connection))
        except (HriError, OSError) as error:
            self._tell(str(error))
        self._release()

    def _release(self) -> None:
        """Send what waited."""
        self._held_until = math.inf
        with self._holding:
            held, self._held = self._held, None
            for frame in held or ():
                super().send(frame)

    def _tell(self, what: str) -> None:
        """Log it once, however often the connection is made."""
        if what not in self._told:
            self._told.add(what)
            log.warning("%s: %s", self.address, escaped(what))

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
