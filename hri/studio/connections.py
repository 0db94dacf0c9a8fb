"""Who has a connection to the studio: strangers never keep out those who may use it.

A connection is a stranger's until a request on it shows the cookie or the token. Strangers have a
short time for each request, and a newcomer always finds a place: that of the oldest stranger of the
address that has most. What a newcomer says first is looked at before anything is done with it:
those who stop the robot, those who show a proof, and strangers each begin one after another.
"""

from __future__ import annotations

import logging
import socket
from collections import Counter
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, Literal, cast

import trio
from hypercorn.config import Config
from hypercorn.trio.tcp_server import TCPServer
from hypercorn.trio.worker_context import WorkerContext
from hypercorn.typing import ConnectionState, LifespanState
from hypercorn.utils import wrap_app
from starlette.types import ASGIApp, Receive, Scope, Send

Kind = Literal["stranger", "first", "known", "page"]
"""Whose a connection is: a stranger's, one's who goes first, or one's who showed the cookie or the
token, and then a page's that looks at the robot.
"""
MOST: Mapping[Kind, int] = {"stranger": 256, "first": 64, "known": 128}
"""Connections at once; pages are counted by themselves."""
BACKLOG = 1024
"""Connections that the system keeps until they are taken."""
STRANGER_S = 5.0
"""Seconds in which a stranger's request has to be complete, and is answered."""
FIRST_LOOK = 4096
"""Bytes of what a newcomer says that are looked at first."""
ACCEPTED_AT_ONCE = 16
"""Connections that are taken between two looks at those that are there."""
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
        self.kind: Kind = "stranger"

    def close(self) -> None:
        """Break it off, whatever waits for its peer."""
        self._stream.socket.close()


class Connections:
    """Lets Hypercorn speak HTTP on each connection. Its own loop over them would end with the first
    that fails.
    """

    def __init__(self, app: ASGIApp, kind_of: Callable[[bytes], Kind]) -> None:
        """`kind_of` says by the first bytes whose a connection is."""
        self._config = Config()
        self._config.errorlog = None
        self._config.websocket_max_message_size = LONGEST_MESSAGE
        self._config.h11_max_incomplete_size = LONGEST_MESSAGE
        self._app, self._kind_of = app, kind_of
        self._turns = {kind: trio.Lock() for kind in MOST}
        """One of each kind begins at a time, so that no crowd keeps those waiting who are there."""
        self._context = WorkerContext(None)
        self._seats: set[Seat] = set()

    async def serve(self, listening: socket.socket) -> None:
        """Serve all who connect, for ever."""
        listening.listen(BACKLOG)
        listeners = [
            trio.SocketListener(trio.socket.from_stdlib_socket(one))
            for one in (listening, *(listening.dup() for _ in range(ACCEPTED_AT_ONCE - 1)))
        ]
        async with trio.open_nursery() as nursery:
            nursery.start_soon(self._close_overdue)
            await trio.serve_listeners(self._take, listeners)

    async def _take(self, stream: trio.SocketStream) -> None:
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
            await trio.lowlevel.wait_readable(stream.socket)
            seat.kind = self._kind_of(await stream.socket.recv(FIRST_LOOK, socket.MSG_PEEK))
            async with self._turns[seat.kind]:
                await trio.lowlevel.checkpoint()
            state = ConnectionState(LifespanState({}))
            await TCPServer(app, self._config, self._context, state, cast(Any, stream)).run()
        except* Exception as failures:  # a peer that breaks off at a bad moment
            log.debug("a connection failed: %s", failures.exceptions[0])
        finally:
            self._seats.discard(seat)
            seat.close()

    async def _close_overdue(self) -> None:
        """Break off strangers whose time is over, for ever."""
        while True:
            await trio.sleep(LOOK_EVERY)
            now = trio.current_time()
            for seat in list(self._seats):
                if seat.kind in ("stranger", "first") and seat.due < now:
                    self._break_off(seat)

    async def _serve(self, seat: Seat, scope: Scope, receive: Receive, send: Send) -> None:
        seat.due = trio.current_time() + STRANGER_S
        try:
            await self._app({**scope, SEAT: seat}, receive, send)
        finally:
            seat.due = trio.current_time() + STRANGER_S
            seat.kind = "known" if seat.kind in ("known", "page") else "stranger"

    def _make_room(self) -> None:
        """For a newcomer: of a full kind, the address that has most of it loses its oldest."""
        for kind, most in MOST.items():
            seats = [one for one in self._seats if one.kind == kind]
            if len(seats) >= most:
                ((crowd, _),) = Counter(one.peer for one in seats).most_common(1)
                of_crowd = (one for one in seats if one.peer == crowd)
                self._break_off(min(of_crowd, key=lambda one: one.since))

    def _break_off(self, seat: Seat) -> None:
        self._seats.discard(seat)
        seat.close()


def know(scope: Scope) -> None:
    """Whoever sent this request showed the cookie or the token: its connection is known now."""
    seat = scope.get(SEAT)
    if seat is not None and seat.kind in ("stranger", "first"):
        seat.kind, seat.since = "known", trio.current_time()
