"""`hri mcp`: its bearer, what it refuses, and that nothing of it is there while it is off."""

import os
import socket
import stat
import subprocess
from contextlib import closing

import pytest

from hri.cli.main import main
from hri.core import child
from hri.core.token import own_token, token_file
from hri.net.mcp.bearer import BEARER


@pytest.fixture(autouse=True)
def own_state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    monkeypatch.delenv("HRI_TOKEN", raising=False)


def test_the_bearer_is_made_once_replaced_and_revoked(capsys):
    assert main(["mcp", "token"]) == 0
    first = capsys.readouterr().out.strip()
    assert len(first) > 40
    assert stat.S_IMODE(BEARER.path.stat().st_mode) == 0o600
    main(["mcp", "token"])
    assert capsys.readouterr().out.strip() == first
    main(["mcp", "token", "--new"])
    second = capsys.readouterr().out.strip()
    assert second != first
    assert BEARER.is_shown(second)
    main(["mcp", "token", "--revoke"])
    told = capsys.readouterr()
    assert (told.out, told.err) == ("", "revoked - hri mcp token makes another one\n")
    assert not BEARER.path.exists()
    main(["mcp", "token", "--revoke"])
    assert capsys.readouterr().err == "there was no bearer\n"


def test_it_is_not_the_token_of_the_robot(capsys):
    main(["mcp", "token"])
    bearer = capsys.readouterr().out.strip()
    token = own_token()
    assert token_file() != BEARER.path
    assert token != bearer
    assert not BEARER.is_shown(token)


def test_a_bearer_that_others_may_read_is_not_used(capsys):
    BEARER.new()
    BEARER.path.chmod(0o644)
    assert main(["mcp", "token"]) == 2
    assert "others may read" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--fast"], "--fast: an assistant is there in real time - leave it out"),
        (["--demo"], "--demo: an assistant is there in real time - leave it out"),
        (["--new"], "--new is about the bearer - write hri mcp token --new"),
    ],
)
def test_what_does_not_go_together_is_one_line(words, told, capsys):
    assert main(["mcp", *words]) == 2
    assert told in capsys.readouterr().err


def test_a_port_that_is_taken_is_one_line(capsys):
    with closing(socket.create_server(("127.0.0.1", 0))) as taken:
        port = taken.getsockname()[1]
        assert main(["mcp", "--http", str(port)]) == 2
    told = capsys.readouterr().err
    assert told.startswith(f"hri: cannot listen on 127.0.0.1:{port}: ") or f":{port}: " in told


def _run(code):
    run = subprocess.run(
        child.command("-c", code),
        env=child.environment(),
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert run.returncode == 0, run.stderr
    return run


def test_without_the_package_it_says_how_to_get_it():
    code = """
import sys
sys.modules["mcp"] = None
from hri.cli.main import main
assert main(["mcp"]) == 2
"""
    run = _run(code)
    assert run.stdout == ""
    (line,) = run.stderr.splitlines()
    assert line.endswith("the package mcp is missing - pip install 'hri[mcp]' installs it")


def test_switched_off_it_costs_nothing(tmp_path):
    code = """
import os, sys, threading
from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.robot import Robot
import hri.cli.run, hri.net, hri.net.malleable
devices = [Description("screen", "Hri.OffscreenScreen"), Description("voice", "Hri.SilentVoice")]
robot = Robot("companion", "simulated", clock=FakeClock(), devices=devices, notice=len)
async def live(context):
    await context.clock.sleep(2)
    robot.finish()
robot.live_until_over(*robot.app.load_tasks(), live)
ours = ("mcp", "hri.net.mcp", "hri.cli.mcp")
print([name for name in sys.modules if name.startswith(ours)])
print([thread.name for thread in threading.enumerate() if "mcp" in thread.name])
"""
    before = sorted(os.listdir(tmp_path))
    assert _run(code).stdout.splitlines() == ["[]", "[]"]
    assert sorted(os.listdir(tmp_path)) == before
