"""Feelings that outlast a restart: the state in a file, decayed by the time away.

The file is the user's own, in the XDG state folder, and readable by nobody else. It holds names of
people and what the robot thinks of them, so it can be looked at (it is JSON) and forgotten, as a
whole or one person at a time. A file that cannot be used is put aside, never overwritten.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.core.json_fields import LATEST, fields_of
from hri.core.ownership import require_of_user
from hri.core.paths import exists
from hri.core.privacy import folder_for, is_named, is_same_name
from hri.core.reading import read_text
from hri.core.unusable_file import set_aside
from hri.core.writing import PRIVATE, Mark, delete, leftovers, mark_of, write_text
from hri.emotion.affect import Imprint, renamed, shifted
from hri.emotion.imprint_file import decoded, encoded
from hri.emotion.ledger import Origin
from hri.emotion.relations import is_unnamed

T = TypeVar("T")

SCHEMA = 1
SIGN_OF_LIFE_S = 60.0
"""A robot that runs writes its file at least as often."""
LONGEST_AWAY_S = 365 * 86400.0
"""More than this is a clock that was wrong, and counts as this."""


@dataclass(frozen=True, slots=True)
class Memory:
    """Feelings, and the time at which they were saved."""

    imprint: Imprint
    time: float
    """Seconds of the clock of that run."""
    wall: float
    """Seconds since 1970."""
    personality: str = "neutral"
    """Of the robot that felt it: a name or a path."""
    forgettings: int = 0
    """How often a person was forgotten since the file began."""
    has_ended: bool = False
    """Whether it was written at the end of a run."""
    is_of_fake_time: bool = False
    """Whether a fake clock gave the times, which are of 2003 then."""

    def is_running(self, wall: float) -> bool:
        """Whether the robot runs at `wall` seconds since 1970.

        It has not ended then, nor been silent for as long as one whose plug was pulled.
        """
        return not self.has_ended and wall - self.wall < 2 * SIGN_OF_LIFE_S

    def awakened(self, now: float, wall: float) -> Imprint:
        """The same on the clock of another run, which shows `now` at `wall` seconds since 1970.

        A clock that was set back counts as no time away.
        """
        away = min(max(wall - self.wall, 0.0), LONGEST_AWAY_S)
        return shifted(self.imprint, now - away - self.time)


def memory_file() -> Path:
    """Where a robot keeps what it feels between runs."""
    return paths.state_folder() / "feelings.json"


def dump(memory: Memory) -> str:
    """A memory as text; `parse` gives the same again, to the last bit."""
    data = {
        "schema": SCHEMA,
        "time": memory.time,
        "wall": memory.wall,
        "personality": memory.personality,
        "forgettings": memory.forgettings,
        "has_ended": memory.has_ended,
        "is_of_fake_time": memory.is_of_fake_time,
        "affect": encoded(memory.imprint),
    }
    return json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def parse(text: str) -> Memory:
    """A memory of its text. Raises HriError for what is damaged, or of another version."""
    fields = fields_of(text)
    if (schema := fields.value("schema")) != SCHEMA:
        raise HriError(f"it is of version {schema!r:.20}, not {SCHEMA}")
    memory = Memory(
        imprint=decoded(fields.value("affect")),
        time=fields.number("time", LATEST),
        wall=fields.number("wall", LATEST),
        personality=fields.text("personality"),
        forgettings=int(fields.number("forgettings", LATEST, 0.0)),
        has_ended=fields.truth("has_ended", default=False),
        is_of_fake_time=fields.truth("is_of_fake_time", default=False),
    )
    if memory.imprint.time > memory.time:
        raise HriError("it mentions a time after it was written")
    return memory


def recall(path: Path) -> Memory | None:
    """Contents of the file; None when there is none. Raises HriError for one that is damaged,
    cannot be read, or is of another version.
    """
    if not os.path.lexists(path):
        return None
    if not exists(path):
        raise HriError(f"{path} links to {os.readlink(path)}, which is not there - fix the link")
    require_of_user(path, "memory of feelings")
    return parse(read_text(path, "memory of feelings"))


def keep(path: Path, memory: Memory) -> Mark:
    """Write the file, in the place of the one before. Raises HriError."""
    folder_for(path)
    return mark_of(write_text(path, dump(memory), PRIVATE))


def spare_real_time(path: Path) -> None:
    """Refuse to let a run of fake time overwrite feelings of real time. Raises HriError, also for a
    file that cannot be read.
    """
    memory = recall(path)
    if memory is not None and not memory.is_of_fake_time:
        what = f"{path}: the feelings there are of real time, and this run of fake time"
        raise HriError(f"{what} leaves them as they are - run without --fast to add to them")


def traces(path: Path) -> list[Path]:
    """The file, those that were put aside, and what killed writers left, as far as there are any.

    Among them what the writers of earlier versions left.
    """
    found = [path, *set_aside(path), path.with_name(f"{path.name}.new"), *leftovers(path)]
    return [file for file in found if os.path.lexists(file)]


def forget(path: Path, person: str | None = None) -> bool:
    """Forget all that was felt, or a person; whether there was anything to forget.

    With a person, the relation to them is deleted, and feelings that they caused lose the name. A
    robot that runs forgets it too, within a second. Files beside it (`traces`) go as well when all
    is forgotten. Raises HriError for someone it does not know, for a file that cannot be used, and
    for one that cannot be written or deleted.
    """
    if person is None:
        found = traces(path)
        delete(*found)
        return bool(found)
    memory = recall(path)
    if memory is None:
        return False
    imprint, count = without(memory.imprint, person), memory.forgettings + 1
    if imprint == memory.imprint:
        remedy = did_you_mean(person, people(memory.imprint))
        raise HriError(f'unknown person "{person}" - {remedy}')
    keep(path, replace(memory, imprint=imprint, forgettings=count))
    return True


def people(imprint: Imprint) -> set[str]:
    """Everyone whose name is in it."""
    origins = (*imprint.ledger, *imprint.fresh, *imprint.habituation, *imprint.held)
    named = {origin.person for origin in origins if origin.person is not None}
    if imprint.soothed is not None and imprint.soothed.person is not None:
        named.add(imprint.soothed.person)
    return named | set(imprint.relations)


def without(imprint: Imprint, person: str) -> Imprint:
    """The same without a person: feelings that they caused stay, without a cause. Feelings about a
    goal, a deed or a thing with their name are removed.
    """
    called = {name: None for name in people(imprint) if is_same_name(person, name)}
    rest = renamed(imprint, called)

    def others(causes: Mapping[Origin, T]) -> dict[Origin, T]:
        called = {origin for origin in causes if is_named(person, origin.name.partition(".")[2])}
        return {origin: of for origin, of in causes.items() if origin not in called}

    last = rest.soothed
    if last is not None and (last.person is None or is_named(person, f"{last.deed} {last.amends}")):
        last = None
    return rest._replace(
        ledger=others(rest.ledger),
        fresh=others(rest.fresh),
        habituation=others(rest.habituation),
        held=others(rest.held),
        words={
            cause: said
            for cause, said in rest.words.items()
            if not is_named(person, cause.partition(".")[2]) and not is_named(person, said)
        },
        soothed=last,
    )


def switched_off(imprint: Imprint, time: float) -> Imprint:
    """The same for a robot that was switched off at a time: states ended then, since nobody can
    say that they still go on; goals stay open.
    """
    held = {
        origin: state if origin.goal else state._replace(until=min(state.until, time))
        for origin, state in imprint.held.items()
    }
    return imprint._replace(held=held)


def without_unnamed(imprint: Imprint) -> Imprint:
    """The same without those who had but an id, which is someone else's by now."""
    return renamed(imprint, dict.fromkeys(filter(is_unnamed, people(imprint))))
