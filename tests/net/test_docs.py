"""The page of the protocol keeps what it promises."""

import re
import subprocess
import sys

import pytest

from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.core import paths
from hri.core.token import Challenge, own_token, proof
from hri.net.connection import Connection
from hri.net.control import said
from hri.net.malleable_protocol import decode
from hri.net.server import Server
from hri.testing import context
from tests.net.conftest import WITHIN, Taken

PAGE = (paths.house() / "docs" / "bridge.md").read_text()


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)


@pytest.fixture
def server():
    network = load_network(paths.find("config", "networks/server.xml"))
    network["server"].set_parameter("tcp_port", 0)
    runner = Runner(network, context())
    runner.start()
    yield runner
    runner.stop()


@pytest.fixture
def heard(server):
    taken = Taken()
    server.network["server"]._link.subscribe("tutorial", taken)
    return taken


def test_the_line_for_netcat_works_as_told(server, heard, capsys):
    (line,) = re.findall("echo '(.*)'", PAGE)
    with Connection(port=server.network["server"].port_in_use, timeout=WITHIN) as connection:
        connection.send(line)
        heard.wait_for(1)
        server.tick(0.0)
        assert f"`{connection.read()}`" in PAGE
    assert f"`{capsys.readouterr().out.strip()}`" in PAGE


@pytest.mark.proves("W11")
def test_the_program_runs_as_it_is(server, heard, tmp_path):
    _, program = blocks("python")
    assert len(program.splitlines()) <= 17
    script = tmp_path / "client.py"
    script.write_text(program)
    port = str(server.network["server"].port_in_use)
    process = subprocess.Popen(
        [sys.executable, script, "127.0.0.1", port], stdout=subprocess.PIPE, text=True
    )
    assert server.network["server"]._link.wait_for_peers(1, WITHIN)
    texts = []
    server.tick(0.0)
    texts.append(server.network["server"].text.value)  # what the program says may be there already
    assert process.communicate(timeout=WITHIN)[0] == "number is 5.0\n"
    heard.wait_for(1)
    server.tick(0.1)
    texts.append(server.network["server"].text.value)
    assert "that's < 6 & > 4" in texts


def test_the_messages_on_the_page_are_messages():
    messages = [block for block in blocks("xml") if "BehaviorSchema" not in block]
    assert [decode(block.encode()).tag for block in messages] == [
        *("tutorial", *["hri"] * 5, "event_server"),
    ]


def test_the_lines_that_prove_the_token_are_right():
    lines = [decode(block.encode()) for block in blocks("xml") if block.startswith("<hri>")]
    hello, asked, proven = lines[2:]
    (told,) = (text for text in blocks("text") if text.startswith("hri client"))
    said_by = (said(hello, "hello"), said(asked, "challenge"), said(asked, "ends"))
    challenge = Challenge(*said_by)
    (token,) = re.findall(r"with the token `(\S+)`", PAGE)
    assert told.strip() == f"hri client {challenge.ends} {challenge.client} {challenge.server}"
    assert said(asked, "proof") == proof(token, "server", challenge)
    assert said(proven, "proof") == proof(token, "client", challenge)


@pytest.mark.parametrize("is_known", [True, False])
def test_the_program_that_proves_the_token_steers(is_known, tmp_path):
    proving, _ = blocks("python")
    script = tmp_path / "steer.py"
    script.write_text(proving)
    token = own_token() if is_known else "another-one-that-is-wrong"
    server, taken = Server("127.0.0.1", 0), Taken()
    server.subscribe("steering", taken)
    try:
        words = [sys.executable, script, "127.0.0.1", str(server.port)]
        done = subprocess.run(words, input=token, capture_output=True, text=True, timeout=WITHIN)
        if is_known:
            assert (done.returncode, done.stderr) == (0, "")
            assert taken.wait_for(1)[0].sender.grant.holds
        else:
            assert done.stderr == "the program that listens there does not know the token\n"
    finally:
        server.close()


def test_the_schema_on_the_page_makes_a_behavior(tmp_path, monkeypatch):
    from hri.behavior.catalog import find_behavior

    (schema,) = (block for block in blocks("xml") if "BehaviorSchema" in block)
    folder = tmp_path / "behavior" / "My"
    folder.mkdir(parents=True)
    (folder / "Steering.xml").write_text(schema)
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    cls = find_behavior("My.Steering")
    cls("steering").check()
    for name in cls.parameters:
        assert f"| `{name}` |" in PAGE
