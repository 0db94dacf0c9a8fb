"""What people should know of a base, as events and in the log."""

from __future__ import annotations

import logging
import math

from hri.behavior.behavior import Context
from hri.core.event_bus import EventBus
from hri.core.origin import caused_by
from hri.core.signals import Twist
from hri.drive.supervisor.base_bus import BaseBus
from hri.drive.supervisor.cause import DONE, Cause
from hri.drive.supervisor.link import State
from hri.hal.motion import REST
from hri.hal.rank import WRITERS

INTERVAL = 0.5
"""Seconds between two reports of what the base is commanded."""
NOTABLE = Twist(0.1, 0.3)
"""Changes of a command that are worth a report, m/s and rad/s."""

log = logging.getLogger("hri.drive")


def announced(bus: BaseBus, context: Context) -> Announcer:
    """The announcer of a base, the same for all who want it; each of them stops it once."""
    announcer = context.resources.shared(
        Announcer, (bus.id,), lambda: Announcer(bus, context.events)
    )
    announcer.start()
    return announcer


class Announcer:
    """Raises an event, and writes a line to the log, for each thing that people should know.

    `drive.commanded` (linear, angular) twice a second at most, `drive.stopped` (reason, and words
    unless someone asked it to stop), `drive.refused` (words) for a command that made no sense,
    `drive.faulty` (words) for a sensor that cannot be believed.
    """

    def __init__(self, bus: BaseBus, events: EventBus) -> None:
        self.origin = ""
        """Who causes the motion; see `hri.core.origin`."""
        self.because = ""
        """Why a program lets the base rest, where that is not what it was asked for."""
        self._bus, self._events = bus, events
        self._users = 0
        self._told = 0
        self._faulty = frozenset[str]()
        self._reported, self._time = REST, -math.inf

    def start(self) -> None:
        """Watch the base; each call wants a `stop`."""
        self._users += 1
        if self._users == 1:
            # A base that was opened again counts its news from the beginning.
            self._told, self._faulty, self._reported = 0, frozenset(), REST
            self._bus.watch(self._hear)

    def stop(self) -> None:
        """Watch it no more, when the last one says so."""
        self._users -= 1
        if self._users == 0:
            self._bus.unwatch(self._hear)

    def _hear(self, state: State) -> None:
        self._report_command(state)
        for news in state.news:
            if news.number > self._told:
                self._told = news.number
                self._report(news.cause, state)
        for words in sorted(frozenset(state.faults) - self._faulty):
            log.warning("%s: %s", self._bus.id, words)
            self._events.raise_event("drive.faulty", words=words)
        self._faulty = frozenset(state.faults)

    def _report_command(self, state: State) -> None:
        target = state.target
        if target == REST or state.level not in WRITERS or not self._is_news(target, state.time):
            return
        self._reported, self._time = target, state.time
        with caused_by(self.origin):
            self._events.raise_event(
                "drive.commanded", linear=_rounded(target.linear), angular=_rounded(target.angular)
            )

    def _is_news(self, target: Twist, now: float) -> bool:
        if self._reported == REST:
            return True
        linear = abs(target.linear - self._reported.linear)
        angular = abs(target.angular - self._reported.angular)
        has_changed = linear >= NOTABLE.linear or angular >= NOTABLE.angular
        return has_changed and now - self._time >= INTERVAL

    def _report(self, cause: Cause, state: State) -> None:
        if cause.name == "refused":
            log.warning("%s: refused: %s", self._bus.id, cause.because)
            self._events.raise_event("drive.refused", words=cause.because)
        elif cause != DONE:
            log.info("%s: %s", self._bus.id, cause.words)
            self._reported = REST
            self._events.raise_event("drive.stopped", reason=cause.name, words=cause.words)
        elif self._reported != REST and state.target == REST:
            self._reported = REST
            self._events.raise_event("drive.stopped", reason=self.because or cause.name)


def _rounded(value: float) -> float:
    """To four places, never minus zero."""
    return round(value, 4) + 0.0
