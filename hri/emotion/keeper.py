"""Keeps the feelings of a running robot in a file, and notices requests to forget."""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from functools import partial
from pathlib import Path

from hri.behavior.behavior import Context
from hri.core.clock import Clock, Worker
from hri.core.errors import HriError
from hri.core.stored_data_index import note
from hri.core.unusable_file import put_aside
from hri.core.writing import Mark, mark_of
from hri.emotion.affect import Affect, Imprint
from hri.emotion.dynamics import Dynamics
from hri.emotion.persistence import (
    SIGN_OF_LIFE_S,
    Memory,
    keep,
    memory_file,
    recall,
    spare_real_time,
    switched_off,
    without_unnamed,
)

KEEP_EVERY_S = 2.0
"""A robot whose plug is pulled forgets no more than this, `hri emotion watch` lags by no more."""
SAVE_LATENCY = 0.05
"""Seconds that writing takes on the fake clock."""

log = logging.getLogger("hri.emotion")


class Keeper:
    """Keeps what a running robot feels in a file: whenever something has happened, now and then as
    a sign of life, and at its end.

    A file that cannot be used is reported by the event `memory.refused` and renamed; one that
    cannot be written by `memory.failed`, once; and `memory.forgotten` that it was made to forget.
    On a fake clock it does not overwrite feelings of real time.
    """

    def __init__(self, path: Path, personality: str, context: Context) -> None:
        """`personality` is the robot's, for those who read the file."""
        self._path = path
        if path != memory_file():
            note("feelings", path)
        self._personality = personality
        self._events = context.events
        self._clock: Clock = context.clock
        self._worker: Worker[None] = context.clock.worker(SAVE_LATENCY)
        self._is_stuck = False
        """Whether there is something in the way that must not be overwritten."""
        self._has_failed = False
        self._kept: Imprint | None = None
        self._written = -math.inf
        """When, in seconds of the clock."""
        self._mark: Mark | None = None
        """Of the file that was written last; None before."""
        self._forgettings = 0

    def recall(self, dynamics: Dynamics) -> Affect:
        """The feelings now, decayed over the time away; neutral without a memory."""
        now = self._clock.now()
        try:
            memory = recall(self._path)
        except HriError as error:
            self._put_aside(error)
            memory = None
        if memory is not None:
            imprint = switched_off(without_unnamed(memory.imprint), memory.time)
            memory = replace(memory, imprint=imprint)
        return self._resumed(memory, dynamics, now)

    def forgotten(self, dynamics: Dynamics) -> Affect | None:
        """The remaining feelings after a request to forget; None without one."""
        if not self._is_touched():
            return None
        try:
            memory = recall(self._path)
        except HriError as error:
            self._mark = None
            self._put_aside(error)
            return None
        if memory is not None and memory.forgettings == self._forgettings:
            self._mark = mark_of(self._path.stat()) if self._path.exists() else None
            return None  # another robot that has the same file; the last one to write wins
        self._mark = self._kept = None
        self._events.raise_event("memory.forgotten", file=str(self._path))
        return self._resumed(memory, dynamics, self._clock.now())

    def keep(self, affect: Affect, now: float) -> None:
        """Write it beside the loop, if the last time is a while ago: a short one if something has
        happened, else SIGN_OF_LIFE_S.

        Not over a file that someone has changed: what they had the robot forget comes first.
        """
        self._poll()
        wait = SIGN_OF_LIFE_S if affect.imprint is self._kept else KEEP_EVERY_S
        is_due = now - self._written >= wait
        if is_due and not self._is_stuck and not self._worker.is_busy and not self._is_touched():
            self._kept, self._written = affect.imprint, now
            self._worker.submit(partial(self._write, self._memory(affect)))

    def close(self, affect: Affect) -> None:
        """Write it now, unless something was forgotten meanwhile."""
        self._poll()
        self._worker.close()
        self._poll()
        if not self._is_stuck and not self._is_touched():
            try:
                self._write(replace(self._memory(affect), has_ended=True))
            except HriError as error:
                self._fail(error)

    def _resumed(self, memory: Memory | None, dynamics: Dynamics, now: float) -> Affect:
        if memory is None:
            return dynamics.rest(now)
        self._forgettings = memory.forgettings
        return dynamics.resume(memory.awakened(now, self._wall()), now)

    def _write(self, memory: Memory) -> None:
        if self._clock.is_fake:
            spare_real_time(self._path)
        self._mark = keep(self._path, memory)

    def _is_touched(self) -> bool:
        """Whether the file is not the one that was written last."""
        self._poll()
        if self._mark is None or self._worker.is_busy:
            return False
        try:
            return mark_of(self._path.stat()) != self._mark
        except OSError:
            return True

    def _memory(self, affect: Affect) -> Memory:
        now, wall = self._clock.now(), self._wall()
        return Memory(
            affect.imprint,
            now,
            wall,
            self._personality,
            self._forgettings,
            is_of_fake_time=self._clock.is_fake,
        )

    def _wall(self) -> float:
        return self._clock.wall().timestamp()

    def _poll(self) -> None:
        try:
            self._worker.poll()
        except HriError as error:
            self._fail(error)

    def _put_aside(self, problem: HriError) -> None:
        try:
            reason = (
                f"{problem} - it is kept as {put_aside(self._path)}, and the robot starts afresh"
            )
        except OSError as error:
            self._is_stuck = True  # or the end of this run would overwrite it
            reason = f"{problem} - nor can it be renamed ({error.strerror}): nothing is kept"
        log.error("%s: %s", self._path, reason)
        self._events.raise_event("memory.refused", file=str(self._path), reason=reason)

    def _fail(self, error: HriError) -> None:
        if not self._has_failed:
            self._has_failed = True
            log.error("%s", error)
            self._events.raise_event("memory.failed", file=str(self._path), reason=str(error))
