"""The file of what a robot has promised to say: JSON, for its owner alone, written as a whole."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from hri.conversation.alarms import LONGEST_ABOUT, MOST_ALARMS, Alarm, AlarmKind, Instant
from hri.core import paths
from hri.core.clock import Uptime
from hri.core.errors import HriError
from hri.core.folder_lock import locked_folder
from hri.core.json_fields import LATEST, Fields, fields_of
from hri.core.ownership import require_of_user
from hri.core.privacy import folder_for, is_named
from hri.core.reading import read_text
from hri.core.unusable_file import set_aside
from hri.core.writing import PRIVATE, Mark, delete, leftovers, mark_of, write_text

WHAT = "list of timers, alarms and reminders"
SCHEMA = 1
LARGEST = 1_000_000
"""Bytes; the fullest list has fewer."""


@dataclass(frozen=True, slots=True)
class Contents:
    """What a file holds."""

    alarms: Mapping[int, Alarm] = field(default_factory=dict)
    """By id."""
    at: Instant | None = None
    """When it was written."""
    last_id: int = 0
    """The highest id that any ever had."""


def alarm_file() -> Path:
    """Where a robot keeps them between runs."""
    return paths.state_folder() / "alarms.json"


def recall(path: Path) -> Contents:
    """Contents of the file; nothing when there is none.

    Raises HriError for one that is damaged, cannot be read, or may be of someone else.
    """
    if not os.path.lexists(path):
        return Contents()
    require_of_user(path, WHAT)
    text = read_text(path, WHAT, LARGEST)
    try:
        return _parsed(text)
    except HriError as error:
        raise HriError(f"{path}: {error}") from error


def change(path: Path, edit: Callable[[Contents], Contents]) -> tuple[Contents, Mark | None]:
    """Replace the contents of the file by those that `edit` gives, while no other program writes.

    What it holds then, and its mark; None where there is no file, since there is nothing to keep.
    Raises HriError, also for a file that cannot be used.
    """
    folder_for(path)
    with locked_folder(path.parent):
        before = recall(path)
        after = edit(before)
        if not after.alarms and not os.path.lexists(path):
            return after, None
        return after, mark_of(write_text(path, dump(after), PRIVATE))


def forget(path: Path, person: str) -> None:
    """Take out what names a person. Raises HriError."""
    change(path, lambda kept: Contents(_without(kept.alarms, person), kept.at, kept.last_id))


def traces(path: Path) -> list[Path]:
    """The file, those that were put aside, and what killed writers left."""
    found = [path, *set_aside(path), *leftovers(path)]
    return [file for file in found if os.path.lexists(file)]


def forget_all(path: Path) -> None:
    """Delete the file and what lies beside it. Raises HriError."""
    with locked_folder(path.parent):
        delete(*traces(path))


def _without(alarms: Mapping[int, Alarm], person: str) -> dict[int, Alarm]:
    return {id: one for id, one in alarms.items() if not is_named(person, one.about)}


def dump(kept: Contents) -> str:
    """The text of a file."""
    data = {
        "schema": SCHEMA,
        "last_id": kept.last_id,
        "wall": kept.at.wall if kept.at else 0.0,
        "uptime": kept.at.uptime.seconds if kept.at else 0.0,
        "boot": kept.at.uptime.boot if kept.at else "",
        "alarms": [
            {
                "id": alarm.id,
                "kind": alarm.kind.value,
                "about": alarm.about,
                "due": alarm.due,
                "length": alarm.length,
                "has_begun": alarm.has_begun,
            }
            for alarm in kept.alarms.values()
        ],
    }
    return json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _parsed(text: str) -> Contents:
    fields = fields_of(text)
    if (schema := fields.value("schema")) != SCHEMA:
        raise HriError(f"it is of version {schema!r:.20}, not {SCHEMA}")
    entries = fields.entries("alarms")
    if len(entries) > MOST_ALARMS:
        raise HriError(f"it has more than {MOST_ALARMS} entries")
    uptime = Uptime(fields.number("uptime", LATEST, 0.0), fields.text("boot"))
    alarms = {alarm.id: alarm for alarm in map(_alarm, entries)}
    at = Instant(fields.number("wall", LATEST), uptime)
    return Contents(alarms, at, int(fields.number("last_id", 2**53, 0)))


def _alarm(entry: Fields) -> Alarm:
    kind, about = entry.text("kind"), entry.text("about")
    if kind not in list(AlarmKind):
        raise HriError(f'{entry.place}.kind is "{kind:.20}", not {", ".join(AlarmKind)}')
    if len(about) > LONGEST_ABOUT:
        raise HriError(f"{entry.place}.about has more than {LONGEST_ABOUT} characters")
    return Alarm(
        int(entry.number("id", 2**53, 1)),
        AlarmKind(kind),
        entry.number("due", LATEST, 0.0),
        about,
        entry.number("length", LATEST, 0.0),
        entry.truth("has_begun", default=False),
    )
