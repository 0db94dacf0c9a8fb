"""Keeps the people that a running robot knows in a file, and notices when they are forgotten."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from hri.conversation.memory import MOST_PEOPLE, Memory
from hri.conversation.memory_file import Contents, change, people_file, recall
from hri.conversation.people import KnownPerson, merged
from hri.conversation.relations import Relation
from hri.core.clock import Clock, Worker
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.stored_data_index import note
from hri.core.unusable_file import put_aside
from hri.core.writing import Mark, mark_of

LATENCY = 0.05
"""Seconds that writing takes on the fake clock."""
LOOK_EVERY = 0.5
"""Seconds after which it looks whether someone else has changed the file."""
TRY_AGAIN = 10.0
"""Seconds after a write that failed."""

People = Mapping[int, KnownPerson]
log = logging.getLogger("hri.memory")


PEOPLE_FILE = "people.file"
"""Slot of the board that names another file for the memory of people; empty for none."""


def file_of_run(clock: Clock, is_to_repeat: bool, named: str | None = None) -> Path | None:
    """Where a run remembers people: in the file that is named, in none if that is empty, else
    nowhere in fake time, or in a run that can be repeated.
    """
    if named is not None:
        return Path(named) if named else None
    return None if clock.is_fake or is_to_repeat else people_file()


@dataclass(frozen=True, slots=True)
class _Written:
    """What a worker came back with."""

    sent: People
    """What was known when it began."""
    kept: Contents
    """What the file holds."""
    mark: Mark | None


class MemoryKeeper:
    """Holds the memory of a run, and keeps it in a file.

    A file that cannot be used is set aside with one line of the log, and `memory.refused` is
    raised; `memory.failed`, once, when it cannot be written; `memory.forgotten` when someone else
    took something out of it, such as `hri forget`.
    """

    def __init__(
        self,
        path: Path | None,
        relations: Mapping[str, Relation],
        clock: Clock,
        events: EventBus,
    ) -> None:
        """Read the file; None for a memory that ends with the run."""
        self._path = path
        self._events = events
        self._worker: Worker[_Written] = clock.worker(LATENCY)
        self._is_stuck = False
        """Whether there is something in the way that must not be overwritten."""
        self._has_failed = False
        self._mark: Mark | None = None
        """Of the file as it was seen last; None where there was none."""
        self._next_look = self._next_try = -math.inf
        kept = self._recalled()
        self._kept: People = kept.people
        """What the file holds, as far as is known."""
        self.memory = Memory(relations, kept.people.values(), kept.last_id)

    def poll(self, now: float) -> None:
        """Start to write changes, take over those that were written, and notice requests to
        forget. To be called often; `now` in seconds of the clock. It never waits for the disk.
        """
        if self._path is None or self._is_stuck:
            return
        self._take_over(now)
        if self._worker.is_busy or now < self._next_try:
            return
        is_touched = now >= self._next_look and self._is_touched()
        if now >= self._next_look:
            self._next_look = now + LOOK_EVERY
        if is_touched or self.memory.remembered != self._kept:
            self._submit()

    def close(self) -> None:
        """Write what is not written yet, and wait for it."""
        if self._path is None or self._is_stuck:
            return
        self._worker.close()
        self._take_over(math.inf)
        if self.memory.remembered != self._kept:
            try:
                self._adopt(self._job()())
            except HriError as error:
                self._fail(error)

    def _submit(self) -> None:
        self._worker.submit(self._job())

    def _job(self) -> partial[_Written]:
        assert self._path is not None
        last_id = self.memory.last_id
        return partial(_update, self._path, self.memory.remembered, self._kept, last_id)

    def _take_over(self, now: float) -> None:
        try:
            for written in self._worker.poll():
                self._adopt(written)
        except HriError as error:
            self._next_try = now + TRY_AGAIN
            self._fail(error)

    def _adopt(self, written: _Written) -> None:
        """The file is as it was written; what someone else took out of it is forgotten."""
        theirs, memory, lost = written.kept.people, self.memory, False
        for id, sent in written.sent.items():
            mine = memory.person(id)
            if id not in theirs:
                lost = lost or mine is not None
                memory.drop(id)
            elif mine is not None and theirs[id] is not sent:
                lost = lost or len(theirs[id].facts) < len(sent.facts)
                memory.put(merged(mine, sent, theirs[id]))
        for id, person in theirs.items():
            if id not in written.sent and id not in self._kept and memory.person(id) is None:
                memory.put(person)
        self._kept, self._mark, self._has_failed = theirs, written.mark, False
        if lost:
            self._events.raise_event("memory.forgotten", file=str(self._path))

    def _is_touched(self) -> bool:
        """Whether the file is not the one that was seen last."""
        return self._mark != self._seen()

    def _seen(self) -> Mark | None:
        assert self._path is not None
        try:
            return mark_of(self._path.stat())
        except OSError:
            return None

    def _recalled(self) -> Contents:
        """What the file holds; nobody where it cannot be used."""
        if self._path is None:
            return Contents({})
        try:
            kept = recall(self._path)
        except HriError as error:
            self._put_aside(self._path, error)
            return Contents({})
        self._mark = self._seen()
        return kept or Contents({})

    def _put_aside(self, path: Path, problem: HriError) -> None:
        try:
            reason = f"{problem} - it is kept as {put_aside(path)}, and the robot knows nobody"
        except OSError as error:
            self._is_stuck = True
            reason = f"{problem} - nor can it be renamed ({error.strerror}): nothing is kept"
        log.error("%s", reason)
        self._events.raise_event("memory.refused", file=str(path), reason=reason)

    def _fail(self, error: HriError) -> None:
        if not self._has_failed:
            self._has_failed = True
            log.error("%s", error)
            self._events.raise_event("memory.failed", file=str(self._path), reason=str(error))


def _update(path: Path, sent: People, before: People, last_id: int) -> _Written:
    """Write the people `sent`, except for what someone else took out of the file since `before`."""

    def edit(kept: Contents) -> Contents:
        people = dict(kept.people)
        for id in before.keys() - sent.keys():
            people.pop(id, None)
        for id, person in sent.items():
            if id in before and id in people:
                is_same = people[id] == before[id]
                people[id] = person if is_same else merged(person, before[id], people[id])
            elif id not in before and id in people:
                what = f"{path}: another robot remembers people there"
                raise HriError(f"{what} - give each robot a separate XDG_STATE_HOME")
            elif id not in before:
                people[id] = person
        if len(people) > MOST_PEOPLE:
            raise HriError(f"{path}: it has no room for more people - hri forget NAME makes some")
        return Contents(people, max(last_id, kept.last_id))

    if path != people_file():
        note("people", path)
    kept, mark = change(path, edit)
    return _Written(sent, kept, mark)
