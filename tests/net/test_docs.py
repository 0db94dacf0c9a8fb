"""The page of the protocol keeps what it promises."""

import re
import subprocess
import sys

import pytest

from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.core import paths
from hri.net.connection import Connection
from hri.net.malleable_protocol import decode
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
    (program,) = blocks("python")
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
        *("tutorial", "hri", "hri", "event_server"),
    ]


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
