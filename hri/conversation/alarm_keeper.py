"""Keeps what a running robot has promised to say in a file, so that a restart loses none of it."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from hri.conversation.alarm_file import Contents, alarm_file, change, recall
from hri.conversation.alarms import (
    EARLIEST,
    Alarm,
    AlarmKind,
    Alarms,
    Instant,
    meant,
    when_words,
)
from hri.core.clock import Clock, Worker, since_1970, stamp_of, wall_of
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.latest import Latest
from hri.core.unusable_file import put_aside
from hri.core.writing import Mark, mark_of
from hri.task.context import TaskContext

LATENCY = 0.05
"""Seconds that writing takes on the fake clock."""
LOOK_EVERY = 0.5
"""Seconds after which it looks whether someone else has changed the file."""
TRY_AGAIN = 10.0
"""Seconds after a write that failed."""
MOST_PATIENCE = 5.0
"""Seconds that `kept` waits for the disk."""
SLOT = "alarms"
ALARM_FILE = "alarms.file"
"""Slot of the board that names another file; empty for none."""
log = logging.getLogger("hri.memory")


@dataclass(frozen=True, slots=True)
class _Written:
    """What a worker came back with."""

    sent: Mapping[int, Alarm]
    """What was to be kept."""
    kept: Mapping[int, Alarm]
    """What the file holds."""
    mark: Mark | None


class AlarmKeeper:
    """The promises of a run, and their file.

    A file that cannot be used is set aside with one line of the log, and `memory.refused` is
    raised; `memory.failed`, once, when it cannot be written.
    """

    def __init__(self, path: Path | None, clock: Clock, events: EventBus) -> None:
        """Read the file; None for promises that end with the run."""
        self._path, self._clock, self._events = path, clock, events
        self._worker: Worker[_Written] = clock.worker(LATENCY)
        self._mark: Mark | None = None
        self._next_look = self._next_try = -math.inf
        self._has_failed = False
        found = self._recalled()
        self._kept = found.alarms
        """What the file holds, as far as is known."""
        self.alarms = Alarms(found.alarms.values(), found.at, found.last_id)
        self.alarms.look(self.instant())

    @classmethod
    def of(cls, context: TaskContext) -> AlarmKeeper:
        """The one of this robot, made on first use.

        It keeps a file in real time alone, unless the board names one.
        """
        slot: Latest[AlarmKeeper] = context.board.slot(SLOT)
        if slot.value is None:
            named: str | None = context.board.slot(ALARM_FILE).value
            is_lasting = not (context.clock.is_fake or context.resources.is_to_repeat)
            usual = alarm_file() if is_lasting else None
            path = usual if named is None else Path(named) if named else None
            slot.set(cls(path, context.clock, context.events), context.clock.now())
        assert slot.value is not None
        return slot.value

    def instant(self) -> Instant:
        """Now, on both clocks."""
        return Instant(since_1970(self._clock), self._clock.uptime())

    def promise(
        self, kind: AlarmKind, when: str, about: str = "", earliest: int = EARLIEST
    ) -> Alarm:
        """Add one for a time as `hri.conversation.alarms.meant` reads it, not kept yet.

        Raises TooManyAlarms, or ValueError for a time that is not to come.
        """
        due, length = meant(when, self._clock.wall(), earliest)
        # A night in which the clocks change has another number of hours on the wall.
        stamp = since_1970(self._clock) + length if length else stamp_of(self._clock, due)
        return self.alarms.add(kind, stamp, about, length)

    def when_words(self, alarm: Alarm) -> str:
        """When it is due, in words."""
        return when_words(wall_of(self._clock, alarm.due), self._clock.wall())

    def when_tag(self, alarm: Alarm) -> str:
        """When it is due, as `hri.conversation.alarms.meant` reads it."""
        return f"{wall_of(self._clock, alarm.due):%Y-%m-%d %H:%M}"

    async def begin(self, alarm: Alarm) -> bool:
        """Note that it is about to be said; whether that is for the first time.

        Only the disk knows after a crash that a person may have heard it already.
        """
        if alarm.has_begun:
            return False
        self.alarms.put(replace(alarm, has_begun=True))
        await self.kept()
        return True

    async def end(self, alarm: Alarm) -> None:
        """It was said to its end."""
        self.alarms.remove(alarm)
        await self.kept()

    async def kept(self) -> bool:
        """Wait until all that was promised is in the file; whether it is.

        True also without a file: then all ends with the run, as it should.
        """
        end = self._clock.now() + MOST_PATIENCE
        while not self._is_kept:
            self.poll()
            if self._has_failed or self._clock.now() > end:
                return False
            await self._clock.sleep(0.02)
        return True

    def poll(self) -> None:
        """Start to write changes, take over those that were written, and notice what someone else
        took out. To be called often; it never waits for the disk.
        """
        self.alarms.look(self.instant())
        if self._path is None:
            return
        now = self._clock.now()
        self._take_over(now)
        if self._worker.is_busy or now < self._next_try:
            return
        is_touched = now >= self._next_look and self._mark != self._seen(self._path)
        if now >= self._next_look:
            self._next_look = now + LOOK_EVERY
        if is_touched or not self._is_kept:
            self._worker.submit(self._job(self._path))

    @property
    def _is_kept(self) -> bool:
        return self._path is None or self._kept == self.alarms.by_id

    def _job(self, path: Path) -> Callable[[], _Written]:
        wanted = Contents(self.alarms.by_id, self.instant(), self.alarms.last_id)
        return partial(_update, path, wanted, self._kept)

    def _take_over(self, now: float) -> None:
        try:
            for written in self._worker.poll():
                self._adopt(written)
        except HriError as error:
            self._next_try = now + TRY_AGAIN
            if not self._has_failed:
                self._has_failed = True
                log.error("%s", error)
                self._events.raise_event("memory.failed", file=str(self._path), reason=str(error))

    def _adopt(self, written: _Written) -> None:
        """The file is as it was written; what someone else took out of it is forgotten."""
        for id, alarm in written.sent.items():
            if id not in written.kept:
                self.alarms.remove(alarm)
        self._kept, self._mark, self._has_failed = written.kept, written.mark, False

    @staticmethod
    def _seen(path: Path) -> Mark | None:
        try:
            return mark_of(path.stat())
        except OSError:
            return None

    def _recalled(self) -> Contents:
        """What the file holds; nothing where it cannot be used."""
        if self._path is None:
            return Contents()
        try:
            found = recall(self._path)
        except HriError as error:
            self._put_aside(self._path, error)
            return Contents()
        self._mark = self._seen(self._path)
        return found

    def _put_aside(self, path: Path, problem: HriError) -> None:
        try:
            reason = f"{problem} - it is kept as {put_aside(path)}, and the robot has no timers"
        except OSError as error:
            self._path = None
            reason = f"{problem} - nor can it be renamed ({error.strerror}): nothing is kept"
        log.error("%s", reason)
        self._events.raise_event("memory.refused", file=str(path), reason=reason)


def _update(path: Path, wanted: Contents, before: Mapping[int, Alarm]) -> _Written:
    """Write all that is wanted, but nothing that someone else took out of it since `before`."""

    def edit(found: Contents) -> Contents:
        gone = before.keys() - found.alarms.keys()
        rest = {id: alarm for id, alarm in wanted.alarms.items() if id not in gone}
        return replace(wanted, alarms=rest)

    kept, mark = change(path, edit)
    return _Written(wanted.alarms, kept.alarms, mark)
