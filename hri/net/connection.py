"""A connection for scripts and foreign programs: lines out, lines in, no robot needed.

    from hri.net.connection import Connection

    with Connection("127.0.0.1", 25000) as connection:
        print("Received:", connection.read())
        connection.send('<tutorial><text count="1">reply from client</text></tutorial>')

This is what TCPConnection with its StringTerminatedProtocol was in 2003.
"""

from __future__ import annotations

import logging
import os
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import TracebackType

from hri.core.errors import HriError
from hri.core.quoting import escaped
from hri.core.token import VARIABLE, load_token
from hri.net import control
from hri.net.handshake import Handshake
from hri.net.loopback import is_loopback
from hri.net.malleable_protocol import LONGEST, ProtocolError, decode

TO_CHALLENGE = 2.0
"""Seconds that the other end has to ask for a proof of the token."""
_CHUNK = 65_536

log = logging.getLogger("hri.net")


class Disconnected(HriError, ConnectionError):
    """The connection is gone, or was closed here."""


class Connection:
    """A client that sends and reads lines, and blocks while it does; for one thread at a time."""

    def __init__(
        self,
        host: str = "127.0.0.1",
        port: int = 25000,
        timeout: float = 10.0,
        token: str | None = None,
    ) -> None:
        """Connect; `timeout` in seconds holds for this, and for each read and send.

        It proves to a robot that the `token` is known, and never sends it; without one, that of
        the user, if there is one: on this machine from its file, elsewhere from HRI_TOKEN alone.
        An empty one proves nothing. Whoever does not know the token gets no proof, and the log
        says so; a program that does not answer within 2 s is taken for one that knows of no token.
        Raises HriError when nobody answers, or the user's token cannot be used.
        """
        self.timeout = timeout
        if token is None:
            token = _users_token(host)
        try:
            self._socket = socket.create_connection((host, port), timeout)
        except OSError as error:
            reason = error.strerror or str(error)
            remedy = "start the server, or check host and port"
            # `from None`: who runs a client by hand needs this line, not how sockets say it.
            raise HriError(f"no connection with {host}:{port}: {reason} - {remedy}") from None
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._other = f"{host}:{port}"
        self._rest = b""
        self._lines: list[str] = []
        self._reader: threading.Thread | None = None
        self._handshake = Handshake(token) if token else None
        if self._handshake is not None:
            self._send(self._handshake.hello)
            self._await_challenge()

    def __enter__(self) -> Connection:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def __iter__(self) -> Iterator[str]:
        """The lines, until the other end hangs up. Raises TimeoutError when none comes in time."""
        try:
            while True:
                yield self.read()
        except EOFError:
            return

    def send(self, line: str) -> None:
        """Send a line; its end is added.

        Raises Disconnected when the connection is gone or was closed, TimeoutError when the other
        end does not take the line in time.
        """
        self._send(line.encode() + b"\n")

    def read(self, timeout: float | None = None) -> str:
        """The next line, without its end.

        Raises TimeoutError when none comes within `timeout` seconds, EOFError when the other end
        has hung up, Disconnected after `close`, HriError for a line of more than 64 KiB.
        """
        end = time.perf_counter() + (self.timeout if timeout is None else timeout)
        while not self._lines:
            with self._explained():
                self._socket.settimeout(max(1e-3, end - time.perf_counter()))
                self._receive()
        return self._lines.pop(0)

    def on_read(self, callback: Callable[[str], object]) -> None:
        """Call back with each line from now on, from a separate thread; do not use `read` with
        it.
        """
        if self._reader is not None:
            raise RuntimeError("on_read was called before - one callback takes all lines")
        self._reader = threading.Thread(target=self._call, args=(callback,), daemon=True)
        self._reader.start()

    def close(self) -> None:
        """Hang up; a second call does nothing."""
        with suppress(OSError):
            # Wakes the thread of `on_read`, which `close` alone does not.
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
        if self._reader is not None and self._reader is not threading.current_thread():
            self._reader.join(self.timeout)

    def _send(self, data: bytes) -> None:
        with self._explained():
            self._socket.settimeout(self.timeout)
            self._socket.sendall(data)

    def _await_challenge(self) -> None:
        """Do not let the caller send what would be refused before the proof."""
        end = time.perf_counter() + min(self.timeout, TO_CHALLENGE)
        try:
            while self._handshake is not None:
                if (left := end - time.perf_counter()) <= 0:
                    raise TimeoutError
                self._socket.settimeout(left)
                self._receive()
        except TimeoutError:
            what = "asks for no proof of the token, so it gets none"
            remedy = 'update the hri there; for a program that knows of no token, pass token=""'
            log.warning("%s: %s - %s", self._other, what, remedy)
        except (EOFError, OSError):
            pass  # whoever sends or reads is told

    def _is_challenge(self, line: bytes) -> bool:
        """Whether a line is the challenge of our handshake, which is answered here."""
        if self._handshake is None or not line.startswith(b"<hri>"):
            return False
        try:
            message = decode(line)
        except ProtocolError:
            return False
        if control.said(message, control.CHALLENGE) is None:
            return False
        handshake, self._handshake = self._handshake, None
        try:
            self._send(handshake.answer(message, self._socket))
        except (HriError, OSError) as error:
            log.warning("%s: %s", self._other, escaped(str(error)))
        return True

    @contextmanager
    def _explained(self) -> Iterator[None]:
        """Say of what the system reports that the connection is gone."""
        try:
            yield
        except TimeoutError:
            raise
        except OSError as error:
            is_closed = self._socket.fileno() < 0
            why = "it was closed" if is_closed else error.strerror or str(error)
            raise Disconnected(f"no connection with {self._other}: {why} - connect again") from None

    def _receive(self) -> None:
        data = self._socket.recv(_CHUNK)
        if not data:
            raise EOFError("the other end has hung up")
        *lines, self._rest = (self._rest + data).split(b"\n")
        if len(self._rest) > LONGEST:
            raise HriError(f"a line of more than {LONGEST} bytes - the other end must send less")
        kept = [line for line in lines if not self._is_challenge(line)]
        self._lines += [line.decode(errors="replace").rstrip("\r") for line in kept]

    def _call(self, callback: Callable[[str], object]) -> None:
        self._socket.settimeout(None)
        while True:
            while self._lines:
                callback(self._lines.pop(0))
            try:
                self._receive()
            except TimeoutError:
                continue  # the timeout of a `send` in another thread
            except (EOFError, OSError):
                return


def _users_token(host: str) -> str | None:
    """What to show to a host: another machine gets nothing that was not meant for one."""
    return load_token() if os.environ.get(VARIABLE) or is_loopback(host) else None
