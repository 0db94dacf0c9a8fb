"""The blocks of docs/memory.md work, one after the other."""

import re
from pathlib import Path

import pytest

from hri.cli.main import main
from hri.conversation import (
    MEETING_GAP,
    fact_of,
    load_relations,
    memory,
    people_file,
    remembered_by,
)
from hri.conversation.facts import LONGEST_TEXT
from hri.conversation.people import MOST_FACTS
from hri.conversation.remains import SHORTEST
from hri.core import paths
from hri.speech.grammar import load_grammar, parse

PAGE = (paths.house() / "docs" / "memory.md").read_text(encoding="utf-8")
BLOCKS = dict(re.findall(r"^```(\w+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL))


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files of the page."""
    for name in ("CONFIG", "CACHE", "STATE", "DATA"):
        monkeypatch.setenv(f"XDG_{name}_HOME", str(tmp_path / name.lower()))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "memory.toml").write_text(BLOCKS["toml"])
    (tmp_path / "knowing.jsgf").write_text(BLOCKS["jsgf"])
    return tmp_path


def test_the_program_remembers_and_the_commands_show_and_forget(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    exec(compile(BLOCKS["python"], "docs/memory.md", "exec"), {})
    assert capsys.readouterr().out == "You like jazz. Your birthday is May third.\n"
    said = {}
    for line in BLOCKS["sh"].splitlines():
        command = line.partition("#")[0].split()
        assert main(command[1:]) == 0, line
        said[" ".join(command[1:3])] = capsys.readouterr().out
    assert "Anna  met once" in said["memory list"]
    assert "May third, date --05-03" in said["memory show"]
    assert "mine.json: an export of the memory of people: Anna - it stays" in said["forget Anna"]
    assert main(["forget", "--yes"]) == 0
    left = {file.name for file in home.rglob("*") if file.is_file()}
    assert left <= {"memory.toml", "knowing.jsgf"}


def test_the_grammar_gives_facts_of_the_relations(home: Path) -> None:
    relations = load_relations([home / "memory.toml"])
    assert list(relations) == ["likes", "sister", "birthday"]
    grammar = load_grammar(home / "knowing.jsgf")
    remembered = remembered_by(grammar.rules, relations)
    assert remembered == {"likes": "likes", "birthday": "birthday"}
    told = {
        "i love long walks": ("long walks", {}),
        "my birthday is on may third": ("May third", {"date": "--05-03"}),
    }
    for sentence, fact in told.items():
        found = parse(grammar, sentence)
        assert found is not None
        assert fact_of(remembered[found.rule], found.tags) == fact


def test_the_figures_of_the_page_are_those_of_the_program() -> None:
    most = (memory.MOST_PEOPLE, MOST_FACTS, memory.MOST_VALUES, LONGEST_TEXT)
    assert "{} people, {} facts each, {} of one relation, {} characters".format(*most) in PAGE
    assert f"fewer than {SHORTEST} letters" in PAGE
    assert MEETING_GAP.total_seconds() == 1800
    assert people_file().name in PAGE


def test_the_links_of_the_page_lead_somewhere() -> None:
    for link in re.findall(r"\]\(([\w./]+)", PAGE):
        assert (paths.house() / "docs" / link).exists(), link
