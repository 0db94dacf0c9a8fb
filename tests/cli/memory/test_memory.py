"""`hri memory`: what is remembered of people can be looked at and taken along."""

import json
import stat
from datetime import datetime
from pathlib import Path

import pytest

from hri.cli.main import main
from hri.conversation.memory import Memory
from hri.conversation.memory_file import Contents, keep, people_file
from hri.conversation.relations import Relation
from hri.core.stored_data_index import noted

NOW = datetime(2026, 5, 4, 9, 30)


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def remember(*names: str) -> None:
    memory = Memory({"likes": Relation("likes", "{value}", several=True)})
    for name in names:
        id = memory.introduce(name, NOW, heard=("Z", "OW1", "IY0")).id
        memory.allow(id, NOW, "nod")
        memory.learn(id, "likes", "jazz", NOW, {"kind": "music"})
        memory.feel(id, "joy", "praise", NOW)
        memory.note_asked(id, "likes", "jazz", "How was your jazz evening?")
    keep(people_file(), Contents(memory.remembered, memory.last_id))


def test_everyone_is_listed_in_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["memory", "list"]) == 0
    assert capsys.readouterr().out == "nobody is remembered\n"
    remember("Zoë", "Ben")
    assert main(["memory", "list"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "Ben  met once since 2026-05-04, last 2026-05-04 09:30; 1 fact",
        "Zoë  met once since 2026-05-04, last 2026-05-04 09:30; 1 fact",
    ]


def test_a_list_for_programs(capsys: pytest.CaptureFixture[str]) -> None:
    remember("Anna")
    assert main(["memory", "list", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == [{
        "id": 1, "name": "Anna", "since": "2026-05-04T09:30:00", "seen": "2026-05-04T09:30:00",
        "meetings": 1, "facts": 1,
    }]  # fmt: skip


def test_all_of_a_person_is_shown_and_of_everyone_of_that_name(
    capsys: pytest.CaptureFixture[str],
) -> None:
    remember("Zoë", "Ben", "ZOË")
    assert main(["memory", "show", "zoë"]) == 0
    told = capsys.readouterr().out
    assert told.count("jazz, kind music (2026-05-04 09:30)") == 2
    for text in ("by nod", "Z OW1 IY0", "joy, because of praise", "How was your jazz evening?"):
        assert text in told
    assert "Ben" not in told


def test_who_is_not_remembered_is_told_of_who_is(capsys: pytest.CaptureFixture[str]) -> None:
    remember("Anna")
    assert main(["memory", "show", "Ana"]) == 2
    assert capsys.readouterr().err == ('nobody called "Ana" is remembered - did you mean "Anna"?\n')


def test_an_export_is_its_owners_alone_and_can_be_forgotten(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    remember("Zoë", "Ben")
    assert main(["memory", "export"]) == 0
    printed = capsys.readouterr().out
    assert main(["memory", "export", "mine.json"]) == 0
    file = home / "mine.json"
    assert file.read_text() == printed
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert noted("exports") == [file]
    people = json.loads(printed)["people"]
    assert [person["name"] for person in people] == ["Ben", "Zoë"]
    assert people[1]["facts"][0]["values"] == {"kind": "music"}
    assert people[1]["consent"] == {"when": "2026-05-04T09:30:00", "how": "nod"}
    capsys.readouterr()
    assert main(["forget", "Zoë"]) == 0
    assert f"{file}: an export of the memory of people: Zoë - it stays" in capsys.readouterr().out
    assert main(["forget", "Zoë", "--yes"]) == 0
    assert not file.exists()


@pytest.mark.parametrize("command", [["list"], ["show", "Anna"], ["export"]])
def test_a_file_that_cannot_be_used_is_one_line(
    command: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    people_file().parent.mkdir(parents=True, mode=0o700)
    people_file().write_text("broken")
    people_file().chmod(0o600)
    assert main(["memory", *command]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert people_file().read_text() == "broken"
