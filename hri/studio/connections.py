"""Who has a connection to the studio: strangers never keep out those who may use it.

A connection is a stranger's until a request on it shows the cookie or the token. Strangers have a
short time for each request, and a newcomer always finds a place: that of the oldest stranger of the
address that has most.
"""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Iterable
from functools import partial
from typing import Any, cast

import trio
from hypercorn.config import Config
from hypercorn.trio.tcp_server import TCPServer
from hypercorn.trio.worker_context import WorkerContext
from hypercorn.typing import ConnectionState, LifespanState
from hypercorn.utils import wrap_app
from starlette.types import ASGIApp, Receive, Scope, Send

MOST_STRANGERS, MOST_KNOWN = 256, 128
"""Connections at once."""
BACKLOG = 1024
"""Connections that the system keeps until they are taken."""
STRANGER_S = 3.0
"""Seconds in which a stranger's request has to be complete, and is answered."""
LOOK_EVERY = 0.5
"""Seconds between two looks for strangers whose time is over."""
LONGEST_MESSAGE = 65_536
"""Bytes of a head, and of what a page sends over its WebSocket."""
SEAT = "hri.seat"
"""The key of a scope for the place of its connection."""
log = logging.getLogger("hri.studio")


class Seat:
    """The place of one connection."""

    def __init__(self, stream: trio.SocketStream, peer: str, now: float) -> None:
        self._stream = stream
        self.peer = peer
        self.since = now
        """When it came, seconds; when it was known, for one that is."""
        self.due = now + STRANGER_S
        """When it ends, as long as it is a stranger's."""
        self.is_known = False
        self.is_page = False
        """Whether a page looks at the robot over it."""

    def close(self) -> None:
        """Break it off, whatever waits for its peer."""
        self._stream.socket.close()


class Connections:
    """Lets Hypercorn speak HTTP on each connection. Its own loop over them would end with the first
    that fails.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._config = Config()
        self._config.errorlog = None
        self._config.websocket_max_message_size = LONGEST_MESSAGE
        self._config.h11_max_incomplete_size = LONGEST_MESSAGE
        self._app = app
        self._context = WorkerContext(None)
        self._seats: set[Seat] = set()

    async def take(self, stream: trio.SocketStream) -> None:
        """Serve a connection to its end, whatever that is."""
        try:
            peer = str(stream.socket.getpeername()[0])
        except OSError:  # it has gone already
            await trio.aclose_forcefully(stream)
            return
        self._make_room()
        seat = Seat(stream, peer, trio.current_time())
        self._seats.add(seat)
        app = wrap_app(cast(Any, partial(self._serve, seat)), LONGEST_MESSAGE, "asgi")
        try:
            state = ConnectionState(LifespanState({}))
            await TCPServer(app, self._config, self._context, state, cast(Any, stream)).run()
        except* Exception as failures:  # a peer that breaks off at a bad moment
            log.debug("a connection failed: %s", failures.exceptions[0])
        finally:
            self._seats.discard(seat)

    async def close_overdue(self) -> None:
        """Break off strangers whose time is over, for ever."""
        while True:
            await trio.sleep(LOOK_EVERY)
            now = trio.current_time()
            for seat in [one for one in self._seats if not one.is_known and one.due < now]:
                self._break_off(seat)

    async def _serve(self, seat: Seat, scope: Scope, receive: Receive, send: Send) -> None:
        seat.due = trio.current_time() + STRANGER_S
        try:
            await self._app({**scope, SEAT: seat}, receive, send)
        finally:
            seat.due = trio.current_time() + STRANGER_S
            seat.is_page = False

    def _make_room(self) -> None:
        """For a newcomer, who is a stranger at first."""
        strangers = [one for one in self._seats if not one.is_known]
        if len(strangers) >= MOST_STRANGERS:
            ((crowd, _),) = Counter(one.peer for one in strangers).most_common(1)
            self._break_off(_oldest(one for one in strangers if one.peer == crowd))
        others = [one for one in self._seats if one.is_known and not one.is_page]
        if len(others) > MOST_KNOWN:
            self._break_off(_oldest(others))

    def _break_off(self, seat: Seat) -> None:
        self._seats.discard(seat)
        seat.close()


def _oldest(seats: Iterable[Seat]) -> Seat:
    return min(seats, key=lambda one: one.since)


def know(scope: Scope) -> None:
    """Whoever sent this request showed the cookie or the token: its connection is known now."""
    seat = scope.get(SEAT)
    if seat is not None and not seat.is_known:
        seat.is_known, seat.since = True, trio.current_time()
