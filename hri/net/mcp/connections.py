"""Who has a connection: a stranger has one for a short time, and keeps out no one with the bearer.

Hypercorn speaks HTTP on each connection; its loop over all of them would end with the first that
fails.
"""

from __future__ import annotations

import logging
import os
import socket
from functools import partial
from typing import Any, cast

import trio
from hypercorn.config import Config
from hypercorn.trio.tcp_server import TCPServer
from hypercorn.trio.worker_context import WorkerContext
from hypercorn.typing import ConnectionState, LifespanState
from hypercorn.utils import wrap_app
from starlette.types import ASGIApp, Receive, Scope, Send

from hri.core.errors import HriError
from hri.net.mcp.rate import Rate

MOST = 32
"""Connections at once."""
BACKLOG = 64
STRANGER_S = 5.0
"""Seconds in which a stranger has to show the bearer."""
LOOK_EVERY = 0.5
"""Seconds between two looks for strangers whose time is over."""
BURST, A_SECOND = 64.0, 64.0
"""Newcomers that are let in at once, and then each second."""
FULL = 0.1
"""Seconds to wait when the system has no room for another connection."""
LONGEST_HEAD = 32_768
"""Bytes of the head of a request."""
MOST_STREAMS = 8
"""Requests at once on a connection of HTTP/2."""
SEAT = "hri.seat"
"""The key of a scope for the place of its connection."""
log = logging.getLogger("hri.net")


def listening(port: int) -> socket.socket:
    """A socket on this machine alone, 0 for any free port. Raises HriError."""
    try:
        return socket.create_server(("127.0.0.1", port), backlog=BACKLOG)
    except (OSError, OverflowError) as error:
        code = getattr(error, "errno", None)
        reason = os.strerror(code) if code else str(error)
        remedy = "end the program that has it, or name another port (0 takes any that is free)"
        raise HriError(f"cannot listen on 127.0.0.1:{port}: {reason} - {remedy}") from error


class Seat:
    """The place of one connection."""

    def __init__(self, stream: trio.SocketStream, now: float) -> None:
        self._stream = stream
        self.since = now
        self.is_known = False

    def close(self) -> None:
        """Break it off, whatever waits for its other end."""
        self._stream.socket.close()


class Connections:
    """Serves all who connect."""

    def __init__(self, app: ASGIApp) -> None:
        self._config = Config()
        self._config.errorlog = None
        self._config.h11_max_incomplete_size = LONGEST_HEAD
        self._config.h2_max_concurrent_streams = MOST_STREAMS
        self._app = app
        self._context = WorkerContext(None)
        self._seats: set[Seat] = set()

    async def serve(self, listening: socket.socket) -> None:
        """For ever."""
        listener = trio.SocketListener(trio.socket.from_stdlib_socket(listening))
        rate = Rate(BURST, A_SECOND)
        async with trio.open_nursery() as nursery:
            nursery.start_soon(self._close_overdue)
            while True:
                await rate.turn()
                try:
                    nursery.start_soon(self._take, await listener.accept())
                except OSError:
                    await trio.sleep(FULL)

    async def _take(self, stream: trio.SocketStream) -> None:
        """Serve a connection to its end, whatever that is."""
        seat = Seat(stream, trio.current_time())
        if not self._make_room():
            seat.close()
            return
        self._seats.add(seat)
        app = wrap_app(cast(Any, partial(self._serve, seat)), LONGEST_HEAD, "asgi")
        state = ConnectionState(LifespanState({}))
        try:
            await TCPServer(app, self._config, self._context, state, cast(Any, stream)).run()
        except* Exception as failures:  # another end that breaks off at a bad moment
            log.debug("a connection failed: %s", failures.exceptions[0])
        finally:
            self._seats.discard(seat)
            seat.close()

    async def _serve(self, seat: Seat, scope: Scope, receive: Receive, send: Send) -> None:
        await self._app({**scope, SEAT: seat}, receive, send)

    def _make_room(self) -> bool:
        """Whether there is room for a newcomer; the oldest stranger gives way."""
        if len(self._seats) < MOST:
            return True
        strangers = [seat for seat in self._seats if not seat.is_known]
        if strangers:
            self._break_off(min(strangers, key=lambda seat: seat.since))
        return bool(strangers)

    async def _close_overdue(self) -> None:
        while True:
            await trio.sleep(LOOK_EVERY)
            due = trio.current_time() - STRANGER_S
            for seat in [one for one in self._seats if not one.is_known and one.since < due]:
                self._break_off(seat)

    def _break_off(self, seat: Seat) -> None:
        self._seats.discard(seat)
        seat.close()


def know(scope: Scope) -> None:
    """Whoever sent this request showed the bearer: its connection stays."""
    seat = scope.get(SEAT)
    if seat is not None:
        seat.is_known = True
