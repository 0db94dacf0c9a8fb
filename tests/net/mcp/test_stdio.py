"""Over standard input and output: bounded lines, and a real program with the SDK's own client."""

import json
import os
import subprocess
import sys
from contextlib import contextmanager

import anyio
import mcp_types as types
import pytest
import trio
from hypothesis import given, strategies as st
from mcp import Client
from mcp.client.stdio import StdioServerParameters, stdio_client
from mcp.shared.message import SessionMessage

from hri.core import child
from hri.net.mcp.stdio import LONGEST_LINE, MOST_WAITING, Lines, TooLong, Waiting, Wire, streams

MCP = ("-m", "hri.cli.main", "mcp", "--config", "simulated", "--headless")


@pytest.mark.hypothesis
@given(st.lists(st.binary(max_size=30), max_size=20), st.integers(1, 7))
def test_lines_are_the_same_however_they_come(lines, size):
    data = b"".join(line.replace(b"\n", b"") + b"\n" for line in lines)
    whole = list(Lines().feed(data))
    cut, parts = Lines(), []
    for start in range(0, len(data), size):
        parts += cut.feed(data[start : start + size])
    assert parts == whole


def test_a_line_without_an_end_takes_no_memory():
    lines = Lines()
    for _ in range(3 * LONGEST_LINE // 65_536):
        assert not list(lines.feed(b"x" * 65_536))
        assert len(lines._begun) <= LONGEST_LINE
    too_long, after = lines.feed(b"x\n{}\n")
    assert isinstance(too_long, TooLong)
    assert after == b"{}"


def _request(id):
    return types.JSONRPCRequest(jsonrpc="2.0", id=id, method="ping")


def _cancelled(id):
    return types.JSONRPCNotification(
        jsonrpc="2.0", method="notifications/cancelled", params={"requestId": id}
    )


def test_an_id_that_is_in_use_has_no_second_place():
    waiting = Waiting()
    assert waiting.note(_request(1))
    assert not waiting.note(_request("1"))
    waiting.note(_cancelled(1))
    assert waiting.note(_request(1))


@contextmanager
def piped():
    """A wire, and its other ends."""
    there, ours = os.pipe()
    theirs, back = os.pipe()
    try:
        yield Wire(there, back), ours, theirs
    finally:
        for one in (there, theirs, back):
            os.close(one)


async def _tried(messages, fetches):
    """What comes in of some lines, when so many answers are fetched."""
    came = []
    with piped() as (wire, ours, theirs):
        async with (
            streams(wire) as (incoming, outgoing),
            trio.lowlevel.FdStream(ours) as sender,
            trio.open_nursery() as nursery,
        ):
            nursery.start_soon(sender.send_all, b"".join(messages))
            with anyio.move_on_after(0.3):
                async for one in incoming:
                    came.append(one)
                    if len(came) <= fetches:
                        answer = types.JSONRPCResponse(jsonrpc="2.0", id=one.message.id, result={})
                        await outgoing.send(SessionMessage(answer))
            nursery.cancel_scope.cancel()
        told = os.read(theirs, 100_000) if fetches else b""
    return came, told


def test_no_more_is_read_than_is_answered():
    lines = [
        (json.dumps({"jsonrpc": "2.0", "id": n, "method": "ping"}) + "\n").encode()
        for n in range(MOST_WAITING + 20)
    ]
    came, _ = trio.run(_tried, lines, 0)
    assert len(came) == MOST_WAITING
    came, told = trio.run(_tried, lines, 5)
    assert len(came) == MOST_WAITING + 5
    assert told.count(b"\n") == 5


def test_damaged_messages_are_passed_on_as_such():
    lines = [b"{\n", b"\xff\xfe\n", b"[" * 5000 + b"\n", b'{"jsonrpc":"2.0"}\n', b"null\n"]
    came, _ = trio.run(_tried, lines, 0)
    assert len(came) == len(lines)
    assert all(isinstance(one, Exception) for one in came)


def test_all_else_that_is_printed_goes_to_standard_error():
    code = """
import os, subprocess, sys
from hri.net.mcp.stdio import taken
with taken() as wire:
    print("printed", flush=True)
    subprocess.run(["echo", "by a child"])
    os.write(wire.output, b"{}\\n" + os.read(wire.input, 100))
print("after", flush=True)
"""
    run = subprocess.run(
        [*child.command("-c", code)],
        input="asked\n",
        env=child.environment(),
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert run.stdout == "{}\nasked\nafter\n"
    assert "printed" in run.stderr
    assert "by a child" in run.stderr


@pytest.mark.slow
@pytest.mark.parametrize("mode", ["legacy", "auto"])
def test_the_clients_of_the_sdk_ask_a_real_program(tmp_path, mode):
    async def ask():
        server = StdioServerParameters(
            command=sys.executable,
            args=[*MCP, "--allow-speaking"],
            env={**child.environment(), "XDG_STATE_HOME": str(tmp_path)},
        )
        with trio.fail_after(150), open(tmp_path / "err", "w") as err:  # noqa: ASYNC230
            async with Client(stdio_client(server, errlog=err), mode=mode) as client:
                assert client.server_info.name == "hri"
                said = await client.call_tool("say", {"text": "Hello."})
                moved = await client.call_tool("move", {"distance_m": 1})
        return said, moved

    said, moved = trio.run(ask)
    assert said.content[0].text == "said"
    assert moved.is_error
    told = (tmp_path / "err").read_text()
    assert "Hello. (mcp)" in told
    assert "Traceback" not in told


@pytest.mark.slow
def test_it_ends_with_who_started_it(tmp_path):
    run = subprocess.run(
        child.command(*MCP),
        input="not json\n",
        env=child.environment(XDG_STATE_HOME=str(tmp_path)),
        capture_output=True,
        text=True,
        timeout=150,
    )
    assert run.returncode == 0, run.stderr
    assert all(json.loads(line) for line in run.stdout.splitlines())
