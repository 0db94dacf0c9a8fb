"""The examples of docs/emotions.md are what the page says they are."""

import re
from pathlib import Path

import pytest

from hri.cli.emotion import COMMANDS
from hri.cli.emotion.stimulus_timeline import read_timeline
from hri.core import paths
from hri.emotion.display import display_path, load_display
from hri.emotion.personality import load_personality
from hri.emotion.reachability import unmet_expectations
from hri.emotion.stimulus import load_stimuli

PAGE = (paths.house() / "docs" / "emotions.md").read_text(encoding="utf-8")


def example(beginning: str) -> str:
    """The example of TOML that holds a line."""
    blocks = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    return next(block for block in blocks if beginning in block)


def test_the_personality_loads(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(example("[negative]"), encoding="utf-8")
    assert load_personality(str(path)).expressiveness == 0.7


def test_the_stimulus_keeps_what_it_promises(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    path = tmp_path / "emotions" / "stimuli" / "mine.toml"
    path.parent.mkdir(parents=True)
    path.write_text(example("[stimulus.tickled]"), encoding="utf-8")
    stimuli = load_stimuli()
    assert stimuli["tickled"].intensity({"pressure": 2.5}) == 0.5
    assert len(stimuli["tickled"].expects) == 1
    assert list(unmet_expectations(stimuli)) == []


def test_the_timelines_load(tmp_path: Path) -> None:
    toml = tmp_path / "day.toml"
    toml.write_text(example('goal = "exam"'), encoding="utf-8")
    assert [event.time for event in read_timeline(toml, load_stimuli())] == [20, 30, 40, 50]
    lines = re.search(r"```text\n(0  person_seen\n.*?)```", PAGE, re.DOTALL)
    assert lines is not None
    text = tmp_path / "visit.txt"
    text.write_text(lines.group(1), encoding="utf-8")
    assert [event.person for event in read_timeline(text, load_stimuli())] == [None, "Anna", None]


def test_the_display_rules_load(tmp_path: Path) -> None:
    house = display_path().read_text(encoding="utf-8")
    path = tmp_path / "display.toml"
    path.write_text(house + example("[rules.polite]").replace("polite", "kind"), encoding="utf-8")
    assert load_display(path).rules["kind"]["disappointment"].show == "joy"


def test_every_command_is_told() -> None:
    assert all(f"hri emotion {name}" in PAGE for name in COMMANDS)
