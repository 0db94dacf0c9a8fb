"""Claims: what only one task may use at a time, and who gives way.

async with context.claim("drive", priority=1):
    ...

Of two tasks the one with the higher priority has it: it interrupts a lower one, and a lower one
waits for it. Between equals the table `CONFLICTS` decides. Whoever is interrupted is cancelled at
the end of its `async with`, which raises `Interrupted` with the reason.

Inside of a claim the same task, and the tasks it runs in parallel, claim from each other: a task
that follows a person claims the drive once and moves many times.
"""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from contextvars import ContextVar
from enum import Enum

import trio

from hri.core.clock import Clock
from hri.hal.pending import Interrupted

__all__ = ["CONFLICTS", "Claims", "Conflict", "Interrupted"]


class Conflict(Enum):
    """How a claim is settled between two tasks of equal priority."""

    WAIT = "wait"
    INTERRUPT = "interrupt"


CONFLICTS = {"drive": Conflict.INTERRUPT, "face": Conflict.INTERRUPT, "voice": Conflict.WAIT}
"""By name: a newer motion replaces the older one, sentences queue. All other names wait."""


class Hold:
    """One task's claim, granted or waiting."""

    def __init__(self, priority: int, owner: str) -> None:
        self.priority = priority
        self.owner = owner
        self.scope = trio.CancelScope()
        self.granted = trio.Event()
        self.taken_by = ""
        """Who interrupted it."""
        self.inner = Arena()


class Arena:
    """One thing that is claimed: its holder and those who wait, first come, first served."""

    def __init__(self) -> None:
        self.holder: Hold | None = None
        self.waiting: list[Hold] = []

    def enter(self, hold: Hold, conflict: Conflict) -> None:
        """Queue up, and interrupt the holder where that is due."""
        self.waiting.append(hold)
        holder = self.holder
        if holder is None:
            return
        is_equal = hold.priority == holder.priority
        if hold.priority > holder.priority or (is_equal and conflict is Conflict.INTERRUPT):
            self._interrupt(holder, hold)
        if conflict is Conflict.INTERRUPT:
            # Of several newer commands only the newest still counts.
            for other in self.waiting[:-1]:
                if other.priority == hold.priority:
                    self._interrupt(other, hold)

    def leave(self, hold: Hold) -> None:
        """Give it back, or no longer wait for it."""
        if hold in self.waiting:
            self.waiting.remove(hold)
        if self.holder is hold:
            self.holder = None

    def next(self) -> Hold | None:
        """Give what is free to the first of the highest priority."""
        if self.holder is not None or not self.waiting:
            return None
        self.holder = max(self.waiting, key=lambda hold: hold.priority)
        self.waiting.remove(self.holder)
        return self.holder

    @staticmethod
    def _interrupt(hold: Hold, by: Hold) -> None:
        if not hold.taken_by:
            hold.taken_by = by.owner
            hold.scope.cancel()


class Leave:
    """What a task that was installed, with all the tasks it runs, has claimed and may not claim."""

    def __init__(self) -> None:
        self.claimed: set[str] = set()
        self.refused: set[str] = set()


_held: ContextVar[dict[str, Hold]] = ContextVar("held")
"""What the running task, or one above it, holds by name."""
_leave: ContextVar[Leave] = ContextVar("leave")
"""Of the installed task that runs."""


def forget_claims(leave: Leave) -> None:
    """Let a task installed by a holder claim like any other, with its own permission."""
    _held.set({})
    _leave.set(leave)


class Claims:
    """All that is claimed on one robot; used from the robot loop only."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._arenas: dict[str, Arena] = {}

    def holder(self, name: str) -> str | None:
        """The name of the task that holds it now."""
        holder = self._arenas[name].holder if name in self._arenas else None
        return None if holder is None else holder.owner

    @asynccontextmanager
    async def claim(
        self, name: str, priority: int = 0, owner: str = "a task"
    ) -> AsyncIterator[None]:
        """Hold it while the body runs; waits until it is free. Raises Interrupted."""
        leave = _leave.get(Leave())
        leave.claimed.add(name)
        if name in leave.refused:
            raise Interrupted(f"{owner} had to leave the {name} - start it again")
        above = _held.get({})
        outer = above.get(name)
        arena = self._arenas.setdefault(name, Arena()) if outer is None else outer.inner
        hold = Hold(priority, owner)
        with hold.scope:
            try:
                arena.enter(hold, CONFLICTS.get(name, Conflict.WAIT))
                self._grant(arena)
                await hold.granted.wait()
                token = _held.set({**above, name: hold})
                try:
                    yield
                finally:
                    _held.reset(token)
            finally:
                arena.leave(hold)
                self._grant(arena)
        if hold.scope.cancelled_caught:
            # Another part of the same task, or another run of it, has the same name.
            by = f"a newer claim of {owner}" if hold.taken_by == owner else hold.taken_by
            raise Interrupted(f"{by} has taken the {name} - try again when it is free")

    def _grant(self, arena: Arena) -> None:
        if (hold := arena.next()) is not None:
            # Through the clock, so that on fake time those who wait wake one after the other.
            self._clock.soon(hold.granted.set)
