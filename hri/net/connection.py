"""A connection for scripts and foreign programs: lines out, lines in, no robot needed.

    from hri.net.connection import Connection

    with Connection("127.0.0.1", 25000) as connection:
        print("Received:", connection.read())
        connection.send('<tutorial><text count="1">reply from client</text></tutorial>')

This is what TCPConnection with its StringTerminatedProtocol was in 2003.
"""

from __future__ import annotations

import os
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import TracebackType

from hri.core.errors import HriError
from hri.core.token import VARIABLE, load_token
from hri.net import control
from hri.net.loopback import is_loopback
from hri.net.malleable_protocol import LONGEST

_CHUNK = 65_536


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

        The first line shows the `token`; without one, that of the user, if there is one: on this
        machine from its file, elsewhere from HRI_TOKEN alone. An empty one shows none. Raises
        HriError when nobody answers, or the user's token cannot be used.
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
        if token:
            self._send(control.introduction(token))

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
        self._lines += [line.decode(errors="replace").rstrip("\r") for line in lines]

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
