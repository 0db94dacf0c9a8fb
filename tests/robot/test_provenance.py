"""What a record of a run has: all that decides it, and no secret."""

import json
import os

import pytest

from hri.core.clock import FakeClock
from hri.robot.provenance import (
    RunRecord,
    Setup,
    authored,
    changed,
    digests,
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


def test_what_has_changed_is_named_also_what_has_come_and_gone(tmp_path):
    sources = [tmp_path / name for name in ("a.txt", "b.txt", "c.txt", "folder", "none")]
    for source in sources[:3]:
        source.write_text("as it was")
    (tmp_path / "folder" / "below").mkdir(parents=True)
    (tmp_path / "folder" / "below" / "app.toml").write_text("as it was")
    before = digests(sources)
    assert changed(before) == []
    (tmp_path / "folder" / "below" / "film.mp4").write_text("of a recording, say")
    (tmp_path / "folder" / "feelings.svg").write_text("of a recording, too")
    assert changed(before) == []
    sources[0].write_text("other")
    sources[1].unlink()
    sources[4].write_text("new")
    (tmp_path / "folder" / "below" / "app.toml").write_text("other")
    assert changed(before) == [str(tmp_path / one) for one in ("a.txt", "b.txt", "folder", "none")]


def test_the_authored_files_of_a_folder_that_is_gone_are_none(tmp_path):
    assert authored(tmp_path / "gone") == []


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
