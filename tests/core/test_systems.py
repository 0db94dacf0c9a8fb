"""On Windows faces and grammars work, and all else says in a line where it does."""

import json
import subprocess
import sys
from pathlib import Path

import cv2
import pytest

from hri.cli.main import POSIX_ONLY
from hri.core import open_files, writing
from hri.core.systems import require_posix

HOUSE = Path(__file__).parents[2]


def on_windows(commands):
    """What the class Robot says, and what each command does, in a Windows of its own."""
    run = subprocess.run(
        [sys.executable, "-m", "tests.core.windows"],
        input="".join(json.dumps(words) + "\n" for words in commands),
        capture_output=True,
        text=True,
        cwd=HOUSE,
        timeout=100,
    )
    assert run.returncode == 0, run.stderr
    robot, *answers = map(json.loads, run.stdout.splitlines())
    return robot, answers


@pytest.mark.slow
def test_windows_has_faces_and_grammars_and_a_line_for_the_rest(tmp_path):
    picture = tmp_path / "happy.png"
    bad = tmp_path / "bad.jsgf"
    bad.write_text("#JSGF V1.0; grammar bad; public <a> = <b>;")
    working = [
        ["face", "list"],
        ["face", "check", "robot"],
        ["face", "render", "--face", "robot", "--expression", "happy", "--out", str(picture)],
        ["face", "render", "--face", "robot", "--out", str(picture)],
        ["face", "sheet", "--face", "robot", "--out", str(tmp_path / "sheet.png")],
        ["grammar", "check", "companion"],
        ["grammar", "parse", "companion", "go forward two meters"],
        ["grammar", "expand", "companion", "--count"],
        ["grammar", "pronounce", "hello"],
        ["emotion", "check"],
        ["--version"],
    ]
    missing = [[name] for name in sorted(POSIX_ONLY)]
    robot, answers = on_windows([*working, *missing, ["grammar", "check", str(bad)], []])
    assert robot == (
        "NotAvailable: a robot does not run on Windows - run it in WSL (`wsl --install`);"
        " faces and grammars work here"
    )
    for words in working:
        assert (answer := answers.pop(0))["status"] == 0, (words, answer)
    assert cv2.imread(str(picture)) is not None
    for (name,) in missing:
        answer = answers.pop(0)
        assert answer["status"] == 2
        assert answer["out"] == ""
        assert answer["err"].startswith(f"hri {name} does not run on Windows - run it in WSL")
        assert answer["err"].count("\n") == 1
    assert answers[0]["status"] == 2
    assert "bad.jsgf:1:" in answers[0]["err"] + answers[0]["out"]
    assert answers[1]["out"].splitlines()[-1].startswith("Not on Windows: bench, companion")


def test_elsewhere_nothing_is_refused():
    require_posix("hri companion")


@pytest.mark.parametrize("content", [b"new", b""])
def test_a_file_that_must_not_be_open_is_closed_before_it_gets_its_name(
    tmp_path, monkeypatch, content
):
    monkeypatch.setattr(writing, "MAY_RENAME_OPEN", False)
    path = tmp_path / "file"
    path.write_bytes(b"old")
    handles = []
    make, replace = writing._made_beside, writing.os.replace

    def made(*arguments):
        handle, new = make(*arguments)
        handles.append(handle)
        return handle, new

    def replaced(new, target):
        with pytest.raises(OSError, match="Bad file descriptor"):
            writing.os.fstat(handles[-1])
        replace(new, target)

    monkeypatch.setattr(writing, "_made_beside", made)
    monkeypatch.setattr(writing.os, "replace", replaced)
    with writing.replacing(path) as new:
        new.write_bytes(content)
    assert path.read_bytes() == content
    with pytest.raises(ZeroDivisionError), writing.replacing(path) as new:
        raise ZeroDivisionError
    assert path.read_bytes() == content
    assert [file.name for file in tmp_path.iterdir()] == ["file"]


def test_a_file_is_locked_for_one_program(tmp_path):
    with (tmp_path / "file").open("w") as first, (tmp_path / "file").open() as second:
        open_files.lock(first.fileno())
        with pytest.raises(BlockingIOError):
            open_files.lock(second.fileno(), is_shared=True)
