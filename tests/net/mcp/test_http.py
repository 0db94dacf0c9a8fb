"""Over HTTP on loopback: the bearer, the host, short bodies, and who breaks off."""

import socket
from contextlib import closing, suppress

import httpx2 as httpx
import pytest
import trio
import trio.testing
from mcp import Client
from mcp.client.streamable_http import streamable_http_client

from hri.core.errors import HriError
from hri.drive.behaviors import CommandGate
from hri.net.mcp import connections
from hri.net.mcp.bearer import BEARER, is_shown, revoke
from hri.net.mcp.connections import MOST, Connections, listening
from hri.net.mcp.http import LONGEST_BODY, MOST_REQUESTS, Guard, door, is_own_host, is_own_origin
from hri.net.mcp.permission import Permission
from hri.net.mcp.protocol import server_of
from tests.net.mcp.living import living

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def robot():
    with living(Permission.MOVING, tasks=False) as assistant:
        yield assistant


@pytest.fixture(scope="module")
def address(robot):
    """Of a door of that robot."""
    port, is_over = listening(0), trio.Event()

    async def serve(context):
        async with door(server_of(robot.calls, "http")) as app, trio.open_nursery() as nursery:
            nursery.start_soon(Connections(app).serve, port)
            await is_over.wait()
            nursery.cancel_scope.cancel()

    async def begin():
        robot.context.manager.install(serve)

    async def end():
        is_over.set()

    with closing(port):
        robot.run(begin)
        yield f"http://127.0.0.1:{port.getsockname()[1]}/mcp"
        robot.run(end)


def port_of(address):
    return int(address.split(":")[2].split("/")[0])


@pytest.fixture
def bearer(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    return {"authorization": f"Bearer {BEARER.new()}"}


INITIALIZE = {
    "jsonrpc": "2.0",
    "id": 1,
    "method": "initialize",
    "params": {
        "protocolVersion": "2025-06-18",
        "capabilities": {},
        "clientInfo": {"name": "a test", "version": "1"},
    },
}
ACCEPT = {"accept": "application/json, text/event-stream"}


def test_only_who_shows_the_bearer_comes_in(address, bearer, monkeypatch):
    def status(**headers):
        return httpx.post(address, json=INITIALIZE, headers={**ACCEPT, **headers}).status_code

    assert status(**bearer) == 200
    for shown in ("", "Bearer", "Bearer wrong", f"Basic {bearer['authorization'][7:]}", "Bearer é"):
        answer = httpx.post(
            address, json=INITIALIZE, headers={**ACCEPT, "authorization": shown.encode()}
        )
        assert answer.status_code == 401
        assert "hri mcp token" in answer.text
    monkeypatch.setenv("HRI_TOKEN", "of-the-robot-and-of-nothing-else")
    assert status(authorization="Bearer of-the-robot-and-of-nothing-else") == 401
    old = dict(bearer)
    assert status(authorization=f"Bearer {BEARER.new()}") == 200
    assert status(**old) == 401
    assert revoke()
    assert status(**old) == 401
    assert not revoke()


def test_only_this_machine_under_its_name_and_no_page_of_another_site(address, bearer):
    def status(**headers):
        return httpx.post(
            address, json=INITIALIZE, headers={**ACCEPT, **bearer, **headers}
        ).status_code

    assert status(host="evil.example") == 403
    assert status(origin="http://evil.example") == 403
    assert status(origin="null") == 403
    assert status(host="localhost:1") == 200
    with closing(socket.socket()) as other:
        other.settimeout(2)
        assert other.connect_ex(("127.0.0.2", port_of(address)))


@pytest.mark.parametrize(
    ("host", "is_own"),
    [
        ("localhost", True), ("127.0.0.1:8312", True), ("[::1]:8312", True), ("", False),
        ("10.0.0.1", False), ("localhost.evil.example", False), ("127.0.0.1.evil", False),
        ("[", False), ("a@127.0.0.1:1", True),
    ],
)  # fmt: skip
def test_hosts(host, is_own):
    assert is_own_host(host) is is_own
    assert is_own_origin(None, host)
    assert not is_own_origin("http://evil.example", host)


def test_a_huge_body_and_other_paths_are_refused(address, bearer):
    huge = httpx.post(address, content=b"x" * (LONGEST_BODY + 1), headers=bearer)
    assert huge.status_code == 413

    def parts():
        for _ in range(LONGEST_BODY // 65_536 + 2):
            yield b"x" * 65_536

    with suppress(httpx.TransportError):  # it may be broken off while it sends
        assert httpx.post(address, content=parts(), headers=bearer).status_code == 413
    assert httpx.post(address + "/x", json={}, headers=bearer).status_code == 404


@pytest.mark.parametrize("mode", ["legacy", "auto"])
def test_the_client_of_the_sdk_asks(address, bearer, mode):
    async def ask():
        async with (
            httpx.AsyncClient(headers=bearer, timeout=30) as http,
            Client(streamable_http_client(address, http_client=http), mode=mode) as client,
        ):
            tools = await client.list_tools()
            return len(tools.tools), await client.call_tool("turn", {"angle_deg": 10})

    count, turned = trio.run(ask)
    assert count == 16
    assert turned.structured_content["turned_deg"] == pytest.approx(10, abs=3)


def test_who_breaks_off_moves_nothing_more(robot, address, bearer):
    gate = robot.context.behavior(CommandGate)

    async def ask():
        async with httpx.AsyncClient(headers=bearer, timeout=30) as http:
            with trio.move_on_after(30) as scope:
                async with (
                    Client(streamable_http_client(address, http_client=http)) as client,
                    trio.open_nursery() as nursery,
                ):
                    nursery.start_soon(client.call_tool, "move", {"distance_m": 2})
                    while not gate.is_moving:
                        await client.call_tool("state", {})
                    scope.cancel()

    before = len(robot.heard("drive.stopped"))
    trio.run(ask)
    robot.run(robot.context.clock.sleep, 3.0)
    assert len(robot.heard("drive.stopped")) > before
    assert not gate.is_moving


def test_strangers_keep_no_one_out(address, bearer):
    port = port_of(address)
    crowd = [socket.create_connection(("127.0.0.1", port)) for _ in range(MOST + 10)]
    try:
        answer = httpx.post(address, json=INITIALIZE, headers={**ACCEPT, **bearer}, timeout=30)
        assert answer.status_code == 200
    finally:
        for one in crowd:
            one.close()


def test_a_stranger_has_little_time(address, monkeypatch):
    monkeypatch.setattr(connections, "STRANGER_S", 0.2)
    with socket.create_connection(("127.0.0.1", port_of(address))) as one:
        one.settimeout(30)
        one.sendall(b"POST /mcp HTTP/1.1\r\n")
        with suppress(ConnectionResetError):
            assert one.recv(100) == b""


def test_a_port_that_is_taken_is_one_line(address):
    with pytest.raises(HriError, match=r"cannot listen on 127\.0\.0\.1:.* - end the program"):
        listening(port_of(address))


def test_only_so_many_requests_are_under_way(bearer):
    async def never(scope, receive, send):
        await trio.sleep_forever()

    async def ask():
        guard, statuses = Guard(never), []
        scope = {
            "type": "http",
            "path": "/mcp",
            "headers": [
                (b"host", b"localhost"),
                (b"authorization", bearer["authorization"].encode()),
            ],
        }

        async def send(message):
            if message["type"] == "http.response.start":
                statuses.append(message["status"])

        async def asking():
            came = iter([{"type": "http.request", "body": b""}])

            async def once():
                for one in came:
                    return one
                await trio.sleep_forever()

            await guard(scope, once, send)

        async with trio.open_nursery() as nursery:
            for _ in range(MOST_REQUESTS + 3):
                nursery.start_soon(asking)
            await trio.testing.wait_all_tasks_blocked()
            nursery.cancel_scope.cancel()
        return statuses

    assert trio.run(ask) == [503] * 3


def test_the_header():
    assert not is_shown("")
