"""The file of the people that a robot remembers: a SQLite database, for its owner alone.

It is small, and written as a whole: the new one is made beside it, flushed to the disk, and takes
its name in one step (`hri.core.writing`). So a program that is killed, at whatever call, leaves the
old one or the new one, no journal is ever needed, and nothing that was forgotten is left in free
pages. The bytes of the old one are overwritten as soon as the new one has its name.
"""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from hri.conversation.facts import LONGEST_TEXT, Fact, Scalar, check_values, check_words
from hri.conversation.memory import LONGEST_QUESTION, MOST_PEOPLE
from hri.conversation.people import (
    MOST_ASKED,
    MOST_FACTS,
    MOST_FELT,
    MOST_PHONES,
    WAYS,
    Asked,
    Consent,
    Felt,
    KnownPerson,
)
from hri.core import paths
from hri.core.errors import HriError
from hri.core.folder_lock import locked_folder
from hri.core.open_files import BINARY, MAY_RENAME_OPEN, NO_LINK
from hri.core.ownership import require_of_user
from hri.core.privacy import folder_for
from hri.core.reading import opened, parse_json
from hri.core.unusable_file import set_aside
from hri.core.writing import PRIVATE, Mark, delete, leftovers, mark_of, replacing, write_all

WHAT = "memory of people"
SCHEMA = 1
APPLICATION = 0x68726950
"""By which our databases are known, "hriP": SQLite keeps it in the file."""
LARGEST = 50_000_000
"""Bytes of a file; the fullest memory has less."""
_LONGEST_CELL = 20_000
"""Bytes of a cell."""
_MOST_STEPS = 20_000_000
"""Instructions of SQLite that reading may take: some seconds."""
_MAGIC = b"SQLite format 3\0"
_TABLES = (
    "CREATE TABLE ids (last INTEGER)",
    "CREATE TABLE person (id INTEGER PRIMARY KEY, name TEXT, since TEXT, seen TEXT, met TEXT,"
    " meetings INTEGER, heard TEXT, said TEXT, allowed TEXT, allowed_by TEXT)",
    "CREATE TABLE fact (person INTEGER, relation TEXT, value TEXT, since TEXT, tags TEXT)",
    "CREATE TABLE felt (person INTEGER, feeling TEXT, because TEXT, time TEXT)",
    "CREATE TABLE asked (person INTEGER, relation TEXT, value TEXT, question TEXT,"
    " meeting INTEGER)",
)
Row = Sequence[Any]
Of = dict[int, KnownPerson]


@dataclass(frozen=True, slots=True)
class Contents:
    """What a file holds."""

    people: Mapping[int, KnownPerson]
    """By id."""
    last_id: int = 0
    """The highest id that anyone ever had."""


NOBODY = Contents({})


def people_file() -> Path:
    """Where a robot remembers people between runs."""
    return paths.state_folder() / "people.db"


def recall(path: Path) -> Contents | None:
    """Contents of the file; None when there is none.

    Raises HriError for one that is damaged, cannot be read, is a link, is of another program or
    version, or may have been written by someone else.
    """
    if not os.path.lexists(path):
        return None
    if path.is_symlink():
        raise HriError(f"{path} is a link, and what is forgotten must be in one place - remove it")
    with opened(path, WHAT, LARGEST) as file:
        require_of_user(path, WHAT)
        if file.read(len(_MAGIC)) != _MAGIC:
            raise HriError(f"{path}: it is not a database of SQLite")
    return _read(path)


def keep(path: Path, kept: Contents) -> Mark:
    """Write the file, in the place of the one before, whose bytes are overwritten.

    Raises HriError, also for a folder that others can write to: they could exchange the file.
    """
    folder_for(path)
    require_of_user(path.parent, "folder")
    with _overwriting(path):
        with replacing(path, PRIVATE) as new:
            try:
                _write(new, kept)
            except sqlite3.Error as error:
                raise _not_kept(path, error) from error
        return mark_of(path.stat())


def change(path: Path, edit: Callable[[Contents], Contents]) -> tuple[Contents, Mark | None]:
    """Replace the contents of the file by those that `edit` gives, while no other program writes.

    What it holds then, and its mark; None where there is no file, since there is nothing to keep.
    Raises HriError, also for a file that cannot be used.
    """
    folder_for(path)
    with locked_folder(path.parent):
        before = recall(path)
        kept = edit(before or NOBODY)
        if kept.people != (before or NOBODY).people:
            return kept, keep(path, kept)
        return kept, None if before is None else mark_of(path.stat())


def traces(path: Path) -> list[Path]:
    """The file, those that were put aside, and what killed writers left, as far as there are any.

    Among them what another program that opened the database may have left.
    """
    beside = (path.with_name(f"{path.name}-{kind}") for kind in ("journal", "wal", "shm"))
    found = [path, *set_aside(path), *beside, *leftovers(path)]
    return [file for file in found if os.path.lexists(file)]


def forget_all(path: Path) -> None:
    """Delete the file and what lies beside it (`traces`). Raises HriError."""
    with locked_folder(path.parent):
        for file in traces(path):
            with _overwriting(file):
                delete(file)


def without(kept: Contents, name: str) -> Contents:
    """The same without everyone of a name, and without what others told of them."""
    rest = {id: one.without(name) for id, one in kept.people.items() if not one.is_called(name)}
    return Contents(rest, kept.last_id)


def people_of(path: Path) -> list[KnownPerson]:
    """Everyone who is remembered there; nobody where the file cannot be used."""
    with suppress(HriError):
        return list((recall(path) or NOBODY).people.values())
    return []


def is_database(path: Path) -> bool:
    """Whether a file begins as those of SQLite do."""
    try:
        with opened(path, WHAT, None) as file:
            return file.read(len(_MAGIC)) == _MAGIC
    except HriError:
        return False


def texts(path: Path) -> list[str]:
    """All that a file has in words, about those who are remembered or of itself."""
    found = [*_TABLES, *WAYS]
    for person in people_of(path):
        found += person.texts()
        found += (fact.relation for fact in person.facts)
        found += (name for fact in person.facts for name in fact.values)
    return [text for text in found if text]


def spoiled(path: Path) -> list[Path]:
    """Those of the `traces` that cannot be used."""
    found = traces(path)
    with suppress(HriError):
        recall(path)
        return [file for file in found if file != path]
    return found


# --- reading ---


def _read(path: Path) -> Contents:
    try:
        uri = f"{path.absolute().as_uri()}?mode=ro&immutable=1"
        with closing(sqlite3.connect(uri, uri=True)) as base:
            _restrain(base)
            _require_ours(base)
            return _contents(base)
    except (sqlite3.Error, OverflowError, UnicodeError, ValueError) as error:
        raise HriError(f"{path}: it is damaged: {error}") from error
    except HriError as error:
        raise HriError(f"{path}: {error}") from error


def _restrain(base: sqlite3.Connection) -> None:
    """Whatever the file says, reading it ends, and takes little memory."""
    left = iter(range(_MOST_STEPS // 10_000))
    base.set_progress_handler(lambda: next(left, None) is None, 10_000)
    base.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, _LONGEST_CELL)
    base.execute("PRAGMA trusted_schema = OFF")
    base.execute("PRAGMA cell_size_check = ON")


def _require_ours(base: sqlite3.Connection) -> None:
    """Raise HriError unless it has our tables, and only those: a view could be anything."""
    (application,), (version,) = (
        base.execute(f"PRAGMA {name}").fetchone() for name in ("application_id", "user_version")
    )
    if application != APPLICATION:
        raise HriError("it is a database of another program")
    if version != SCHEMA:
        raise HriError(f"it is of version {version}, not {SCHEMA}")
    if tuple(sql for (sql,) in _rows(base, "SELECT sql FROM sqlite_master", 10)) != _TABLES:
        raise HriError("it has other tables than ours")
    if (fault := base.execute("PRAGMA quick_check(1)").fetchone()[0]) != "ok":
        raise HriError(f"it is damaged: {fault}")


def _rows(base: sqlite3.Connection, query: str, most: int) -> list[Row]:
    rows = base.execute(query).fetchmany(most + 1)
    if len(rows) > most:
        raise HriError(f"it has more than {most} entries of a kind")
    return rows


def _contents(base: sqlite3.Connection) -> Contents:
    found = {}
    facts = _by_person(base, "relation, value, since, tags FROM fact", MOST_FACTS, _fact)
    felt = _by_person(base, "feeling, because, time FROM felt", MOST_FELT, _felt)
    asked = _by_person(base, "relation, value, question, meeting FROM asked", MOST_ASKED, _asked)
    columns = "id, name, since, seen, met, meetings, heard, said, allowed, allowed_by"
    for row in _rows(base, f"SELECT {columns} FROM person", MOST_PEOPLE):
        person = _person(row, facts, felt, asked)
        found[person.id] = person
    ((last,),) = _rows(base, "SELECT last FROM ids", 1) or ((0,),)
    return Contents(found, max([_count(last), *found]))


def _by_person(
    base: sqlite3.Connection, query: str, most: int, made: Callable[..., Any]
) -> dict[int, list[Any]]:
    found: dict[int, list[Any]] = {}
    query = f"SELECT person, {query} ORDER BY rowid"
    for person, *values in _rows(base, query, most * MOST_PEOPLE):
        found.setdefault(_count(person), []).append(made(*values))
    if any(len(of_one) > most for of_one in found.values()):
        raise HriError(f"it has more than {most} entries of a person")
    return found


def _person(
    row: Row, facts: Mapping[int, Row], felt: Mapping[int, Row], asked: Mapping[int, Row]
) -> KnownPerson:
    id, name, since, seen, met, meetings, heard, said, allowed, by = row
    id = _count(id)
    if by not in WAYS:
        raise HriError(f"a person who allowed it by {by!r:.20}")
    return KnownPerson(
        id,
        _text(name),
        _time(since),
        _time(seen),
        _time(met),
        _count(meetings),
        _phones(heard),
        _phones(said),
        Consent(_time(allowed), by),
        *(tuple(of.get(id, ())) for of in (facts, felt, asked)),
    )


def _fact(relation: object, value: object, since: object, tags: object) -> Fact:
    values = parse_json(_string(tags, _LONGEST_CELL))
    scalars = isinstance(values, dict) and all(
        isinstance(one, (str, int, float)) for one in values.values()
    )
    if not scalars:
        raise HriError("a fact whose values are not texts and numbers")
    return Fact(_text(relation), _text(value), _time(since), check_values(values))


def _felt(feeling: object, because: object, time: object) -> Felt:
    return Felt(_text(feeling), _text(because), _time(time))


def _asked(relation: object, value: object, question: object, meeting: object) -> Asked:
    text = _string(question, LONGEST_QUESTION)
    return Asked(_text(relation), _string(value, LONGEST_TEXT), text, _count(meeting))


def _text(value: object) -> str:
    return check_words(_string(value, LONGEST_TEXT), "text")


def _string(value: object, longest: int) -> str:
    if not isinstance(value, str) or len(value) > longest:
        raise HriError(f"a value that is not a text of {longest} characters")
    return value


def _count(value: object) -> int:
    if not isinstance(value, int) or not 0 <= value < 1 << 62:
        raise HriError("a number that is not a count")
    return value


def _time(value: object) -> datetime:
    try:
        time = datetime.fromisoformat(_string(value, LONGEST_TEXT))
    except ValueError as error:
        raise HriError("a text that is not a time") from error
    return time.replace(tzinfo=None, microsecond=0)


def _phones(value: object) -> tuple[str, ...]:
    found = tuple(_string(value, MOST_PHONES * 5).split())
    if len(found) > MOST_PHONES:
        raise HriError(f"a name of more than {MOST_PHONES} phones")
    return found


# --- writing ---


def _write(new: Path, kept: Contents) -> None:
    """Fill an empty file. Raises sqlite3.Error."""
    # A file that has not got its name yet needs no journal and no lock, and is flushed at the end.
    with closing(sqlite3.connect(f"{new.absolute().as_uri()}?nolock=1", uri=True)) as base:
        base.execute("PRAGMA journal_mode = OFF")
        base.execute("PRAGMA synchronous = OFF")
        base.execute("PRAGMA secure_delete = ON")
        base.execute(f"PRAGMA application_id = {APPLICATION}")
        base.execute(f"PRAGMA user_version = {SCHEMA}")
        with base:
            for table in _TABLES:
                base.execute(table)
            base.execute("INSERT INTO ids VALUES (?)", (kept.last_id,))
            for person in kept.people.values():
                _insert(base, person)


def _insert(base: sqlite3.Connection, person: KnownPerson) -> None:
    id, consent = person.id, person.consent
    assert consent is not None, "nobody is written who has not allowed it"
    times = (time.isoformat() for time in (person.since, person.seen, person.met))
    sounds = " ".join(person.heard), " ".join(person.said)
    allowed = consent.when.isoformat(), consent.how
    row = (id, person.name, *times, person.meetings, *sounds, *allowed)
    base.execute("INSERT INTO person VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", row)
    base.executemany(
        "INSERT INTO fact VALUES (?, ?, ?, ?, ?)",
        [
            (id, one.relation, one.value, one.since.isoformat(), _json(one.values))
            for one in person.facts
        ],
    )
    base.executemany(
        "INSERT INTO felt VALUES (?, ?, ?, ?)",
        [(id, one.feeling, one.because, one.when.isoformat()) for one in person.felt],
    )
    base.executemany(
        "INSERT INTO asked VALUES (?, ?, ?, ?, ?)",
        [(id, one.relation, one.value, one.question, one.meeting) for one in person.asked],
    )


def _json(values: Mapping[str, Scalar]) -> str:
    return json.dumps(dict(values), ensure_ascii=False)


def _not_kept(path: Path, error: sqlite3.Error) -> HriError:
    return HriError(
        f"{path}: cannot be written: {error} - make room on the disk, or check the path"
    )


@contextmanager
def _overwriting(path: Path) -> Iterator[None]:
    """Overwrite the bytes of a file that has lost its name when the block ends."""
    if not MAY_RENAME_OPEN:
        yield
        return
    try:
        handle = os.open(path, os.O_RDWR | NO_LINK | BINARY)
    except OSError:  # there is none, or it is a link
        yield
        return
    try:
        yield
        status = os.fstat(handle)
        if status.st_nlink == 0:
            with suppress(OSError):  # a full disk, where files are not written in their place
                write_all(handle, bytes(status.st_size))
                os.fsync(handle)
    finally:
        os.close(handle)
