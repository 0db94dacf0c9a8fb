"""Who steers a base, and the one motion that runs on it, for all drives of the base.

A motion repeats its command every PERIOD, so the supervisor stops the base when this program falls
silent. One motion takes the place of another; a stop ends any, and nothing can begin within it.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from hri.core.clock import Timer
from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.drive import DriveSystem
from hri.hal.manner import FREELY, Manner
from hri.hal.motion import (
    PERIOD,
    REST,
    Brake,
    Motion,
    Ramp,
    Reading,
    SlowDown,
    Way,
)
from hri.hal.pending import Interrupted, Pending
from hri.hal.rank import PROGRAM, WRITERS, Outranked, Rank, Writer

FULL_POWER = 100.0
log = logging.getLogger("hri.resources")


@dataclass(eq=False)
class Run:
    """A motion on its way."""

    drive: DriveSystem
    motion: Motion
    pending: Pending[None]
    began: float
    due: float
    """When its next command is sent."""
    origin: Way
    """What the wheels had rolled when it began."""
    timer: Timer | None = None


class _Here(threading.local):
    """What this thread is about."""

    is_stopping = False


class Steering:
    """One for a base, however many drives the configuration has on it."""

    def __init__(self, bus: BaseBus) -> None:
        self.lock = threading.RLock()
        self.driven_by: DriveSystem | None = None
        """The drive that gave the last command."""
        self.run: Run | None = None
        self.idle_power, self.move_power = 0.0, FULL_POWER
        """Percent of the force that motors may use while it stands, and for motions."""
        self._bus, self._clock = bus, bus.manager.clock
        self._here = _Here()
        self._claims: list[Writer] = []
        self._said: dict[object, Writer] = {}
        """By the owners of the words that the supervisor may still have."""

    # --- who steers ---

    def claim(self, writer: Writer) -> None:
        """Be the only one of that rank until `leave`. Raises HriError when there is one already."""
        with self.lock:
            for other in self._claims:
                if other.rank is writer.rank and other.owner is not writer.owner:
                    raise HriError(
                        f"{self._bus.id}: {other.name} steers it already, with the same rank "
                        f"({other.rank}) as {writer.name} - stop one of them, or give it another "
                        "rank"
                    )
            self._claims.append(writer)

    def leave(self, writer: Writer) -> None:
        """Give up what was claimed; who claimed nothing does nothing."""
        with self.lock:
            self._claims = [other for other in self._claims if other.owner is not writer.owner]

    def is_free_for(self, writer: Writer) -> bool:
        """Whether nobody else steers."""
        return self.run is None and self._before(writer, tuple(Rank)) is None

    def ask(self, writer: Writer, twist: Twist, said: float, manner: Manner) -> None:
        """Tell the supervisor what someone wants, as of the time they said it."""
        last = self._said.get(writer.owner)
        if last is not None and last.rank is not writer.rank:
            self._bus.ask(last.rank, None)
        self._said[writer.owner] = writer
        self._bus.ask(writer.rank, twist, said, manner)

    def take_back(self, writer: Writer) -> None:
        """Ask for nothing more: the base slows down gently, unless someone else steers it."""
        with self.lock:
            last = self._said.pop(writer.owner, None)
            if last is not None:
                self._bus.ask(last.rank, None)

    def _refuse_outranked(self, writer: Writer) -> None:
        """Raise Outranked while another writer steers who is not less important."""
        ranks = WRITERS[: WRITERS.index(writer.rank) + 1]
        other = self._before(writer, ranks)
        if other is not None:
            raise Outranked(
                f"{self._bus.id}: {other.name} steers it (rank {other.rank}), which "
                f"{writer.name} ({writer.rank}) may not interrupt - wait until it has ended"
            )

    def _before(self, writer: Writer, ranks: tuple[Rank, ...]) -> Writer | None:
        """Another one who has asked with one of these ranks, and whose word still counts."""
        for rank in self._bus.waiting:
            names = [one for one in self._said.values() if one.rank is rank]
            if rank in ranks and not any(one.owner is writer.owner for one in names):
                return names[-1] if names else Writer(rank, "someone", rank)
        return None

    # --- one command instead of another ---

    @contextmanager
    def instead(self, drive: DriveSystem, reason: str, by: Writer | None = None) -> Iterator[None]:
        """Give a command while no motion runs, `by` someone who steers.

        Raises Outranked when someone else steers, and then changes nothing. Whoever asked for the
        motion that it ended hears of it last and outside of the lock, and may ask for the next.
        """
        ended = None
        try:
            with self.lock:
                if by is not None:
                    self._refuse_outranked(by)
                ended, self.driven_by = self.forget(), drive
                try:
                    yield
                except Exception:
                    self.try_to_rest(drive)
                    raise
        finally:
            self.interrupt(ended, reason)

    @contextmanager
    def stopping(self) -> Iterator[None]:
        """A stop wins: a callback that runs in here cannot start the next motion."""
        before, self._here.is_stopping = self._here.is_stopping, True
        try:
            yield
        finally:
            self._here.is_stopping = before

    def refuse_while_stopping(self, drive: DriveSystem) -> None:
        """Raise Interrupted within a stop."""
        if self._here.is_stopping:
            raise Interrupted(f"{drive.id}: the drive is being stopped - move it afterwards")

    def stop(self) -> None:
        """Stand still at once, whoever steers."""
        self._said.clear()
        self._bus.brake()

    def slow_down(self) -> None:
        """Take back all that anyone has asked for."""
        self._said.clear()
        for rank in WRITERS:
            self._bus.ask(rank, None)

    def interrupt(self, run: Run | None, reason: str) -> None:
        """Tell who asked for a motion that it has ended early."""
        if run is not None:
            run.pending.fail(Interrupted(f"{run.drive.id}: {reason}"))

    def forget(self) -> Run | None:
        """Let no motion run; the motion that ran."""
        run, self.run = self.run, None
        if run is not None and run.timer is not None:
            run.timer.cancel()
        return run

    # --- motions ---

    def begin(self, drive: DriveSystem, motion: Motion) -> Pending[None]:
        """Run a motion instead of the one before. Raises Outranked."""
        pending: Pending[None] = Pending(self._clock, on_cancel=lambda: self._abandon(pending))
        reason = "another command took its place - wait for the one before"
        with self.instead(drive, reason, PROGRAM):
            now = self._clock.now()
            rolled = self._bus.report().rolled
            self.run = run = Run(drive, motion, pending, now, now, rolled)
            self._bus.set_power(self.move_power, now)
            self._tick(run)
        return pending

    def rest(self) -> None:
        """Let the base rest, with no motion that runs, and hold its place with its idle power."""
        self.forget()
        try:
            self.stop()
        finally:
            self._bus.set_power(self.idle_power, self._clock.now())

    def _abandon(self, pending: Pending[None]) -> None:
        """Brake when the motion of that call still is the one that runs."""
        with self.lock:
            if self.run is not None and self.run.pending is pending:
                self.forget()
                self.stop()

    def _tick(self, run: Run) -> None:
        """Say the next command of a motion, unless something else has taken its place."""
        try:
            with self.lock:
                if self.run is not run or self._step(run):
                    return
                self.rest()
        except Exception as error:
            self._fail(run, error)
        else:
            run.pending.complete(None)

    def _step(self, run: Run) -> bool:
        """Send a command; False when the motion is over."""
        self._bus.look()
        if self._bus.is_latched and not isinstance(run.motion, (SlowDown, Brake)):
            raise HriError(f"{self._bus.explain()} - unlatch the base first")
        now = self._clock.now()
        twist = run.motion.step(now - run.began, self._reading(run, now))
        if twist is None:
            return False
        if run.motion.is_braking:
            self.stop()
        elif isinstance(run.motion, Ramp) and run.motion.goal == REST == twist:
            self.take_back(PROGRAM)  # it has no end, but has nothing more to do
        else:
            self.ask(PROGRAM, twist, now, FREELY)
        run.due = max(run.due + PERIOD, now)
        run.timer = self._clock.call_at(run.due, lambda: self._tick(run))
        return True

    def _reading(self, run: Run, now: float) -> Reading:
        """What the wheels have done by now: a report is some time old."""
        report, origin, age = self._bus.report(), run.origin, self._bus.age(now)
        rolled, velocity = report.rolled, report.velocity or REST
        way = Way(
            rolled.linear - origin.linear + velocity.linear * age,
            rolled.angular - origin.angular + velocity.angular * age,
        )
        return Reading(way, velocity, self._bus.response)

    def _fail(self, run: Run, error: Exception) -> None:
        """End a motion that cannot go on, whatever the hardware says to that."""
        with self.lock:
            if self.run is run:
                self.try_to_rest(run.drive)
        if not isinstance(error, HriError):
            log.error("%s: a motion failed: %s", run.drive.id, error, exc_info=error)
            error = HriError(f"{error or type(error).__name__} - see that the base is connected")
        run.pending.fail(HriError(f"{run.drive.id}: {error}"))

    def try_to_rest(self, drive: DriveSystem) -> None:
        try:
            self.rest()
        except Exception as error:
            log.error("%s: it does not stop: %s - switch the base off", drive.id, error)
