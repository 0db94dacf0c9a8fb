"""What was recorded is repeated from its record, to the last byte, wherever and after whatever."""

import json
import os
import re

import numpy as np
import pytest

from hri.cli.main import main
from hri.core import paths
from hri.core.event_log import read_events
from hri.core.recorded import ABOUT, STREAMS
from hri.emotion.persistence import memory_file
from hri.hal.drivers.wav_file import write_wav

FACE = """<BehaviorNetwork name="face" invocation_interval="1/30">
  <Behavior id="voice" type="Hri.Voice"/>
  <Behavior id="emotion" type="Hri.EmotionModel"/>
  <Behavior id="face" type="Hri.Face"/>
  <Behavior id="renderer" type="Hri.FaceRenderer"/>
  <Link from="face.weights" to="renderer.weights"/>
</BehaviorNetwork>
"""
TASKS = """
from hri.robot import verbs

async def greet(context):
    await verbs.feel(context, "praise", person="Anna")
    await verbs.say(context, "Hello.")
"""
SMALL = """<Resources><Devices>
  <Device id="screen" type="Hri.OffscreenScreen">
    <Parameter name="width" value="80"/><Parameter name="height" value="60"/>
  </Device>
  <Device id="speaker" type="Hri.SilentSpeaker"/>
  <Device id="voice" type="Hri.SilentVoice"/>
</Devices></Resources>
"""


@pytest.fixture
def lab(tmp_path, monkeypatch):
    """A folder with an app and a sound, in which a study is made."""
    lab = tmp_path / "lab"
    (lab / "mine").mkdir(parents=True)
    (lab / "mine" / "app.toml").write_text('networks = ["face.xml"]\ntasks = ["greet"]\n')
    (lab / "mine" / "__init__.py").touch()
    (lab / "mine" / "tasks.py").write_text(TASKS)
    (lab / "mine" / "face.xml").write_text(FACE)
    (lab / "small.xml").write_text(SMALL)
    write_wav(lab / "me.wav", np.zeros(8000, np.int16), 16000)
    monkeypatch.chdir(lab)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    return lab


def recorded(*options, app="./mine", to="p01"):
    plain = ("--config", "small.xml", "--fast", "--duration", "1.5", "--record", to)
    assert main(["run", app, *plain, *options]) == 0


def record_of(folder):
    return json.loads((folder / ABOUT).read_text())


def require_equal(one, two):
    for name in STREAMS:
        assert (one / name).read_bytes() == (two / name).read_bytes(), name


def test_a_run_is_repeated_byte_for_byte_from_another_folder(lab, tmp_path, monkeypatch, capsys):
    recorded("--seed", "7", "--audio", "me.wav")
    monkeypatch.chdir(tmp_path)
    assert main(["run", "--repeat", "lab/p01", "--record", "again"]) == 0
    require_equal(lab / "p01", tmp_path / "again")
    assert "differ" not in capsys.readouterr().out
    assert main(["companion", "--repeat", "again", "--record", "again"]) == 0  # from a repetition
    require_equal(lab / "p01", tmp_path / "again-2")
    assert os.getcwd() == str(tmp_path)


def test_the_environment_is_that_of_the_run(lab, tmp_path, monkeypatch, capsys):
    own = lab / "own" / "emotions" / "personalities"
    own.mkdir(parents=True)
    neutral = paths.find("emotions", "personalities/neutral").read_text()
    (own / "mine.toml").write_text(neutral)
    monkeypatch.setenv("HRI_PATH", "own")
    monkeypatch.setenv("HRI_TOKEN", "a-token-nobody-may-read")
    recorded("--personality", "mine")
    monkeypatch.delenv("HRI_PATH")
    assert main(["run", "--repeat", "p01", "--record", "p02"]) == 0
    require_equal(lab / "p01", lab / "p02")
    assert "HRI_PATH" not in os.environ
    assert record_of(lab / "p02")["environment"]["HRI_PATH"] == "own"
    assert all(b"a-token-nobody" not in f.read_bytes() for f in (lab / "p01").iterdir())
    (own / "mine.toml").write_text(neutral + "\n")
    capsys.readouterr()
    assert main(["run", "--repeat", "p01"]) == 0
    line = f"{lab / 'own' / 'emotions'} has changed - the run may differ from the recorded one"
    assert line in capsys.readouterr().out.splitlines()


@pytest.mark.slow
def test_it_begins_with_the_same_feelings_and_leaves_those_of_today_alone(lab):
    recorded("--keep", to="before")
    recorded("--keep", to="p01")
    recorded("--keep", to="later")
    today = memory_file().read_bytes()
    assert read_events(lab / "p01" / "events.jsonl") != read_events(lab / "before" / "events.jsonl")
    for name in ("before", "p01"):
        assert main(["run", "--repeat", name, "--record", f"{name}-again"]) == 0
        require_equal(lab / name, lab / f"{name}-again")
    assert memory_file().read_bytes() == today


def test_what_is_no_longer_as_it_was_is_named(lab, capsys):
    recorded("--audio", "me.wav")
    (lab / "mine" / "tasks.py").write_text(TASKS + "\n")
    write_wav(lab / "me.wav", np.ones(8000, np.int16), 16000)
    told = record_of(lab / "p01")
    (lab / "p01" / ABOUT).write_text(json.dumps({**told, "version": "0.0.1", "clock": "real"}))
    capsys.readouterr()
    assert main(["run", "--repeat", "p01"]) == 0
    lines = re.findall(r"(.*) - the run may differ from the recorded one", capsys.readouterr().out)
    assert lines == [
        "it ran in real time",
        f"it was recorded with hri 0.0.1, and this is {told['version']}",
        *(f"{lab / name} has changed" for name in ("me.wav", "mine/tasks.py")),
    ]


@pytest.mark.parametrize(
    ("text", "options", "complaint"),
    [
        (None, [], "p01: recorded by an earlier version, without a recording.json - start it"),
        ("{", [], "recording.json: not JSON"),
        ("[]", [], "recording.json: not a record of a run - name another"),
        ('{"command": ["python", "a.py"]}', [], "not a run of `hri run` - start it again with"),
        ('{"command": ["hri", "run", "mine"]}', [], "the record lacks its folder or environment"),
        ('{"command": ["hri", "run", "mine"]}', ["--seed", "8"], "--repeat takes --seed from the"),
        (
            '{"command": ["hri", "run", "mine"], "cwd": "/no", "environment": {}}',
            [],
            "/no: it ran in this folder, which is gone - create it",
        ),
    ],
)
def test_what_cannot_be_repeated_is_refused_in_a_line(lab, capsys, text, options, complaint):
    (lab / "p01").mkdir()
    (lab / "p01" / "events.jsonl").touch()
    if text is not None:
        (lab / "p01" / ABOUT).write_text(text)
    assert main(["run", "--repeat", "p01", *options]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert complaint in line


def test_a_run_needs_an_app_or_a_recording(capsys):
    assert main(["run"]) == 2
    assert capsys.readouterr().err == "no app - name one, such as companion\n"
