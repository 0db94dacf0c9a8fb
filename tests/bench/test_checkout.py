"""What `hri bench` runs from the folder `benchmarks` of a checkout, and says where none is."""

import json

import pytest

from hri.cli.main import main
from hri.core import paths


def test_a_part_of_the_checkout_runs_from_any_folder(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["bench", "drive", "--only", "odometry"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert [row["passed"] for row in told["rows"]] == [True]


@pytest.mark.parametrize("words", ["people", "inputs --only grammar", "vision --only nods"])
def test_without_a_checkout_one_line_says_what_to_do(words, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(paths, "house", lambda: tmp_path)
    assert main(["bench", *words.split()]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "run it in a checkout of hri: make bench OPTIONS=" in line


def test_without_a_checkout_its_own_parts_are_measured_still(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("hri.bench.checkout.has_research", lambda: False)
    assert main(["bench", "drive", "--only", "simulated world", "--quick"]) == 0
    assert json.loads(capsys.readouterr().out)["rows"][0]["unit"] == "times real time"
