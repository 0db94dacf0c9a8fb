"""Strangers never keep out those who may use the studio: real sockets, on a loopback of our own."""

import re
import socket
from contextlib import asynccontextmanager, suppress

import pytest
import trio
import trio.testing

from hri.core.token import own_token
from hri.studio.access import Cookies
from hri.studio.connections import (
    MOST,
    STRANGER_S,
    Connections,
    Seat,
)
from hri.studio.hub import Hub
from hri.studio.page_socket import MOST_PAGES_EACH
from hri.studio.server import Settings, Studio, _now
from tests.studio.test_server import GOOD, Robot

PORT = 8311
COOKIE = f"Cookie: hri_studio_{PORT}={Cookies('secret').new(_now())}\r\n"
HOST = f"Host: 127.0.0.1:{PORT}\r\n"
STOP = f"POST /api/v1/stop HTTP/1.1\r\n{HOST}"
STATE = f"GET /api/v1/state HTTP/1.1\r\n{HOST}{COOKIE}\r\n"
LIVE = (
    f"GET /api/v1/live HTTP/1.1\r\n{HOST}{COOKIE}Upgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)
STRANGERS = {
    "silent": "",
    "half a head": STOP,
    "half a body": f"{STOP}Content-Length: 60000\r\n\r\n{{",
    "a guessed code": f"GET /?code=guess HTTP/1.1\r\n{HOST}\r\n",
    "a guessed cookie": STATE.replace(COOKIE, f"Cookie: hri_studio_{PORT}=1.2.3\r\n"),
    "a page of a stranger": LIVE.replace(COOKIE, ""),
}


class Served:
    """A studio on a socket of its own, with a robot that answers everything."""

    def __init__(self, address, robot, connections):
        self.robot, self.connections = robot, connections
        self.streams = []
        self._address = address

    async def say(self, words):
        """Another connection, on which this was said."""
        stream = await trio.open_tcp_stream(*self._address)
        self.streams.append(stream)
        await stream.send_all(words.encode())
        return stream

    async def answer(self, words, stream=None):
        """The status of what comes back."""
        if stream is None:
            stream = await self.say(words)
        else:
            await stream.send_all(words.encode())
        data = b""
        while b"\r\n\r\n" not in data:
            part = await stream.receive_some()
            assert part, "it was broken off"
            data += part
        head, _, body = data.partition(b"\r\n\r\n")
        length = re.search(rb"content-length: (\d+)", head)
        while length and len(body) < int(length[1]):
            body += await stream.receive_some()
        return int(head.split()[1])


@asynccontextmanager
async def served():
    robot = Robot()
    robot.hub = Hub(robot)
    made = Studio(robot.hub, Settings(PORT, "secret", False))
    connections = Connections(made.app(), made.kind_of)
    listening = socket.create_server(("127.0.0.1", 0))
    async with trio.open_nursery() as nursery:
        nursery.start_soon(connections.serve, listening)
        studio = Served(listening.getsockname(), robot, connections)
        yield studio
        nursery.cancel_scope.cancel()
    for stream in studio.streams:
        await trio.aclose_forcefully(stream)


def count(studio, **wanted):
    return sum(
        all(getattr(seat, key) == value for key, value in wanted.items())
        for seat in studio.connections._seats
    )


@pytest.mark.parametrize("kind", STRANGERS)
def test_no_crowd_of_strangers_keeps_out_a_stop_or_whoever_is_known(kind):
    async def run():
        async with served() as studio:
            own = await studio.say("")
            assert await studio.answer(STATE, own) == 200
            for _ in range(MOST["stranger"] + 50):
                await studio.say(STRANGERS[kind])
            assert await studio.answer(STATE, own) == 200  # the connection that was there
            assert await studio.answer(STATE) == 200  # another one
            assert await studio.answer(f"{STOP}\r\n") == 200  # a stranger
            assert studio.robot.obeyed == ["stop"]
            assert count(studio, kind="stranger") <= MOST["stranger"]

    trio.run(run, clock=trio.testing.MockClock())  # no time passes, however slow the machine is


@pytest.mark.slow
def test_a_stranger_who_says_nothing_whole_is_sent_away_soon_and_a_known_one_is_not():
    async def ended(studio, words):
        stream = await studio.say(words)
        with suppress(trio.BrokenResourceError):
            while await stream.receive_some():
                pass

    async def run():
        async with served() as studio:
            for kind in ("silent", "half a head", "half a body"):
                await ended(studio, STRANGERS[kind])
            slow = await studio.say(f"{STOP}{COOKIE}Content-Length: 2\r\n\r\n{{")
            await trio.sleep(4 * STRANGER_S)
            assert await studio.answer("}", slow) == 200

    trio.run(run, clock=trio.testing.MockClock(rate=20))


def test_pages_leave_room_for_other_requests_of_the_same_cookie():
    async def run():
        async with served() as studio:
            pages = []

            async def look():
                pages.append(await studio.answer(LIVE))

            async with trio.open_nursery() as nursery:
                for _ in range(4 * MOST_PAGES_EACH):  # at once
                    nursery.start_soon(look)
            assert pages.count(101) == MOST_PAGES_EACH
            assert await studio.answer(STATE) == 200
            assert count(studio, kind="page") == MOST_PAGES_EACH
            assert count(studio, kind="known") <= MOST["known"] + 1

    trio.run(run)


@pytest.mark.parametrize(
    ("said", "kind"),
    [
        (f"{STOP}\r\n", "first"),
        (f"{STOP}Content-Length: 2\r\n\r\n{{}}", "first"),
        (f"{STOP}Content-Length: 3\r\n\r\n{{}}", "stranger"),
        (f"{STOP}", "stranger"),
        (STATE, "known"),
        (STATE.replace("secret", "x").replace(COOKIE, "Cookie: a=1\r\n"), "stranger"),
        (LIVE, "known"),
        ("GET /?code=GOOD HTTP/1.1\r\n", "first"),
        ("GET /?code=xGOOD HTTP/1.1\r\n", "stranger"),
        ("GET / HTTP/1.1\r\nAuthorization: Bearer TOKEN\r\n\r\n", "known"),
        ("GET / HTTP/1.1\r\nAuthorization: Bearer xTOKEN\r\n\r\n", "stranger"),
        ("", "stranger"),
        ("\xff\x00" * 2000, "stranger"),
    ],
)
def test_a_whole_stop_and_every_proof_goes_first(said, kind):
    studio = Studio(Hub(None), Settings(PORT, "secret", False))
    said = said.replace("TOKEN", own_token()).replace("GOOD", GOOD).encode("latin-1")
    assert studio.kind_of(said) == kind


class Silent:
    """A stream that only has a peer."""

    def __init__(self):
        self.socket = self
        self.is_closed = False

    def close(self):
        self.is_closed = True


def test_whoever_has_most_connections_makes_room_for_a_newcomer():
    connections = Connections(None, None)
    few = [Seat(Silent(), "192.168.1.5", now) for now in range(2)]
    crowd = [Seat(Silent(), "192.168.1.66", 5 + now) for now in range(MOST["stranger"])]
    connections._seats |= {*few, *crowd}
    connections._make_room()
    assert [seat for seat in (*few, *crowd) if seat._stream.is_closed] == [crowd[0]]


def test_a_stop_is_done_though_its_connection_is_broken_off_before_the_answer():
    async def run():
        async with served() as studio:
            tell, held = studio.robot.tell, []
            studio.robot.tell = held.append
            stream = await studio.say(f"{STOP}\r\n")
            while not held:
                await trio.lowlevel.checkpoint()
            (seat,) = studio.connections._seats
            seat.close()
            with suppress(trio.BrokenResourceError):
                await stream.receive_some()
            tell(held[0])
            assert studio.robot.obeyed == ["stop"]
            assert await studio.answer(STATE) == 200

    trio.run(run)
