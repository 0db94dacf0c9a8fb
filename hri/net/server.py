"""The end of the bridge that listens."""

from __future__ import annotations

import errno
import logging
import math
import os
import selectors
import socket

from hri.core.errors import HriError
from hri.net.link import Link
from hri.net.peer import Limits

log = logging.getLogger("hri.net")


class Server(Link):
    """Listens on a port; port 0 takes any free one, `port` tells which."""

    def __init__(self, host: str, port: int, limits: Limits | None = None) -> None:
        """Raises HriError when the port cannot be had."""
        self._socket = _listening(host, port)
        super().__init__(host, self._socket.getsockname()[1], limits)
        self._is_full = False
        self._selector.register(self._socket, selectors.EVENT_READ, self._accept)
        self._thread.start()
        if port == 0:
            log.info("listening on %s", self.address)

    def _accept(self, mask: int) -> None:
        try:
            connection, (host, port, *_) = self._socket.accept()
        except OSError as error:
            # Nothing to serve: it hung up again, or this process has no file left.
            log.debug("%s: accept: %s", self.address, error)
            return
        if len(self._peers) < self._limits.peers:
            self._is_full = False
            self._add(connection, f"{host}:{port}")
            return
        connection.close()
        if not self._is_full:
            self._is_full = True
            log.warning("%s: turned %s away: %d peers", self.address, host, len(self._peers))

    def _tend(self, now: float) -> float:
        return math.inf

    def _hang_up(self) -> None:
        self._socket.close()


def _listening(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        listening = socket.create_server((host, port), family=family, backlog=128)
    except (OSError, OverflowError, ValueError) as error:
        code = getattr(error, "errno", None)
        reason = os.strerror(code) if code and code > 0 else str(error)
        remedy = "choose another tcp_port"
        if code == errno.EADDRINUSE:
            remedy = "end the program that has it, or choose another tcp_port"
        elif code == errno.EADDRNOTAVAIL:
            remedy = "bind to an address of this machine"
        raise HriError(f"cannot listen on {host}:{port}: {reason} - {remedy}") from error
    listening.setblocking(False)
    return listening
