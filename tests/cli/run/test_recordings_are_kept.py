"""Recordings into one folder, by programs that are killed at any moment: none is lost."""

import hashlib
import json
import os
import random
import subprocess
import sys
from contextlib import suppress

import pytest

from hri.core.recorded import ABOUT, FILES

pytestmark = pytest.mark.slow
TRIES = 8
LONGEST = 1.0
"""Seconds that a program is let record at most before it is killed."""
WORDS = (
    *("companion", "--config", "simulated", "--headless", "--captions", "--face", "robot"),
    *("--demo", "--record", "p01"),
)


def contents(folder):
    """A digest of each file below a folder."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return {path: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


def begun(folder, *more):
    command = [sys.executable, "-m", "hri.cli.main", *WORDS, *more]
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def wait(program, seconds):
    with suppress(subprocess.TimeoutExpired):
        program.communicate(timeout=seconds)
        raise AssertionError("it has ended by itself")


def test_no_file_of_an_earlier_recording_changes_whenever_programs_are_killed(tmp_path):
    dice = random.Random(1)
    for number in range(TRIES):
        before, folders = contents(tmp_path), set(tmp_path.iterdir())
        more = ["--fast"] if number % 2 else []  # in real time, too
        two = [begun(tmp_path, *more) for _ in range(2)]
        while len(set(tmp_path.iterdir())) < len(folders) + number % 3:
            wait(two[0], 0.01)  # for none, one, or both to begin
        for program in two:
            wait(program, dice.choice((0.02, LONGEST)) * dice.random())
            program.kill()
            program.communicate()
        now = contents(tmp_path)
        assert {path: now.get(path) for path in before} == before, number
    recordings = [path for path in tmp_path.iterdir() if {*FILES} & {*os.listdir(path)}]
    assert len(recordings) > TRIES / 2
    for folder in recordings:
        told = json.loads((folder / ABOUT).read_text())
        assert (told["folder"], told["app"]) == (str(folder), "companion")
        assert "ended" not in told
