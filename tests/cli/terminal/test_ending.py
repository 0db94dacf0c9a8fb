"""Programs that are asked to end at any moment, and programs whose output cannot be written."""

import os
import select
import signal
import subprocess
import sys
import termios
from contextlib import suppress

import cv2
import pytest
import trio

from hri.cli.terminal.ending import Ending
from hri.cli.terminal.streams import unfailing_output
from hri.core.event_log import read_events
from hri.hal.drivers.wav_file import read_wav

WITHIN = 60.0
"""Seconds in which a program shows something, on a busy computer."""
APP = 'networks = ["face.xml"]\n'
FACE = """<BehaviorNetwork name="face" invocation_interval="1/30">
  <Behavior id="voice" type="Hri.Voice"/>
  <Behavior id="face" type="Hri.Face"/>
  <Behavior id="renderer" type="Hri.FaceRenderer"/>
  <Link from="face.weights" to="renderer.weights"/>
</BehaviorNetwork>
"""
NETWORK = """<BehaviorNetwork>
  <Behavior id="three" type="Hri.Constant"/>
  <Behavior id="show" type="Hri.InputCollector"/>
  <Link from="three.value" to="show.input"/>
</BehaviorNetwork>
"""


@pytest.fixture
def robot(tmp_path):
    """The command of a robot that shows its face and records."""
    (tmp_path / "app.toml").write_text(APP)
    (tmp_path / "face.xml").write_text(FACE)
    command = [sys.executable, "-m", "hri.cli.main", "run", tmp_path, "--config", "simulated"]
    return [*command, "--headless", "--record", tmp_path / "out"]


def is_recorded(folder):
    """Whether a recording has all its parts, and each can be read."""
    film = cv2.VideoCapture(str(folder / "face.mp4"))
    pictures, first = film.get(cv2.CAP_PROP_FRAME_COUNT), film.read()[0]
    read_events(folder / "events.jsonl")
    samples, _ = read_wav(folder / "robot.wav")
    return pictures > 0 and first and len(samples) > 0 and (folder / "timeline.png").exists()


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_robot_that_is_asked_to_end_as_it_begins_leaves_a_whole_recording(
    robot, tmp_path, number
):
    with subprocess.Popen(robot, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        run.stdout.readline()
        run.send_signal(number)
        out, err = run.communicate(timeout=120)
    assert (run.returncode, err) == (0, "")
    assert "recorded in" in out
    assert is_recorded(tmp_path / "out")


@pytest.mark.slow
@pytest.mark.parametrize("out", ["/dev/full", "closed"])
def test_a_robot_goes_on_when_nothing_can_be_printed(robot, tmp_path, out):
    words = [*map(str, robot), "--fast", "--duration", "2"]
    to = ">&-" if out == "closed" else f">{out}"
    run = subprocess.run(
        ["sh", "-c", f'exec "$@" {to}', "sh", *words],
        stderr=subprocess.PIPE,
        text=True,
        timeout=120,
    )
    said = {"closed": ""}.get(out, "output stops: No space left on device - make room\n")
    assert (run.returncode, run.stderr) == (0, said)
    assert is_recorded(tmp_path / "out")


@pytest.mark.parametrize("out", [">/dev/full", ">&-", ">&- 2>&-", "<&- >&- 2>&-"])
def test_a_network_runs_on_when_nothing_can_be_printed(tmp_path, out):
    (tmp_path / "net.xml").write_text(NETWORK)
    command = f"{sys.executable} -m hri.cli.behave net.xml --without-resources --fast"
    run = subprocess.run(
        ["sh", "-c", f"exec {command} --duration 5 {out}"],
        cwd=tmp_path, stderr=subprocess.PIPE, text=True, timeout=120,
    )  # fmt: skip
    assert run.returncode == 0
    assert "Traceback" not in run.stderr
    told = [line for line in run.stderr.splitlines() if not line.startswith("behave: ")]
    assert len(told) <= 1
    assert len(run.stderr.splitlines()) - len(told) <= 1


def test_nothing_is_written_here_when_home_is_no_folder(tmp_path):
    environment = {**os.environ, "HOME": "", "XDG_CONFIG_HOME": "set", "XDG_CACHE_HOME": ""}
    environment.pop("MPLCONFIGDIR", None)
    (tmp_path / "events.txt").write_text("0 praise\n")
    words = ["emotion", "simulate", "--events", "events.txt", "--plot", "plot.png"]
    command = [sys.executable, "-m", "hri.cli.main", *words]
    run = subprocess.run(command, cwd=tmp_path, env=environment, timeout=120, capture_output=True)
    assert (run.returncode, run.stderr) == (0, b"")
    assert sorted(os.listdir(tmp_path)) == ["events.txt", "plot.png"]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_being_asked_to_end_before_anybody_listens_is_remembered(number):
    before = signal.getsignal(number)
    ending = Ending()

    async def live():
        with trio.fail_after(20):
            async with trio.open_nursery() as nursery:
                nursery.start_soon(ending.wait, nursery.cancel_scope.cancel)

    with ending.kept_for_later():
        signal.raise_signal(number)
        trio.run(live)
    assert signal.getsignal(number) == before


def test_driving_by_hand_puts_the_terminal_back_when_it_is_asked_to_end():
    ours, theirs = os.openpty()
    before = termios.tcgetattr(theirs)
    command = [sys.executable, "-m", "hri.cli.main", "drive", "--simulated"]
    shown = b""
    with subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs) as driving:
        while b"x: quit" not in shown and select.select([ours], [], [], WITHIN)[0]:
            shown += os.read(ours, 4096)
        assert termios.tcgetattr(theirs) != before
        driving.send_signal(signal.SIGTERM)
        while driving.poll() is None:  # what nobody reads would hold the program up
            if select.select([ours], [], [], 0.1)[0]:
                shown += os.read(ours, 4096)
    assert driving.returncode == 0
    assert termios.tcgetattr(theirs) == before
    os.close(theirs)
    os.close(ours)


def test_a_program_of_nohup_outlives_its_terminal():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        ending = Ending()
        with ending.kept_for_later():
            signal.raise_signal(signal.SIGHUP)
        assert not ending.is_asked
    finally:
        signal.signal(signal.SIGHUP, before)


def test_a_reader_that_has_gone_is_still_told(monkeypatch):
    reading, writing = os.pipe()
    os.close(reading)
    with open(writing, "w") as out:
        monkeypatch.setattr(sys, "stdout", out)
        with unfailing_output(), pytest.raises(BrokenPipeError):
            print("words", flush=True)
        with suppress(BrokenPipeError):
            out.close()
