"""The file of remembered people: it comes back, and what is forgotten leaves no byte."""

import os
import sqlite3
import stat
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.conversation.facts import LONGEST_TEXT, MOST_TAGS
from hri.conversation.memory import LONGEST_QUESTION, MOST_PEOPLE, Memory
from hri.conversation.memory_file import (
    LARGEST,
    Contents,
    change,
    forget_all,
    keep,
    people_file,
    recall,
    traces,
    without,
)
from hri.conversation.people import MOST_ASKED, MOST_FACTS, MOST_FELT, KnownPerson
from hri.conversation.relations import Relation
from hri.core.errors import HriError
from hri.core.writing import SUFFIX

NOW = datetime(2026, 5, 4, 9, 30)
LIKES = Relation("likes", "You like {value}.", several=True)


def kept_of(*names: str, value: str = "jazz") -> Contents:
    """People who allowed it, with a fact, a feeling and a question each."""
    memory = Memory({"likes": LIKES})
    for name in names:
        id = memory.introduce(name, NOW, heard=("AE1", "N", "AH0"), said=("AA1", "N", "AH0")).id
        memory.allow(id, NOW, "nod")
        memory.learn(
            id, "likes", f"{value} {name}", NOW, {"kind": "music", "how": 2.5, "now": True}
        )
        memory.feel(id, "joy", f"{name} praised", NOW)
        memory.note_asked(id, "likes", f"{value} {name}", f"How was {name}?")
    return Contents(memory.remembered, memory.last_id)


def bytes_of(folder: Path) -> bytes:
    """All that lies in a folder, names of files too."""
    files = sorted(folder.rglob("*"))
    return b"".join(f.name.encode() + (f.read_bytes() if f.is_file() else b"") for f in files)


def test_what_was_kept_is_recalled(tmp_path: Path) -> None:
    file = tmp_path / "hri" / "people.db"
    assert recall(file) is None
    kept = kept_of("Anna", "Jean-Luc", "O'Neil", "Zoë")
    keep(file, kept)
    assert recall(file) == kept
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert os.listdir(file.parent) == ["people.db"]


WORDS = st.text(st.characters(exclude_categories=("C", "Z")), min_size=1, max_size=LONGEST_TEXT)
TIMES = st.datetimes(datetime(1970, 1, 2), datetime(2200, 1, 1)).map(
    lambda time: time.replace(microsecond=0)
)


@given(
    names=st.lists(WORDS, min_size=1, max_size=4),
    told=st.lists(st.tuples(WORDS, WORDS), max_size=6),
    time=TIMES,
)
def test_any_words_come_back_as_they_were(
    names: list[str], told: list[tuple[str, str]], time: datetime, tmp_path_factory: object
) -> None:
    file = tmp_path_factory.mktemp("any") / "people.db"  # type: ignore[attr-defined]
    memory = Memory({"likes": LIKES})
    for name in names:
        id = memory.introduce(name, time).id
        memory.allow(id, time, "word")
        for value, tag in told:
            memory.learn(id, "likes", value, time, {"tag": tag})
    kept = Contents(memory.remembered, memory.last_id)
    keep(file, kept)
    assert recall(file) == kept


def test_it_is_a_database_that_other_tools_read(tmp_path: Path) -> None:
    file = tmp_path / "people.db"
    keep(file, kept_of("Anna", "Ben"))
    query = "SELECT name, value FROM person JOIN fact ON person = id"
    assert sqlite3.connect(file).execute(query).fetchall() == [
        ("Anna", "jazz Anna"),
        ("Ben", "jazz Ben"),
    ]


def test_the_bytes_of_who_was_forgotten_are_in_no_file_and_not_in_the_old_one(
    tmp_path: Path,
) -> None:
    file = tmp_path / "people.db"
    keep(file, kept_of("Anna", "Quillobrand", value="klezmer"))
    with file.open("rb") as old:
        assert b"Quillobrand" in old.read()
        change(file, lambda kept: without(kept, "quillobrand"))
        old.seek(0)
        assert not old.read().strip(b"\0")
    assert b"quillobrand" not in bytes_of(tmp_path).lower()
    kept = recall(file)
    assert kept is not None
    assert [person.name for person in kept.people.values()] == ["Anna"]
    assert kept.last_id == 2


def test_all_is_forgotten_with_what_other_programs_and_killed_writers_left(tmp_path: Path) -> None:
    file = tmp_path / "people.db"
    for name in ("people.db", "people.db-wal", "people.db-journal", "people.unusable-1.db"):
        (tmp_path / name).write_text("Anna")
    (tmp_path / f".people.db.new-0a1b2c3d{SUFFIX}").write_text("Anna")
    assert len(traces(file)) == 5
    forget_all(file)
    assert list(tmp_path.iterdir()) == []
    forget_all(tmp_path / "nowhere" / "people.db")


def test_the_fullest_memory_fits_into_the_largest_file(tmp_path: Path) -> None:
    wide = "\U0001d4d0" * (LONGEST_TEXT - 4)
    memory = Memory({f"{wide}{n}": Relation(f"{wide}{n}", "{value}", True) for n in range(3)})
    for number in range(MOST_PEOPLE):
        id = memory.introduce(f"{wide}{number}", NOW).id
        person = memory.allow(id, NOW, "word")
        for fact in range(MOST_FACTS):
            tags = {f"{wide}{tag}": wide for tag in range(MOST_TAGS)}
            memory.learn(id, f"{wide}{fact % 3}", f"{wide}{fact}", NOW, tags)
        for _ in range(MOST_FELT):
            memory.feel(id, wide, wide, NOW)
        for _ in range(MOST_ASKED):
            person = memory.note_asked(id, wide, wide, "\U0001d4d0" * LONGEST_QUESTION)
    file = tmp_path / "people.db"
    keep(file, Contents({**memory.remembered, person.id: person}))
    assert file.stat().st_size < LARGEST
    assert len((recall(file) or Contents({})).people) == MOST_PEOPLE


def test_nobody_is_written_who_has_not_allowed_it(tmp_path: Path) -> None:
    stranger = KnownPerson(1, "Anna", NOW, NOW, NOW)
    with pytest.raises(AssertionError, match="allowed"):
        keep(tmp_path / "people.db", Contents({1: stranger}))
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_written_where_others_could_exchange_it(tmp_path: Path) -> None:
    folder = tmp_path / "open"
    folder.mkdir()
    folder.chmod(0o777)
    with pytest.raises(HriError, match="someone else"):
        keep(folder / "people.db", kept_of("Anna"))
    assert list(folder.iterdir()) == []


# --- files that are not ours ---


def another(path: Path, *statements: str) -> None:
    base = sqlite3.connect(path)
    for statement in statements:
        base.execute(statement)
    base.commit()
    base.close()


def a_link(path: Path) -> None:
    target = path.with_name("elsewhere.db")
    keep(target, kept_of("Anna"))
    path.symlink_to(target)


def of_others(path: Path) -> None:
    path.chmod(0o666)


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-5000])


def a_view(path: Path) -> None:
    endless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i FROM n"
    another(path, "DROP TABLE ids", f"CREATE VIEW ids(last) AS {endless}")


REFUSED = {
    "an empty file": (lambda path: path.write_bytes(b""), "not a database"),
    "a text": (lambda path: path.write_text('{"schema": 1}'), "not a database"),
    "noise": (lambda path: path.write_bytes(os.urandom(9000)), "not a database"),
    "noise with the right beginning": (
        lambda path: path.write_bytes(b"SQLite format 3\0" + os.urandom(9000)),
        "damaged",
    ),
    "half a file": (cut, "damaged"),
    "of another program": (
        lambda path: another(path, "PRAGMA application_id = 7"),
        "database of another program",
    ),
    "of a newer version": (lambda path: another(path, "PRAGMA user_version = 99"), "version 99"),
    "with another table": (lambda path: another(path, "CREATE TABLE more (x)"), "other tables"),
    "with a trigger": (
        lambda path: another(path, "CREATE TRIGGER t INSERT ON ids BEGIN SELECT 1; END"),
        "other tables",
    ),
    "with a view without end": (a_view, "other tables"),
    "with a huge text": (
        lambda path: another(path, "UPDATE fact SET value = hex(zeroblob(5000000))"),
        "damaged",
    ),
    "with bytes for a name": (
        lambda path: another(path, "UPDATE person SET name = x'ff00'"),
        "not a text",
    ),
    "with a name that is no text": (
        lambda path: another(path, "UPDATE person SET name = CAST(x'ffff' AS TEXT)"),
        "damaged",
    ),
    "with an empty name": (lambda path: another(path, "UPDATE person SET name = ' '"), "empty"),
    "with a time that is none": (
        lambda path: another(path, "UPDATE person SET seen = 'soon'"),
        "not a time",
    ),
    "with a person nobody allowed": (
        lambda path: another(path, "UPDATE person SET allowed_by = 'guess'"),
        "allowed it",
    ),
    "with values that are none": (
        lambda path: another(path, "UPDATE fact SET tags = '[1]'"),
        "not texts",
    ),
    "with a number too large": (
        lambda path: another(path, "UPDATE person SET meetings = -1"),
        "not a count",
    ),
    "with too many people": (
        lambda path: another(
            path,
            "WITH RECURSIVE n(i) AS (SELECT 9 UNION ALL SELECT i + 1 FROM n WHERE i < 900)"
            " INSERT INTO person SELECT i, 'a', since, seen, met, 1, '', '', allowed, allowed_by"
            " FROM n, person WHERE id = 1",
        ),
        "more than",
    ),
    "that others may write": (of_others, "someone else"),
    "a folder": (lambda path: path.unlink() or path.mkdir(), "regular file"),
    "a pipe": (lambda path: path.unlink() or os.mkfifo(path), "regular file"),
    "a link": (lambda path: path.unlink() or a_link(path), "is a link"),
    "a link to nothing": (lambda path: path.unlink() or path.symlink_to("none"), "is a link"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_file_that_cannot_be_used_is_refused_in_one_line(tmp_path: Path, name: str) -> None:
    file = tmp_path / "people.db"
    keep(file, kept_of("Anna", "Ben"))
    spoil, reason = REFUSED[name]
    spoil(file)
    with pytest.raises(HriError, match=reason) as error:
        recall(file)
    assert "\n" not in str(error.value)
    assert str(file) in str(error.value)


def test_what_was_read_is_not_changed_by_reading(tmp_path: Path) -> None:
    file = tmp_path / "people.db"
    keep(file, kept_of("Anna"))
    before = file.read_bytes()
    recall(file)
    assert os.listdir(tmp_path) == ["people.db"]
    assert file.read_bytes() == before


def test_it_lies_in_the_folder_of_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert people_file() == tmp_path / "hri" / "people.db"


def test_programs_that_change_it_at_once_lose_nothing_of_each_other(tmp_path: Path) -> None:
    file = tmp_path / "people.db"
    anna = kept_of("Anna").people[1]

    def add(id: int) -> None:
        person = replace(anna, id=id)
        change(file, lambda kept: Contents({**kept.people, id: person}, id))

    with ThreadPoolExecutor(8) as threads:
        list(threads.map(add, range(1, 25)))
    assert sorted((recall(file) or Contents({})).people) == list(range(1, 25))
