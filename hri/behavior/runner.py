"""Runs a network at its rate: deadlines are absolute, so the mean rate never drifts.

The order of a tick, once and in words: all outputs are emptied; the behaviors run in dependency
order, so sensors come before what uses them; the time each one took is kept. A tick that ends
after its deadline is a missed interval: it is counted, reported with the slowest behavior's name,
and the deadlines that have passed are skipped, never run in a burst.

A behavior that raises an exception rests for a second, sending nothing, and is tried again; the
others go on. What depends on it sees empty inputs, which for a drive means: stand still.
"""

from __future__ import annotations

import logging
import math
import time
from collections import deque
from dataclasses import dataclass, field

from hri.behavior.behavior import Behavior, Context
from hri.behavior.network import Network

log = logging.getLogger("hri.behavior")

BETWEEN_REPORTS = 5.0
"""Seconds between two reports of missed intervals."""
REST = 1.0
"""Seconds that a behavior rests after an exception."""


@dataclass
class Statistics:
    """How a network has been doing; times in seconds."""

    ticks: int = 0
    missed: int = 0
    slowest: str = ""
    """The behavior that took longest in the last missed interval."""
    failures: int = 0
    """Exceptions that behaviors have raised."""
    recent: deque[float] = field(default_factory=lambda: deque(maxlen=1000))
    """How long the last ticks took."""


class Runner:
    """One network on one clock."""

    def __init__(self, network: Network, context: Context) -> None:
        self.network = network
        self.context = context
        self.statistics = Statistics()
        self._outputs = [
            getattr(behavior, name) for behavior in network.behaviors for name in behavior.outputs
        ]
        self._order = list(network.behaviors)
        self._resting: dict[Behavior, float] = {}
        self._failed: set[Behavior] = set()
        self._last: float | None = None
        self._started: list[Behavior] = []

    def start(self) -> None:
        """Start all behaviors; when one cannot, those before it are stopped again."""
        try:
            for behavior in self.network.behaviors:
                behavior.start(self.context)
                self._started.append(behavior)
        except BaseException:
            self.stop()
            raise

    def stop(self) -> None:
        """Stop the behaviors, last first; a second call does nothing."""
        while self._started:
            self._started.pop().stop()

    def tick(self, now: float) -> float:
        """One cycle; returns how long it took in seconds and notes the slowest behavior."""
        dt = 0.0 if self._last is None else now - self._last
        self._last = now
        for output in self._outputs:
            output.value = None
        if self._resting:
            self._wake(now)
        begun = before = time.perf_counter()
        longest = 0.0
        for behavior in self._order:
            try:
                behavior.compute(now, dt)
            except Exception as error:
                self._rest(behavior, now, error)
            after = time.perf_counter()
            if after - before > longest:
                longest, self._slowest = after - before, behavior.id
            before = after
        self.statistics.ticks += 1
        self.statistics.recent.append(before - begun)
        return before - begun

    async def run(self, count: int | None = None, duration: float | None = None) -> None:
        """Tick until cancelled, `count` times, or for `duration` seconds."""
        clock, interval = self.context.clock, self.network.interval
        begin = deadline = clock.now()
        while count is None or self.statistics.ticks < count:
            if duration is not None and deadline - begin > duration - interval / 2:
                break
            await clock.sleep_until(deadline)
            self.tick(deadline if clock.is_fake else clock.now())
            deadline += interval
            if (late := clock.now() - deadline) > 0:
                skipped = int(late / interval) + 1
                deadline += skipped * interval
                self._report_missed(skipped)

    def _rest(self, behavior: Behavior, now: float, error: Exception) -> None:
        """Leave a behavior that failed out for a while."""
        self.statistics.failures += 1
        self._resting[behavior] = now + REST
        # A new list, since the tick still walks over the old one.
        self._order = [kept for kept in self._order if kept is not behavior]
        name = f"{self.network.name}.{behavior.id}"
        # The first time with all that helps to mend it, then in a line.
        is_new = behavior not in self._failed
        self._failed.add(behavior)
        log.error("%s failed: %s", name, error, exc_info=error if is_new else None)
        self.context.events.raise_event("behavior.failed", behavior=name, error=str(error))

    def _wake(self, now: float) -> None:
        """Take those back that have rested, at their place in the order."""
        rested = [behavior for behavior, until in self._resting.items() if until <= now]
        for behavior in rested:
            del self._resting[behavior]
        if rested:
            self._order = [b for b in self.network.behaviors if b not in self._resting]

    def _report_missed(self, skipped: int) -> None:
        """Count what was missed; tell of it at once, but not more often than a person can read."""
        self.statistics.missed += skipped
        self.statistics.slowest = self._slowest
        now = self.context.clock.now()
        if now >= self._tell_after:
            self._tell_after = now + BETWEEN_REPORTS
            log.warning(
                "Missed desired interval.... (%s: %d so far, slowest was %s)",
                self.network.name,
                self.statistics.missed,
                self._slowest,
            )

    _tell_after = -math.inf
    _slowest = ""
