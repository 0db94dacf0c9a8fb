"""Drives one base over one port as its supervisor decides: turn by turn, never waiting.

Its owner, a separate process or the clock of a simulation, calls `turn` every TURN
seconds, and at once when bytes or orders have come.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace

from hri.core.errors import HriError, NotAvailable
from hri.drive.bases.protocol import BaseProtocol, BaseReport, Greeting
from hri.drive.supervisor.cause import DOCKING, DONE, JAMMED, LOST_PORT, Cause
from hri.drive.supervisor.decision import Decision
from hri.drive.supervisor.link import (
    Ask,
    Brake,
    Dock,
    Extra,
    Lamps,
    Nearest,
    Numbered,
    Order,
    Release,
    Song,
    State,
    Trip,
)
from hri.drive.supervisor.noise import Noise
from hri.drive.supervisor.supervisor import Supervisor
from hri.drive.supervisor.velocity_arbiter import Command
from hri.hal.motion import REST, Way
from hri.hal.port import Port
from hri.hal.rank import Rank

TURN = 0.01
"""Seconds between two turns at most."""
SAME = 1e-6
"""Seconds; times that differ by no more are one: sums of fractions are not exact."""
REFRESH = 0.05
"""Seconds after which the velocity is repeated: bytes may be lost, and a base may time out."""
SILENCE = 1.5
"""Seconds without a report after which the base is woken, if possible, and greeted again."""
DEED_FRESH = 1.0
"""Seconds; a release, or a way to the dock, that lay in a queue for longer is not heard."""
NEWS = 8
"""Stops and refusals that are kept."""


class Controller:
    """One base: its port, its protocol, its supervisor."""

    def __init__(
        self, make: Callable[[], BaseProtocol], port: Port, supervisor: Supervisor
    ) -> None:
        """`make` gives a new protocol for each opening of the port."""
        self.port = port
        self.supervisor = supervisor
        self.protocol = make()
        self.openings = 0
        """How often the port was opened."""
        self._make = make
        self._report: BaseReport | None = None
        self._carried = Way()
        """What the wheels rolled in former openings."""
        self._noise = Noise()
        self._greetings: deque[Greeting] = deque()
        self._is_opening = False
        """Whether the base is being greeted as a stranger: what it says is from before."""
        self._greet_at = 0.0
        self._greeted_at = -math.inf
        self._decision = Decision(REST, Rank.LATCH, DONE)
        self._told, self._told_at = REST, -math.inf
        self._must_cut = False
        """Whether the emergency stop goes before all else that waits on the line."""
        self._news: deque[Numbered] = deque(maxlen=NEWS)
        self._count = 0

    def turn(self, now: float, orders: Sequence[Order] = ()) -> Decision:
        """Hear the base and the program, decide, and tell the wheels."""
        commands = [c for order in orders if (c := self._taken(order, now)) is not None]
        reports = self._heard(now)
        # Each report counts: a touch may be over in the next.
        for report in reports[:-1]:
            self._decide(now, report, ())
        self._decide(now, self._report, commands)
        if self.port.is_open:
            self._guarded(self._tell, now)
        return self._decision

    def state(self, now: float) -> State:
        """For the program."""
        decision, latch = self._decision, self.supervisor.latch
        return State(
            time=now,
            report=self._report,
            velocity=decision.twist,
            target=decision.target,
            level=decision.level,
            reason=latch.cause or decision.reason,
            is_latched=latch.is_closed,
            is_open=self.port.is_open,
            trouble=self.port.reason,
            allowed=self.supervisor.allowed,
            waiting=tuple(self.supervisor.waiting(now)),
            faults=tuple(fault.words for fault in self.supervisor.faults),
            news=tuple(self._news),
        )

    def close(self, now: float) -> None:
        """Stop the base and let the port go; a second call does nothing."""
        if self.port.is_open:
            last_words = self.protocol.emergency_stop + self.protocol.farewell
            self._guarded(lambda at: self._write(last_words, at), now)
        self.port.close()

    # --- what is heard ---

    def _taken(self, order: Order, now: float) -> Command | None:
        match order:
            case Ask(source, twist, echo, manner) if echo <= now:
                return Command(source, twist, echo, manner)
            case Brake():
                self.supervisor.brake()
            case Trip(cause):
                self.supervisor.trip(cause)
                self._must_cut = True
            case Release(echo, cause) if _is_fresh(echo, now):
                if cause == self.supervisor.latch.cause:
                    self.supervisor.release(now)
            case Nearest(distance, echo):
                self.supervisor.hear_person(distance, echo)
            case Song() | Lamps() | Dock():
                self._do(order, now)
        return None

    def _do(self, extra: Extra, now: float) -> None:
        """What a base can do besides, unless something more important is being said to it."""
        try:
            data = self._extra(extra, now)
        except HriError as error:
            self._tell_news(Cause("refused", str(error)))
            return
        self._guarded(lambda at: self._write(data, at), now)
        if isinstance(extra, Dock):
            self.supervisor.trip(DOCKING)

    def _extra(self, extra: Extra, now: float) -> bytes:
        """Raises HriError for what cannot be."""
        if not self.port.is_open or self._greetings or self._must_cut:
            raise NotAvailable("the base is not ready - try it again in a moment")
        match extra:
            case Song(notes):
                return self.protocol.song(notes)
            case Lamps(power, is_dock_lit):
                return self.protocol.leds(power, is_dock_lit)
            case Dock(echo):
                if self.supervisor.latch.is_closed or not _is_fresh(echo, now):
                    raise HriError("the base is latched - release it, then send it to its dock")
                return self.protocol.dock()

    def _heard(self, now: float) -> list[BaseReport]:
        """The reports that have come, after the port was opened where it was closed."""
        if not self.port.is_open:
            if not self.port.open(now):
                return []
            self._begin(now)
        reports: list[BaseReport] = []
        self._guarded(lambda at: reports.extend(self._fed(self.port.read(at), at)), now)
        return reports

    def _begin(self, now: float) -> None:
        """Speak to a base that may have forgotten everything."""
        if self._report is not None:
            self._carried = self._report.rolled
        self.protocol = self._make()
        self.openings += 1
        self._is_opening = True
        self._noise = Noise()
        self._greet(now)

    def _greet(self, now: float, waking: Sequence[Greeting] = ()) -> None:
        self._greetings, self._greet_at = deque([*waking, *self.protocol.greeting()]), now
        self._greeted_at = now

    def _fed(self, data: bytes, now: float) -> list[BaseReport]:
        reports, senseless = [], self.protocol.senseless
        for report in self.protocol.feed(data, now):
            rolled, carried = report.rolled, self._carried
            way = Way(rolled.linear + carried.linear, rolled.angular + carried.angular)
            reports.append(replace(report, rolled=way))
        if self._is_opening:
            return []
        self._noise.add(len(data), self.protocol.senseless - senseless, now)
        self.supervisor.hear_noise(self._noise.share)
        if reports:
            self._report = reports[-1]
        return reports

    # --- what is decided ---

    def _decide(self, now: float, report: BaseReport | None, commands: Sequence[Command]) -> None:
        self._decision = decision = self.supervisor.step(now, report, commands)
        for refusal in self.supervisor.refusals:
            self._tell_news(Cause("refused", refusal))
        self.supervisor.refusals.clear()
        if decision.stop is not None:
            self._tell_news(decision.stop)
        self._must_cut |= decision.must_cut
        if decision.must_wake and not self._greetings:
            self._greet(now)

    def _tell_news(self, cause: Cause) -> None:
        self._count += 1
        self._news.append(Numbered(self._count, cause))

    # --- what is told ---

    def _guarded(self, act: Callable[[float], object], now: float) -> None:
        """Do something with the port, which may be gone."""
        try:
            act(now)
        except NotAvailable:
            self._must_cut = False
            self._greetings.clear()
            self.supervisor.trip(LOST_PORT)
            self._decide(now, self._report, ())

    def _tell(self, now: float) -> None:
        if self._must_cut:
            self.port.discard()
            self._must_cut = not self._write(self.protocol.emergency_stop, now)
        elif self._greetings:
            self._go_on_greeting(now)
        else:
            self._is_opening = False
            self._tell_velocity(now)
            self._write(self.protocol.poll(now), now)
            self._greet_if_silent(now)

    def _go_on_greeting(self, now: float) -> None:
        if now >= self._greet_at:
            greeting = self._greetings.popleft()
            if greeting.rts is not None:
                self.port.set_rts(greeting.rts)
            self._write(greeting.data, now)
            self._greet_at = self._greeted_at = now + greeting.pause

    def _greet_if_silent(self, now: float) -> None:
        heard_at = -math.inf if self._report is None else self._report.time
        if now - max(heard_at, self._greeted_at) > SILENCE:
            self._is_opening = True
            self._greet(now, self.protocol.waking())

    def _tell_velocity(self, now: float) -> None:
        twist, since = self._decision.twist, now - self._told_at
        if twist == self._told and since < REFRESH:
            return
        if twist != REST and since < self.protocol.period:
            return
        protocol = self.protocol
        told = protocol.stop if twist == REST else protocol.velocity(twist)
        if self._write(protocol.resync + told, now):
            self._told, self._told_at = twist, now

    def _write(self, data: bytes, now: float) -> bool:
        """Whether it is on the way; a line that takes no more is a reason to stand."""
        if not data or self.port.write(data, now):
            return True
        self._must_cut = True
        self.supervisor.trip(JAMMED)
        self._decide(now, self._report, ())
        return False


def _is_fresh(echo: float, now: float) -> bool:
    """Whether a person's deed is of now."""
    return 0 <= now - echo <= DEED_FRESH
