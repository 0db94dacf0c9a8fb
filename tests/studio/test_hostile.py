"""Strangers who knock: nothing moves, nothing grows, and friends are still let in."""

import random
import socket
from contextlib import ExitStack, suppress

import httpx2 as httpx
import psutil
import pytest

from hri.studio.commands import COMMANDS
from tests.studio.living import known, living, told

pytestmark = pytest.mark.slow
MESSAGES, CLIENTS = 2_000, 200
MOST_MB = 40
"""By which the server may have grown after all of it."""
UPGRADE = (
    "GET /api/v1/live HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nUpgrade: websocket\r\n"
    "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nCookie: {cookie}\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)


def junk(dice):
    """A request that is wrong in one of many ways, as bytes."""
    name = dice.choice([*COMMANDS, "codes", "state", "live", "../token", "%00"])
    head = dice.choice(
        [
            "Host: 127.0.0.1:{port}\r\nAuthorization: Bearer " + 43 * dice.choice("abc") + "\r\n",
            "Host: evil.example\r\n",
            "Host: 127.0.0.1:{port}\r\nOrigin: http://evil.example\r\n",
            "Host: 127.0.0.1:{port}\r\nCookie: hri_studio_{port}=1.2.3\r\n",
            "Host: 127.0.0.1:{port}\r\nContent-Length: 99999999999999999999\r\n",
            "X" * dice.randrange(10_000) + "\r\n",
            "",
        ]
    )
    method = dice.choice(["POST", "GET", "PUT", "DELETE", "BREW"])
    body = bytes(dice.randrange(256) for _ in range(dice.randrange(60)))
    return f"{method} /api/v1/{name} HTTP/1.1\r\n{head}\r\n".encode() + body


@pytest.fixture
def studio_and_robot():
    with living() as both:
        yield both


def test_strangers_move_nothing_and_fill_nothing(studio_and_robot):
    studio, robot = studio_and_robot
    dice = random.Random(24)
    with known(studio.address()) as client, ExitStack() as open_clients:
        told(client, "base", lambda base: base["pose"])
        events = []
        robot.events.subscribe("*", lambda event: events.append(event.name))
        server = psutil.Process(studio.server)
        before = server.memory_info().rss
        cookie = "; ".join(f"{key}={value}" for key, value in client.cookies.items())
        for number in range(CLIENTS):  # some look at everything, and never read it
            knocking = open_clients.enter_context(
                socket.create_connection(("127.0.0.1", studio.port))
            )
            host = f"127.0.0.1:{studio.port}"
            if number % 8 == 0:
                knocking.sendall(UPGRADE.format(host=host, cookie=cookie).encode())
        for _ in range(MESSAGES):
            with (
                suppress(OSError),
                socket.create_connection(("127.0.0.1", studio.port)) as knocking,
            ):
                request = junk(dice).replace(b"{port}", str(studio.port).encode())
                knocking.sendall(request)
        assert told(client, "base", lambda base: True)["pose"] == pytest.approx([0, 0, 0], abs=0.01)
        assert studio.server == server.pid
        assert (server.memory_info().rss - before) / 1e6 < MOST_MB
        assert "speech.heard" not in events
        assert "speech.said" not in events
        with httpx.Client(base_url=f"http://127.0.0.1:{studio.port}") as stranger:
            assert stranger.post("/api/v1/release").status_code == 401
        assert client.post("/api/v1/stop").status_code == 200
        told(client, "base", lambda base: base["is_stopped"])
