"""`--service`: what systemd starts waits for devices, has no visitor, and lives on."""

import argparse
import math
import shutil
import signal
import subprocess
import sys
from configparser import RawConfigParser
from pathlib import Path

import pytest

from hri.cli import run
from hri.cli.main import main
from hri.cli.run import Session, add_options
from hri.cli.run.narrator import Narrator
from hri.cli.terminal.ending import Ending
from hri.core.clock import FakeClock
from hri.core.errors import HriError, NotAvailable
from hri.robot import Robot

PAGE = Path(__file__).parents[3] / "docs" / "installing.md"


def options_of(*words):
    parser = argparse.ArgumentParser()
    add_options(parser)
    options = parser.parse_args(words)
    options.app = "companion"
    return options


@pytest.fixture
def deaf():
    """A robot without any device: simulated ones stand in, and a visit is written for it."""
    robot = Robot(clock=FakeClock(), notice=lambda _: None)
    for id in run.SENSES:
        robot.resources.obtain(id, run.Resource)
    assert robot.resources.stand_in_of("microphone") is not None
    yield robot
    robot.close()


@pytest.mark.parametrize(("words", "has_visitor"), [((), True), (("--service",), False)])
def test_a_service_has_no_visitor_and_no_end(deaf, words, has_visitor):
    session = Session(deaf, options_of(*words), Narrator(deaf), Ending())
    with pytest.raises(StopIteration):
        session.prepare(deaf.context).send(None)
    assert (session.visit is not None) == has_visitor
    assert math.isinf(session._end_time()[0]) != has_visitor


def test_a_duration_ends_a_service(deaf):
    session = Session(deaf, options_of("--service", "--duration", "7"), Narrator(deaf), Ending())
    assert session._end_time() == (7.0, "the duration was over")


@pytest.mark.parametrize("other", ["--demo", "--fast"])
def test_what_makes_no_sense_with_it_is_refused(other, capsys):
    assert main(["companion", "--service", other]) == 2
    remedy = "a service meets real people in real time - leave out one of the two"
    assert capsys.readouterr().err == f"--service {other}: {remedy}\n"


def test_it_begins_again_until_all_is_there_that_it_cannot_do_without(monkeypatch, capsys):
    lacking = ["no base", "no base", "no other", "no base"]

    def begin(options, ending, notice):
        notice("no camera (waiting for it)")
        if lacking:
            raise NotAvailable(f"{lacking.pop(0)} - plug it in")
        return 0

    monkeypatch.setattr(run, "_run", begin)
    monkeypatch.setattr(run, "BEGIN_AGAIN", 0.0)
    assert main(["companion", "--service"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "no camera (waiting for it)",
        "no base - plug it in (waiting for it)",
        "no other - plug it in (waiting for it)",
    ]


def test_a_mistake_is_not_waited_for(monkeypatch):
    def begin(options, ending, notice):
        raise HriError("a mistake - mend it")

    monkeypatch.setattr(run, "_run", begin)
    assert main(["companion", "--service"]) == 2


def test_it_ends_while_it_waits_when_it_is_asked_to(monkeypatch):
    def begin(options, ending, notice):
        signal.raise_signal(signal.SIGTERM)
        raise NotAvailable("no base - plug it in")

    monkeypatch.setattr(run, "_run", begin)
    assert main(["companion", "--service"]) == 0


@pytest.mark.slow
def test_without_devices_it_lives_until_it_is_asked_to_end(tmp_path):
    words = ["companion", "--service", "--headless"]
    command = [sys.executable, "-m", "hri.cli.main", *words]
    told = []
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=tmp_path
    ) as service:
        for line in service.stdout:
            told.append(line)
            if line.startswith("ready"):
                service.terminate()
    assert service.returncode == 0
    assert any(line.startswith("ready") for line in told), told
    assert not [line for line in told if "simulated" in line or "visit" in line], told


def unit():
    """The unit of the page, as text."""
    lines = PAGE.read_text().splitlines()
    begin = lines.index("    [Unit]")
    return "\n".join(
        line[4:] for line in lines[begin : lines.index("    WantedBy=default.target") + 1]
    )


def test_the_unit_of_the_page_starts_again_and_has_a_display():
    parser = RawConfigParser()
    parser.optionxform = str
    parser.read_string(unit())
    service = parser["Service"]
    assert service["Restart"] == "always"
    assert parser["Unit"]["StartLimitIntervalSec"] == "0"
    assert service["ExecStart"].endswith("/.venv/bin/hri companion --service")
    assert service["Environment"] == "SDL_VIDEODRIVER=kmsdrm"
    options_of(*service["ExecStart"].split()[2:])


@pytest.mark.skipif(shutil.which("systemd-analyze") is None, reason="no systemd here")
def test_the_unit_of_the_page_is_one_that_systemd_takes(tmp_path):
    program = tmp_path / "hri" / ".venv" / "bin" / "hri"
    program.parent.mkdir(parents=True)
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    path = tmp_path / "hri.service"
    path.write_text(unit().replace("%h", str(tmp_path)))
    checked = subprocess.run(
        ["systemd-analyze", "verify", "--user", "--man=no", str(path)],
        capture_output=True,
        text=True,
        env={"HOME": str(tmp_path), "XDG_RUNTIME_DIR": str(tmp_path), "PATH": "/usr/bin:/bin"},
        timeout=60,
    )
    complaints = [line for line in checked.stderr.splitlines() if "hri" in line]
    assert (complaints, checked.returncode) == ([], 0), checked.stderr
