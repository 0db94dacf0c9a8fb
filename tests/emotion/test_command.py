import json
from pathlib import Path

import pytest

from hri.cli.main import main

VISIT = """
# seconds stimulus intensity
10 praise 1
0 person_seen
40 scold 0.5
"""


@pytest.fixture
def visit(tmp_path: Path) -> Path:
    path = tmp_path / "visit.txt"
    path.write_text(VISIT, encoding="utf-8")
    return path


def test_check_finds_the_shipped_files_fine(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["emotion", "check"]) == 0
    assert "warning" not in capsys.readouterr().out


def test_check_reports_every_wrong_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    folder = tmp_path / "emotions" / "personalities"
    folder.mkdir(parents=True)
    (folder / "odd.toml").write_text("gain = 1\n", encoding="utf-8")
    (folder / "broken.toml").write_text("[baseline\n", encoding="utf-8")
    assert main(["emotion", "check"]) == 2
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 2
    assert "broken.toml:1:" in lines[0]
    assert "odd.toml:1:1" in lines[1]


def test_list_names_what_there_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["emotion", "list"]) == 0
    text = capsys.readouterr().out
    assert all(word in text for word in ("optimist", "battery_low", "disgust"))


def test_simulate_prints_a_state_for_each_event_and_time(
    visit: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["emotion", "simulate", "--personality", "optimist", "--events", str(visit)]
    assert main([*words, "--at", "5,120", "--json"]) == 0
    states = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [state["t"] for state in states] == [0, 5, 10, 40, 120]
    assert states[2]["label"] == "joy"
    assert states[2]["why"][0]["cause"] == "praise"
    assert set(states[0]) == {
        "t", "label", "pleasure", "arousal", "dominance", "emotions", "why",
    }  # fmt: skip
    assert main(words) == 0
    assert "praise 79%, person_seen 21%" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("1 prase 1", 'no stimulus "prase" - did you mean "praise"?'),
        ("soon praise 1", '"soon" is no time'),
        ("1 praise 2", '"2" is no intensity'),
        ("1 praise nan", '"nan" is no intensity'),
        ("praise", "1 words"),
    ],
)
def test_a_wrong_event_is_refused_with_its_place(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], line: str, what: str
) -> None:
    path = tmp_path / "wrong.txt"
    path.write_text(f"0 praise 1\n{line}\n", encoding="utf-8")
    assert main(["emotion", "simulate", "--events", str(path)]) == 2
    error = capsys.readouterr().err
    assert f"{path}:2:1: {what}" in error
