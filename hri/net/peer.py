"""The other end of one connection, and how much of it is put up with."""

from __future__ import annotations

import contextlib
import math
import socket
import threading
from collections import deque
from dataclasses import dataclass

from hri.core.errors import HriError
from hri.core.token import Challenge
from hri.net.loopback import is_from_loopback
from hri.net.malleable_protocol import LONGEST, Sender

_CHUNK = 65_536


@dataclass(frozen=True)
class PeerLimits:
    """What a peer may do to us."""

    line: int = LONGEST
    """Bytes of a line; a longer one costs the connection."""
    peers: int = 32
    """Connections at a time that stay."""
    backlog: int = 1_048_576
    """Bytes that wait for a peer that reads slowly; more cost the connection."""
    rate: float = 50_000
    """Lines a second, with one second's worth at once; a faster peer is read less often."""
    patience: float = 10.0
    """Seconds that a line may take from its first byte to its end."""
    silence: float = 3.0
    """Seconds without a message after which a peer gives way to a new one, when all are there."""
    introduction: float = 0.25
    """Seconds in which a peer without a place may prove the token, which gives it one."""


class PeerError(HriError):
    """A peer does what it may not, or is gone."""


class Peer(Sender):
    """A connected socket that never blocks. `send` may be called by any thread."""

    def __init__(
        self, connection: socket.socket, name: str, limits: PeerLimits, now: float
    ) -> None:
        """`now` in seconds, like all times here, on whatever clock the thread of the port has."""
        connection.setblocking(False)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        self.connection = connection
        self.name = name
        self.fault = ""
        """Why `send` gave this peer up; empty as long as it did not."""
        self.held_until = -math.inf
        """No reading before this time."""
        self.unfinished_since = math.inf
        """When the line began that has not ended yet."""
        self.is_local = is_from_loopback(connection)
        """Whether it is on this machine."""
        self.challenge: Challenge | None = None
        """What it was asked to prove and has not yet; a server asks one thing at a time."""
        self.came = now
        self.heard = now
        """When its last message came, or it did."""
        self._limits = limits
        self._lock = threading.Lock()
        self._outgoing: deque[bytes] = deque()
        self._rest = bytearray()
        self._credit = limits.rate
        self._credited = now
        self.backlog = 0
        """Bytes that wait to be sent."""

    def send(self, frame: bytes) -> bool:
        """Send what the socket takes now and keep the rest.

        Returns whether the thread of the port has to look after this peer.
        """
        with self._lock:
            if self.fault:
                return False
            if not self._outgoing:
                frame = frame[self._offer(frame) :]
            if frame and not self.fault:
                self._outgoing.append(frame)
                self.backlog += len(frame)
                if self.backlog > self._limits.backlog:
                    self.fault = f"{self.backlog} bytes wait for it - it has to read faster"
            return bool(frame or self.fault)

    def tell(self, line: bytes) -> None:
        self.send(line)

    def flush(self) -> None:
        """Send queued data, as far as the socket accepts it."""
        with self._lock:
            while self._outgoing and not self.fault:
                frame = self._outgoing.popleft()
                sent = self._offer(frame)
                self.backlog -= sent
                if sent < len(frame):
                    self._outgoing.appendleft(frame[sent:])
                    return

    def receive(self, now: float) -> list[bytes]:
        """The lines that have come to their end. Raises PeerError when it is gone or misbehaves."""
        try:
            data = self.connection.recv(_CHUNK)
        except BlockingIOError:
            return []
        except OSError as error:
            raise PeerError(error.strerror or str(error)) from error
        if not data:
            raise PeerError("")
        searched = len(self._rest)
        self._rest += data
        end = self._rest.rfind(b"\n", searched)
        lines = bytes(self._rest[:end]).split(b"\n") if end >= 0 else []
        del self._rest[: end + 1]
        if len(self._rest) > self._limits.line or any(len(o) > self._limits.line for o in lines):
            raise PeerError(f"a line of more than {self._limits.line} bytes - send shorter ones")
        if lines or math.isinf(self.unfinished_since):
            self.unfinished_since = now if self._rest else math.inf
        self._pay(len(lines), now)
        return lines

    def close(self) -> None:
        with self._lock:
            self.fault = self.fault or "closed"
            self.is_gone = True
            with contextlib.suppress(OSError):
                self.connection.close()

    def _offer(self, frame: bytes) -> int:
        """How much of it the socket took."""
        try:
            return self.connection.send(frame)
        except BlockingIOError:
            return 0
        except OSError as error:
            self.fault = error.strerror or str(error)
            return 0

    def _pay(self, lines: int, now: float) -> None:
        """Token bucket: lines cost credit, time earns it; who owes is not read from."""
        rate = self._limits.rate
        earned = (now - self._credited) * rate
        self._credit = min(rate, self._credit + earned) - lines
        self._credited = now
        if self._credit < 0:
            self.held_until = now - self._credit / rate
