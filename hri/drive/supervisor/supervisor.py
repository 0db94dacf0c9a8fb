"""Decides what the wheels may do: pure arithmetic on reports, commands and time.

Nobody can talk it out of anything. It begins latched; `release` is for people. No input makes
it raise an exception; input that it does not understand is a reason to stand.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from hri.core.signals import Twist
from hri.drive.bases.protocol import BaseReport
from hri.drive.supervisor.base_rules import Rules
from hri.drive.supervisor.cause import (
    COMING,
    DISOBEYS,
    DONE,
    FROZEN,
    GARBLED,
    NO_WATCHDOG,
    OBSTACLE,
    POWER_UP,
    SILENT_BASE,
    UNSTEADY,
    Cause,
    late,
)
from hri.drive.supervisor.cliffs import Floor
from hri.drive.supervisor.decision import Decision
from hri.drive.supervisor.free_space import Room, room
from hri.drive.supervisor.hazards import (
    Fault,
    Hazard,
    Kind,
    Sensor,
    dropped_wheel,
    hazards_of,
    pressed_buttons,
    pressing,
)
from hri.drive.supervisor.lag import Lag
from hri.drive.supervisor.latch import Latch
from hri.drive.supervisor.limiter import Limiter
from hri.drive.supervisor.oncoming import Oncoming
from hri.drive.supervisor.person_distance import Nearness
from hri.drive.supervisor.plausibility import Plausibility
from hri.drive.supervisor.reflex import Reflex
from hri.drive.supervisor.repeated_silence import Silences
from hri.drive.supervisor.velocity_arbiter import Command, VelocityArbiter
from hri.drive.velocity_limits import Cap, safe_speed, within, within_hardware
from hri.hal.manner import FREELY, Manner
from hri.hal.motion import REST
from hri.hal.rank import Rank

STALE = 0.1
"""Seconds after which a report is stale; three periods for a slower base."""
LOST = 1.0
"""Seconds without a report after which only a release helps."""
GAP = 0.1
"""Seconds between two steps after which all that was known is old; the watchdog stops the base a
little later. A longer one than LOST needs a release."""
MOST_NOISE = 0.3
"""Part of the bytes from the base that may make no sense; one wrong byte in a thousand spoils every
fifteenth report of a Create 2, one in a hundred every second."""
WAKING = 1.5
"""Seconds that a base may take to obey again after its own guard has stopped it."""


class Supervisor:
    """One base's guard. Not safe to use from several threads."""

    def __init__(self, rules: Rules, cause: Cause = POWER_UP) -> None:
        """`cause`: why it begins latched."""
        self.rules = rules
        self.latch = Latch(cause)
        self.faults: Sequence[Fault] = ()
        """Sensors that cannot be believed."""
        self.refusals: list[str] = []
        """The refusals since the last read, at most ten; reading clears them."""
        self.room = Room()
        """What is free before the body."""
        self.is_watched = True
        """Whether the watchdog answers; without it the base rests."""
        self._allowed = {
            is_near: within_hardware(rules.limits.cap(is_near), rules.fastest)
            for is_near in (False, True)
        }
        self._arbiter = VelocityArbiter(rules.fastest)
        self._limiter = Limiter(rules.limits)
        # On the spot, the wheels run as fast as straight on, half the track from the middle.
        half_track = rules.fastest.linear / rules.fastest.angular
        self._plausibility = Plausibility(rules.sensors, half_track)
        self._lag = Lag(half_track)
        self._oncoming = Oncoming(rules.mounts, rules.body.reach)
        self._floor = Floor()
        self._reflex = Reflex()
        self._hazards: Sequence[Hazard] = ()
        self._pressed: Sequence[Sensor] = ()
        """Buttons."""
        self._holding: Sequence[Cause] = ()
        """Why it must stand for as long as these last."""
        self._silences = Silences()
        self._must_cut = False
        self._report: BaseReport | None = None
        self._judged = -math.inf
        """The time of the last report that was looked at."""
        self._time: float | None = None
        self._sent = REST
        self._nearness = Nearness()
        self._waking_since: float | None = None
        self._was_released = False
        self._news: Cause | None = None
        self._refused: str | None = None
        """Why the last command was."""

    @property
    def is_near(self) -> bool:
        """Whether someone is near, or nobody knows; as of the last step."""
        return self._time is None or self._nearness.is_near(self._time)

    @property
    def allowed(self) -> Cap:
        """How fast it may go by who is near and by its hardware."""
        return self._allowed[self.is_near]

    def waiting(self, now: float) -> list[Rank]:
        """The sources that ask for something, the most important first."""
        return self._arbiter.waiting(now)

    # --- what happens to it ---

    def trip(self, cause: Cause) -> None:
        """Stop at once, until someone releases the base."""
        if self.latch.trip(cause):
            self._news = cause
        self._arbiter.clear()
        self._reflex.cancel()

    def release(self, now: float) -> None:
        """Open the latch: someone says that the base may move. What was asked before is void.

        Refused while the base is silent, since nobody knows what it stands before, while a wheel
        hangs in the air, and while someone presses a button.
        """
        report = self._report
        if report is None or self._is_lost(now):
            self._refuse("I cannot be released while my base is silent")
            return
        if dropped_wheel(report) is not None:
            self._refuse("I cannot be released while a wheel hangs in the air")
            return
        if self._pressed:
            self._refuse(f"I cannot be released while someone presses my {self._pressed[0]}")
            return
        self.latch.release()
        self._arbiter.clear()
        self._was_released = True

    def brake(self) -> None:
        """Stand still at once and forget what was asked, without latching."""
        self._arbiter.clear()
        self._limiter.halt()

    def hear_person(self, distance: float, now: float) -> None:
        """How far the nearest person is, meters; infinite when surely nobody is about."""
        self._nearness.hear(distance, now)

    def hear_noise(self, share: float) -> None:
        """How much of what the base says makes no sense, 0 to 1; too much latches the base."""
        if share > MOST_NOISE and not self.latch.is_firm:
            self.trip(GARBLED)

    # --- what it decides ---

    def step(
        self, now: float, report: BaseReport | None, commands: Sequence[Command] = ()
    ) -> Decision:
        """The decision for the wheels at `now`, by the newest report and the commands since."""
        dt = self._step_to(now)
        refused = self._take(commands)
        self._judge(now, report)
        decision = self._decided(now, dt, report, refused)
        if decision.twist == REST != self._sent:
            self._news = decision.reason
        self._sent = decision.twist
        news, self._news = self._news, None
        must_cut, self._must_cut = self._must_cut, False
        if news is None and not must_cut:
            return decision
        return replace(decision, stop=news, must_cut=must_cut)

    def _step_to(self, now: float) -> float:
        before, self._time = self._time, now
        dt = 0.0 if before is None else now - before
        self._lag.tell(now, self._sent)
        if 0 <= dt <= GAP:
            return dt
        self._lag.forget()
        # Nobody watched; a base that still goes was stopped meanwhile, or is now.
        self._limiter.halt()
        self._arbiter.clear()
        if self._sent != REST:
            self._news, self._sent = FROZEN, REST
        if not 0 <= dt <= LOST and not self.latch.is_firm:
            self.trip(FROZEN)
        return 0.0

    def _take(self, commands: Sequence[Command]) -> str | None:
        """The last refusal among these commands; what is refused again and again is told once."""
        refused = None
        for command in commands:
            refused = self._arbiter.offer(command)
            if refused is not None and refused != self._refused:
                self._refuse(refused)
            self._refused = refused
        return refused

    def _refuse(self, words: str) -> None:
        self.refusals = [*self.refusals[-9:], words]

    def _judge(self, now: float, report: BaseReport | None) -> None:
        """Look for what is wrong; a report is looked at once."""
        if report is None or report is self._report:
            self._trip_if_lost(now)
            return
        self._report, self._judged = report, report.time
        lights = self._floor.step(report)
        self.faults = self._plausibility.step(now, report, lights, self._sent)
        self._take_note(hazards_of(report, lights, self.faults))
        faulty = {f.sensor.place for f in self.faults if f.sensor.kind is Kind.RANGE}
        self.room = room(report.ranges, self.rules.mounts, self.rules.body, faulty)
        sound = {name: d for name, d in report.ranges.items() if name not in faulty}
        self._oncoming.see(report.time, report.rolled, sound)
        pressed = pressed_buttons(report)
        self._must_cut |= pressed != self._pressed
        self._pressed = pressed
        self._hold(dropped_wheel(report), self._dead_wheels(), *map(pressing, pressed))
        self._trip_if_late(report)

    def _take_note(self, hazards: Sequence[Hazard]) -> None:
        """What it meets while a spoken stop holds it is a reason to stand that no order lifts."""
        known = {hazard.sensor for hazard in self._hazards}
        news = [hazard for hazard in hazards if hazard.sensor not in known]
        self._hazards = hazards
        if news and self.latch.is_closed and not self.latch.is_firm:
            self.trip(news[0].cause)

    def _hold(self, *found: Cause | None) -> None:
        """Latch when one of these begins, and whenever the latch is open while it lasts."""
        causes = [cause for cause in found if cause is not None]
        for cause in causes:
            if cause not in self._holding or not self.latch.is_closed:
                self.trip(cause)
        self._holding = causes

    def _trip_if_late(self, report: BaseReport) -> None:
        lag = self._lag.hear(report.time, report.rolled)
        if lag is not None:
            self._lag.forget()
            if not self.latch.is_firm:
                self.trip(late(lag))

    def _trip_if_lost(self, now: float) -> None:
        if self._is_lost(now) and not self.latch.is_firm:
            self.trip(SILENT_BASE)

    def _is_lost(self, now: float) -> bool:
        # A report from the future, or without a time, says nothing about now.
        return not 0 <= now - self._judged <= LOST

    def _dead_wheels(self) -> Cause | None:
        fault = next((f for f in self.faults if f.sensor.kind is Kind.WHEELS), None)
        return None if fault is None else Cause("fault", fault.words)

    def _decided(
        self, now: float, dt: float, report: BaseReport | None, refused: str | None
    ) -> Decision:
        if self.latch.cause is not None:
            return self._rest(Rank.LATCH, self.latch.cause)
        if not self.is_watched:
            return self._rest(Rank.REFLEX, NO_WATCHDOG)
        if report is None or not 0 <= now - report.time <= max(STALE, 3 * self.rules.period):
            self._reflex.cancel()
            return self._silent(now)
        wanted = self._reflex.step(now, self._hazards, report.rolled, self._sent)
        if not report.obeys:
            return self._waking(now)
        self._waking_since, self._was_released = None, False
        if wanted is not None:
            return self._reflected(wanted, dt)
        return self._obeyed(now, dt, refused)

    def _rest(self, level: Rank, cause: Cause) -> Decision:
        return Decision(self._limiter.halt(), level, cause)

    def _silent(self, now: float) -> Decision:
        if self._sent != REST and self._silences.add(now):
            self.trip(UNSTEADY)
            return self._rest(Rank.LATCH, UNSTEADY)
        return self._rest(Rank.REFLEX, SILENT_BASE)

    def _waking(self, now: float) -> Decision:
        """The base does not obey: its own guard saw what we saw, or someone has switched it."""
        is_expected = self._reflex.cause is not None or self._was_released
        if self._waking_since is None and is_expected:
            self._waking_since = now
            return replace(self._rest(Rank.REFLEX, self._reflex.cause or DISOBEYS), must_wake=True)
        if self._waking_since is not None and now - self._waking_since <= WAKING:
            return self._rest(Rank.REFLEX, self._reflex.cause or DISOBEYS)
        self._waking_since, self._was_released = None, False
        self.trip(DISOBEYS)
        return self._rest(Rank.LATCH, DISOBEYS)

    def _reflected(self, wanted: Twist, dt: float) -> Decision:
        cause = self._reflex.cause or DONE
        if wanted == REST:
            return self._rest(Rank.REFLEX, cause)
        cap = replace(self._cap(self.allowed), forward=0.0)
        return Decision(self._limiter.step(wanted, cap, dt), Rank.REFLEX, cause)

    @property
    def _is_heading_for_a_hazard(self) -> bool:
        moving = self._sent.linear
        return any(moving < 0 if h.is_behind else moving > 0 for h in self._hazards)

    def _obeyed(self, now: float, dt: float, refused: str | None) -> Decision:
        command = self._arbiter.chosen(now)
        if command is None or command.twist is None:
            return self._unasked(now, dt, refused)
        allowed = within_hardware(self.allowed, command.manner.fastest)
        cap, cause = self._cap(allowed, command.manner), DONE
        if self._hazards:
            cause = self._hazards[0].cause
            if self._is_heading_for_a_hazard:
                return self._rest(Rank.REFLEX, cause)
        elif _is_blocked(command.twist, cap):
            cause = COMING if self._coming <= 0 else OBSTACLE
        # What is too fast keeps its curve; what is in the way takes nothing from turning away.
        curve = within(command.twist, allowed)
        target = Twist(max(-cap.backward, min(cap.forward, curve.linear)), curve.angular)
        velocity = self._limiter.step(target, cap, dt, command.manner)
        return Decision(velocity, command.source, cause, target)

    def _unasked(self, now: float, dt: float, refused: str | None) -> Decision:
        """Nobody asks for anything: at once when someone fell silent, else gently."""
        silent = self._arbiter.silent(now)
        if silent is not None:
            return self._rest(Rank.NOBODY, Cause("timeout", f"my {silent} fell silent"))
        if refused is not None:
            return self._rest(Rank.NOBODY, Cause("refused", f"I was asked for nonsense: {refused}"))
        return Decision(self._limiter.step(REST, self._cap(self.allowed), dt), Rank.NOBODY, DONE)

    @property
    def _coming(self) -> float:
        """How fast it may go for those who come near, m/s."""
        now, watch = self._judged, self._oncoming
        return min(watch.speed(now, self.rules.limits.deceleration), watch.pace(now))

    def _cap(self, allowed: Cap, manner: Manner = FREELY) -> Cap:
        """How fast it may go now, with what is in the way."""
        clearance = self.rules.body.clearance
        moving, deceleration = self._sent.linear, self.rules.limits.deceleration
        ahead = min(
            safe_speed(self.room.ahead, clearance, deceleration, moving > 0),
            safe_speed(manner.free, manner.clearance, deceleration, moving > 0),
        )
        behind = safe_speed(self.room.behind, clearance, deceleration, moving < 0)
        for hazard in self._hazards:
            ahead, behind = (ahead, 0.0) if hazard.is_behind else (0.0, behind)
        coming = self._coming
        forward, backward = (
            min(allowed.forward, ahead, coming),
            min(allowed.backward, behind, coming),
        )
        return Cap(forward, backward, allowed.angular)


def _is_blocked(twist: Twist, cap: Cap) -> bool:
    """Whether there is no way at all where it wants to go."""
    return (twist.linear > 0 and cap.forward <= 0) or (twist.linear < 0 and cap.backward <= 0)
