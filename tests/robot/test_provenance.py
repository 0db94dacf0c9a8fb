"""What a record of a run has: all that decides it, and no secret."""

import json
import os

import pytest

from hri.core.clock import FakeClock
from hri.robot.provenance import (
    RunRecord,
    Setup,
    environment,
    without_secrets,
)

SETUP = Setup("1.0", 0, "companion", None, "simulated")


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("hri run . --record p01 --seed 7", None),
        ("python a.py --token abc --seed 7", "python a.py --token *** --seed 7"),
        ("python a.py --api-key=abc", "python a.py --api-key=***"),
        ("python a.py --password --seed 7", None),
        (
            "python a.py http://h/?code=a1&b=2#token=x",
            "python a.py http://h/?code=***&b=2#token=***",
        ),
        ("python a.py rtsp://me:pw@cam/1", "python a.py rtsp://me:***@cam/1"),
    ],
)
def test_a_command_line_is_told_without_secrets(command, told):
    assert " ".join(without_secrets(command.split())) == (told or command)


def test_the_environment_has_what_decides_a_run_and_no_token(monkeypatch):
    for name in [name for name in os.environ if name.startswith(("HRI_", "XDG_"))]:
        monkeypatch.delenv(name)
    for name in ("HRI_TOKEN", "HRI_CLOUD_API_KEY", "HRI_LEXICON", "XDG_DATA_HOME", "PATH"):
        monkeypatch.setenv(name, "/x")
    assert environment() == {"HRI_LEXICON": "/x", "XDG_DATA_HOME": "/x"}


@pytest.mark.parametrize("text", [None, "{", "[" * 10_000])
def test_feelings_that_cannot_be_read_are_none(tmp_path, text):
    file = tmp_path / "feelings.json"
    if text is not None:
        file.write_text(text)
    told = json.loads(RunRecord(SETUP, FakeClock(), ["hri"], feelings=file).text(tmp_path))
    assert told["feelings"] is None


def test_any_name_that_a_system_allows_can_be_told(tmp_path):
    name = os.fsdecode(b"caf\xe9 \xf0\x9f\xa4\x96")
    text = RunRecord(SETUP, FakeClock(), ["hri", "run", name]).text(tmp_path)
    assert json.loads(text.encode())["command"] == ["hri", "run", name]
