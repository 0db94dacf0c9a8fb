"""`hri fleet`, with robots on the loopback network."""

import json
import signal
import subprocess
import sys
import threading
from contextlib import suppress

import pytest

pytest.importorskip("zenoh", reason="the extra zenoh is not installed")

from hri.cli.main import main
from hri.core.errors import HriError
from hri.core.token import VARIABLE
from hri.net.zenoh.fleet import fleet
from hri.net.zenoh.session import FleetSettings
from tests.net.conftest import WITHIN
from tests.net.zenoh.robots import until


@pytest.fixture(autouse=True)
def own_state(tmp_path, monkeypatch):
    """No robot of the user, or of another test, is here."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.delenv(VARIABLE, raising=False)


@pytest.fixture
def anna(living):
    """A robot that is in the fleet."""
    found = living("anna")
    with fleet(FleetSettings()) as robots:
        assert until(lambda: robots.names() == ["anna"])
    return found


def test_robots_are_listed(anna, capsys):
    assert main(["fleet", "list"]) == 0
    head, row = capsys.readouterr().out.splitlines()
    assert head.split()[:2] == ["robot", "app"]
    assert row.split()[:2] == ["anna", "anna"]
    assert main(["fleet", "list", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["anna"]["networks"] == ["anna"]


def test_where_nobody_is_the_list_says_so(capsys):
    assert main(["fleet", "list"]) == 0
    assert "hri run APP --fleet NAME" in capsys.readouterr().out


def test_robots_are_asked(anna, capsys):
    assert main(["fleet", "stop", "all"]) == 0
    assert capsys.readouterr().out == "anna: done\n"
    assert main(["fleet", "say", "anna", "hello"]) == 1
    assert "anna: no Voice runs" in capsys.readouterr().err
    assert main(["fleet", "run", "anna", "nonsense"]) == 1
    assert "nonsense" in capsys.readouterr().err
    assert main(["fleet", "app", "anna", "companion"]) == 1
    assert "ends with its app" in capsys.readouterr().err
    assert main(["fleet", "stop", "ana"]) == 2
    assert 'no robot "ana"' in capsys.readouterr().err


def apps_of(robots):
    """By robot; one that just ends is left out."""
    found = {}
    for name in robots.names():
        with suppress(HriError):
            found[name] = robots.ask(name, "state", {})["app"]
    return found


def test_another_app_is_run_instead(tmp_path, monkeypatch):
    for name, tasks in (("first", []), ("second", []), ("broken", ["missing"])):
        (tmp_path / "apps" / name).mkdir(parents=True)
        (tmp_path / "apps" / name / "app.toml").write_text(f"networks = []\ntasks = {tasks}\n")
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    command = [
        sys.executable,
        "-m",
        "hri.cli.main",
        "run",
        "first",
        "--headless",
        "--fleet",
        "anna",
    ]
    silent = subprocess.DEVNULL
    with subprocess.Popen(command, stdout=silent, stderr=subprocess.PIPE, text=True) as running:
        try:
            with fleet(FleetSettings()) as robots:
                assert until(lambda: apps_of(robots) == {"anna": "first"})
                for wrong in ("third", "../apps/second", str(tmp_path / "apps" / "second")):
                    with pytest.raises(HriError):
                        robots.ask("anna", "app", {"app": wrong})
                assert apps_of(robots) == {"anna": "first"}
                assert main(["fleet", "app", "anna", "second"]) == 0
            with fleet(FleetSettings()) as robots:
                assert until(lambda: apps_of(robots) == {"anna": "second"})
                assert main(["fleet", "app", "anna", "broken"]) == 0
                assert any("no Python file is there" in line for line in running.stderr)
                assert until(lambda: apps_of(robots) == {"anna": "second"})
        finally:
            running.send_signal(signal.SIGINT)
        assert running.wait(WITHIN) == 0


def test_what_happens_is_printed(anna, capsys):
    over = threading.Event()

    def ask_until_over():
        with fleet(FleetSettings()) as robots:
            while not over.wait(0.05):
                robots.ask("anna", "release", {})

    asking = threading.Thread(target=ask_until_over)
    asking.start()
    assert main(["fleet", "watch", "--event", "fleet.*", "--seconds", "2", "anna"]) == 0
    over.set()
    asking.join()
    first, *_ = map(json.loads, capsys.readouterr().out.splitlines())
    assert (first["robot"], first["event"]) == ("anna", "fleet.asked")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--fleet", "An Na"], "cannot name a robot"),
        (["--fleet", "anna", "--connect", "tcp/10.0.0.1:7447"], "--allow-remote"),
        (["--fleet", "anna", "--fleet-config", "missing.json5"], "missing.json5"),
        (["--fleet", "anna", "--fast"], "real time"),
    ],
)
def test_a_mistake_is_one_line(options, message, capsys):
    assert main(["companion", "--headless", "--duration", "1", *options]) == 2
    assert message in capsys.readouterr().err
