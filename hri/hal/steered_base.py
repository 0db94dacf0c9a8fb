"""A base that carries out one command at a time, of one writer at a time.

A velocity counts until the next command. While a motion runs, a timer of the clock repeats its
command every 20 ms, so the base's own watchdog stops it when this program falls silent. A stop
always wins; an emergency stop latches as that of a base with a supervisor does, but a base without
one starts released.
"""

from __future__ import annotations

import logging
import math
import threading
from abc import abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property

from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.hal.chassis import Chassis, Run
from hri.hal.drive import DriveSystem
from hri.hal.emergency_stop import EmergencyStop
from hri.hal.helm import HOLD, PROGRAM, Writer
from hri.hal.motion import (
    PERIOD,
    PROMPT,
    REST,
    Brake,
    Motion,
    Ramp,
    Reading,
    Response,
    SlowDown,
    Way,
)
from hri.hal.pending import Interrupted, Pending
from hri.hal.resource import Description, Resources

log = logging.getLogger("hri.resources")

FULL_POWER = 100.0


class _Here(threading.local):
    """What this thread is about."""

    is_stopping = False


class SteeredBase(DriveSystem, EmergencyStop):
    """Carries out commands over `_send`, `_brake`, `_set_power`, `_rolled` and `_velocity`."""

    response: Response = PROMPT
    """How the base follows what it is told."""

    def __init__(self, description: Description, manager: Resources) -> None:
        super().__init__(description, manager)
        self._here = _Here()

    @cached_property
    def _chassis(self) -> Chassis:
        return self.manager.shared(Chassis, self._hardware, lambda: Chassis(self.id))

    @property
    def _hardware(self) -> tuple[str, ...]:
        """Ids of what it moves; drives with the same ids are drives of one base."""
        return (self.id,)

    def _open(self) -> None:
        self._idle_power = 0.0
        self._move_power = FULL_POWER

    def deactivate(self) -> None:
        ended = None
        try:
            with self._lock, self._chassis.lock:
                if self._is_driving:
                    ended = self._forget()
                super().deactivate()
        finally:
            self._interrupt(ended, "the drive was closed - open it again")

    def _close(self) -> None:
        self._idle_power = 0.0
        if self._is_driving:
            self._try_to_rest()

    @property
    def _is_driving(self) -> bool:
        """Whether no other drive of this base gave the last command."""
        return self._chassis.driven_by in (None, self)

    # --- what a driver fills in ---

    @abstractmethod
    def _send(self, twist: Twist, now: float) -> None:
        """Pass a velocity on to the hardware."""

    @abstractmethod
    def _brake(self, now: float) -> None:
        """Let the hardware stop as fast as it can."""

    @abstractmethod
    def _set_power(self, percent: float, now: float) -> None:
        """Let the motors use a share of their force, 0 to 100."""

    @abstractmethod
    def _rolled(self, now: float) -> Way:
        """How far the wheels have carried the base since it was switched on."""

    @abstractmethod
    def _velocity(self, now: float) -> Twist:
        """What the wheels measure."""

    # --- who steers ---

    def claim(self, writer: Writer) -> None:
        with self._chassis.lock:
            self._chassis.helm.claim(writer)

    def leave(self, writer: Writer, now: float) -> None:
        self.let_go(writer, now)
        with self._chassis.lock:
            self._chassis.helm.leave(writer)

    def let_go(self, writer: Writer, now: float) -> None:
        with self._chassis.lock:
            if self._chassis.helm.is_free_for(writer, now):
                self.stop(now)

    # --- velocities ---

    def set_velocity(
        self, twist: Twist, now: float, until: float = math.inf, by: Writer = PROGRAM
    ) -> None:
        self._refuse_while_stopping()
        reason = "a velocity came in between - send none while it moves"
        with self._in_place_of_motion(reason, by, now + HOLD):
            if self._chassis.is_latched:
                self._brake(now)
            else:
                self._send(twist, now)
            self._expire_at(until)

    def stop(self, now: float) -> None:
        if not self.is_active:
            return  # closing it was a stop
        with self._stopping(), self._in_place_of_motion("the drive was stopped - start it again"):
            self._chassis.helm.let_go()
            self._brake(now)

    # --- the emergency stop ---

    @property
    def is_latched(self) -> bool:
        return self._chassis.is_latched

    def stop_latched(self, because: str) -> None:
        self._latch(because, None)

    def stop_spoken(self, because: str, said: float) -> None:
        self._latch(because, said)

    def _latch(self, because: str, said: float | None) -> None:
        chassis = self._chassis
        with chassis.lock:
            is_firm = chassis.is_latched and chassis.said is None
            chassis.said = None if is_firm else said
            chassis.is_latched, chassis.because = True, because
        self.stop(self.manager.clock.now())

    @property
    def is_spoken(self) -> bool:
        return self._chassis.is_latched and self._chassis.said is not None

    def unlatch(self) -> None:
        self._chassis.is_latched = False

    def unlatch_spoken(self, said: float) -> bool:
        chassis = self._chassis
        with chassis.lock:
            is_lifted = chassis.is_latched and chassis.said is not None and said > chassis.said
            if is_lifted:
                chassis.is_latched = False
        return is_lifted

    def explain(self) -> str:
        because = self._chassis.because
        return f"I stopped because {because}" if because else "I have not stopped"

    # --- velocities that expire ---

    def _expire_at(self, until: float) -> None:
        """Rest at a time, unless another command comes before it; one timer serves them all."""
        self._chassis.until = until
        if until < math.inf and self._chassis.expiry is None:
            self._chassis.expiry = self.manager.clock.call_at(until, self._expire)

    def _expire(self) -> None:
        with self._chassis.lock:
            self._chassis.expiry = None
            if self.manager.clock.now() < self._chassis.until:
                self._expire_at(self._chassis.until)
            elif isinstance(drive := self._chassis.driven_by, SteeredBase) and drive.is_active:
                drive._try_to_rest()

    # --- one motion instead of another ---

    def _begin(self, motion: Motion) -> Pending[None]:
        """Run a motion instead of the one before."""
        clock = self.manager.clock
        pending: Pending[None] = Pending(clock, on_cancel=lambda: self._abandon(pending))
        reason = "another command took its place - wait for the one before"
        with self._in_place_of_motion(reason, PROGRAM):
            now = clock.now()
            self._chassis.run = run = Run(motion, pending, now, now, self._rolled(now))
            self._set_power(self._move_power, now)
            self._tick(run)
        return pending

    @contextmanager
    def _in_place_of_motion(
        self, reason: str, by: Writer | None = None, until: float = math.inf
    ) -> Iterator[None]:
        """Give a command while no motion runs, `by` someone who steers until that time.

        Raises Outranked when someone else steers, and then changes nothing. Whoever asked for the
        motion that it ended hears of it last and outside of the lock, and may ask for the next.
        """
        ended = None
        try:
            with self._chassis.lock:
                self._refuse_closed()
                if by is not None:
                    self._chassis.helm.take(by, self.manager.clock.now(), until)
                ended = self._forget()
                self._chassis.driven_by = self
                try:
                    yield
                except Exception:
                    self._try_to_rest()
                    raise
        finally:
            self._interrupt(ended, reason)

    def _interrupt(self, run: Run | None, reason: str) -> None:
        if run is not None:
            run.pending.fail(Interrupted(f"{self.id}: {reason}"))

    def _forget(self) -> Run | None:
        """Let no motion run and no velocity expire; the motion that ran."""
        self._chassis.until = math.inf
        run, self._chassis.run = self._chassis.run, None
        if run is not None and run.timer is not None:
            run.timer.cancel()
        return run

    def _abandon(self, pending: Pending[None]) -> None:
        """Brake when the motion of that call still is the one that runs."""
        with self._chassis.lock:
            if self._chassis.run is not None and self._chassis.run.pending is pending:
                self._forget()
                self._chassis.helm.let_go()
                self._brake(self.manager.clock.now())

    @contextmanager
    def _stopping(self) -> Iterator[None]:
        """A stop wins: a callback that runs in here cannot start the next motion."""
        before, self._here.is_stopping = self._here.is_stopping, True
        try:
            yield
        finally:
            self._here.is_stopping = before

    def _refuse_while_stopping(self) -> None:
        if self.is_active and self._here.is_stopping:
            raise Interrupted(f"{self.id}: the drive is being stopped - move it afterwards")

    def _refuse_closed(self) -> None:
        if not self.is_active:
            raise HriError(f"{self.id}: the drive is closed - obtain it first")

    # --- the timer ---

    def _tick(self, run: Run) -> None:
        """Say the next command of a motion, unless something else has taken its place."""
        try:
            with self._chassis.lock:
                if self._chassis.run is not run or self._step(run):
                    return
                self._end()
        except Exception as error:
            self._fail(run, error)
        else:
            run.pending.complete(None)

    def _step(self, run: Run) -> bool:
        """Send a command; False when the motion is over."""
        if self.is_latched and not isinstance(run.motion, (SlowDown, Brake)):
            raise HriError(f"{self.explain()} - unlatch the base first")
        now = self.manager.clock.now()
        twist = run.motion.step(now - run.began, self._reading(run, now))
        if twist is None:
            return False
        if run.motion.is_braking:
            self._brake(now)
        else:
            self._send(twist, now)
        if isinstance(run.motion, Ramp) and run.motion.goal == REST == twist:
            self._chassis.helm.let_go()  # it has no end, but has nothing more to do
        run.due = max(run.due + PERIOD, now)
        run.timer = self.manager.clock.call_at(run.due, lambda: self._tick(run))
        return True

    def _reading(self, run: Run, now: float) -> Reading:
        rolled, origin = self._rolled(now), run.origin
        way = Way(rolled.linear - origin.linear, rolled.angular - origin.angular)
        return Reading(way, self._velocity(now), self.response)

    def _end(self) -> None:
        """Let the base rest, with no motion that runs."""
        self._forget()
        self._chassis.helm.let_go()
        now = self.manager.clock.now()
        try:
            self._brake(now)
        finally:
            self._set_power(self._idle_power, now)

    def _fail(self, run: Run, error: Exception) -> None:
        """End a motion that cannot go on, whatever the hardware says to that."""
        with self._chassis.lock:
            if self._chassis.run is run:
                self._try_to_rest()
        if not isinstance(error, HriError):
            log.error("%s: a motion failed: %s", self.id, error, exc_info=error)
            error = HriError(f"{error or type(error).__name__} - see that the base is connected")
        run.pending.fail(HriError(f"{self.id}: {error}"))

    def _try_to_rest(self) -> None:
        try:
            self._end()
        except Exception as error:
            log.error("%s: it does not stop: %s - switch the base off", self.id, error)
