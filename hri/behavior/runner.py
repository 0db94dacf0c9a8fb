"""Runs a network at its rate: deadlines are absolute, so the mean rate never drifts.

The order of a tick, once and in words: all outputs are emptied; what was injected takes its place
as links; the behaviors run, sensors first and then in dependency order, and what rests on the word
of someone outside carries the time of that word on, also when a behavior kept it from an earlier
tick; the time each one took is kept; watchers of outputs get the sent values. A tick that
ends after its deadline is a missed interval: it is counted, reported with what took longest, and
the deadlines that have passed are skipped, never run in a burst.

In real time the tick of a faster network that is due does not wait for the end of a slower one's:
it runs between two behaviors of the slower one. So it is late by a behavior, not by a network.

A paused network computes nothing. What steers a drive or writes to the board sees empty inputs in
each tick. A single step computes all but those: nothing leaves it. While any network is paused, no
other moves a drive either: it might lack the word that would have slowed it down.

A behavior that raises an exception rests for a second, sending nothing, and is tried again; the
others go on. What depends on it sees empty inputs, which for a drive means: stand still.
"""

from __future__ import annotations

import logging
import math
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from time import perf_counter
from typing import Any

from hri.behavior.behavior import Behavior, Context, Running
from hri.behavior.board import BoardSink
from hri.behavior.library.sharing import Share
from hri.behavior.network import Network
from hri.behavior.ports import InputPort, OutputPort
from hri.behavior.tick_statistics import Statistics, Timing
from hri.core.errors import AuthoringError, HriError
from hri.hal.resource import Resource

log = logging.getLogger("hri.behavior")

_WRITERS = (BoardSink, Share)
"""What gives values to other networks."""
BETWEEN_REPORTS = 5.0
"""Seconds between two reports of missed intervals."""
REST = 1.0
"""Seconds that a behavior rests after an exception."""


@dataclass(eq=False, slots=True)
class Watch:
    """A watcher of an output; `cancel()` ends it, a second call is harmless."""

    port: OutputPort[Any]
    callback: Callable[[Any, float], object]
    watches: list[Watch]
    has_failed: bool = False

    def cancel(self) -> None:
        if self in self.watches:
            self.watches.remove(self)


class Runner:
    """One network on one clock."""

    def __init__(self, network: Network, context: Context) -> None:
        self.network = network
        self.context = context
        timings = {behavior.id: Timing() for behavior in network.behaviors}
        self.statistics = Statistics(timings)
        self._outputs = [
            behavior.output_port(name)
            for behavior in network.behaviors
            for name in behavior.outputs
        ]
        self._carriers = {behavior: _Carrier(behavior) for behavior in _carriers(network)}
        self._order = self._ran = self._timed(network.behaviors)
        self._injected: deque[tuple[InputPort[Any], OutputPort[Any]]] = deque()
        self._watches: list[Watch] = []
        self._resting: dict[Behavior, float] = {}
        self._failed: set[Behavior] = set()
        self._last: float | None = None
        self.after_tick: list[Callable[[float], object]] = []
        """Called with the time after each tick that computed."""
        self.is_paused = False
        self.paused_by = ""
        """At which breakpoint it paused; empty when someone asked for it."""
        self._steps = 0
        self._acting = [b for b in network.behaviors if b.steers or isinstance(b, _WRITERS)]
        self._started: list[Behavior] = []
        self._is_ticking = False
        self._ends_after_tick = False
        self._begin, self._slot = 0.0, 0
        self._due = math.inf
        """When the next tick is due, while others may run it in between; never for a few ticks."""

    def start(self) -> None:
        """Start all behaviors; when one cannot, those before it are stopped again."""
        self.context.runners.append(self)
        try:
            for behavior in self.network.behaviors:
                self._start(behavior)
                self._started.append(behavior)
        except BaseException:
            self.stop()
            raise

    def _start(self, behavior: Behavior) -> None:
        try:
            behavior.start(self.context)
        except AuthoringError:
            raise  # says where itself
        except HriError as error:
            raise type(error)(f"{self._name_of(behavior)}: {error}") from error

    def stop(self) -> None:
        """Stop the behaviors, last first; a second call does nothing.

        One that raises an exception keeps none of the others from being stopped. Called from inside
        a tick, the tick ends first.
        """
        if self._is_ticking:
            self._ends_after_tick = True
            return
        self._due = math.inf
        if self in self.context.runners:
            self.context.runners.remove(self)
        self.context.paused.discard(self.network.name)
        while self._started:
            behavior = self._started.pop()
            try:
                behavior.stop()
            except Exception as error:
                log.error("%s did not stop: %s", self._name_of(behavior), error, exc_info=error)

    def pause(self, because: str = "", port: str = "", value: str = "") -> None:
        """Compute no more until `resume`; raises the event `network.paused`.

        `because` and the others say at which breakpoint, at what value of which port.
        """
        if self.is_paused:
            self.paused_by = because or self.paused_by  # at the end of a single step
            return
        self.is_paused, self.paused_by, self._steps = True, because, 0
        self.context.paused.add(self.network.name)
        self._raise("network.paused", because=because, port=port, value=value)

    def resume(self) -> None:
        """Go on; raises the event `network.resumed`."""
        if self.is_paused:
            self.is_paused, self.paused_by = False, ""
            self.context.paused.discard(self.network.name)
            self._raise("network.resumed")

    def step(self) -> None:
        """Compute one tick of a paused network, when it is due next. Raises HriError if it runs."""
        if not self.is_paused:
            raise HriError(f"{self.network.name} runs - pause it before a single tick")
        self.paused_by = ""
        self._steps += 1

    def _raise(self, event: str, **properties: str) -> None:
        self.context.events.raise_event(event, network=self.network.name, **properties)

    @contextmanager
    def lending_drives(self) -> Iterator[None]:
        """Let another network claim the drives that this one steers; if the body fails, it has them
        again, else it may only be stopped.
        """
        resources = self.context.resources
        steering = [(one, one.steers[0]) for one in self._started if one.steers is not None]
        # Held meanwhile, so that no drive is closed and opened again.
        held = [resources.obtain(drive, Resource) for _, drive in steering]
        try:
            for behavior, _ in steering:
                behavior.stop()
                self._started.remove(behavior)
            try:
                yield
            except BaseException:
                for behavior, _ in steering:
                    self._start(behavior)
                    self._started.append(behavior)
                raise
        finally:
            for drive in held:
                resources.release(drive)

    def inject(self, behavior: str, input: str, value: Any) -> None:
        """Send a value to an input, once, as an additional first link, at the next tick.

        Several values arrive as several links, in the order they were injected. May be called from
        any thread. Raises HriError for a behavior or an input that is not there, or a value of
        another type.
        """
        target = self.network[behavior]
        declared = target.input_named(input)
        try:
            source: OutputPort[Any] = OutputPort(declared.check(value))
        except ValueError as error:
            raise HriError(f"{behavior}.{input}: {error}") from error
        self._injected.append((target.input_port(input), source))

    def watch(self, behavior: str, output: str, callback: Callable[[Any, float], object]) -> Watch:
        """Call `callback(value, now)` after each tick in which the output sent something.

        Raises HriError for a behavior or an output that is not there.
        """
        source = self.network[behavior]
        source.output_named(output)
        watch = Watch(source.output_port(output), callback, self._watches)
        self._watches.append(watch)
        return watch

    @property
    def resting(self) -> list[str]:
        """The ids of behaviors that have failed, and are not tried again yet."""
        return [behavior.id for behavior in self._resting]

    @property
    def is_watched(self) -> bool:
        return bool(self._watches)

    @property
    def last_tick(self) -> float:
        """When it ticked last, seconds; 0 before the first tick."""
        return self._last or 0.0

    @property
    def watched(self) -> tuple[OutputPort[Any], ...]:
        """The outputs that someone watches."""
        return tuple(watch.port for watch in self._watches)

    def tick(self, now: float) -> float:
        """One cycle; returns how long it took in seconds."""
        dt = 0.0 if self._last is None else now - self._last
        self._last = now
        try:
            if self.is_paused and not self._steps:
                self._stand_still(now, dt)
                return 0.0
            took = self._cycle(now, dt)
            self._steps = max(0, self._steps - 1)
            if self._watches:
                self._tell_watches(now)
            for follower in tuple(self.after_tick):
                follower(now)
        finally:
            # Also when a behavior was interrupted, by Ctrl-C or the end of the loop.
            if self._ends_after_tick:
                self.stop()
        return took

    def _stand_still(self, now: float, dt: float) -> None:
        """Let what acts on the outside see that nothing was sent."""
        self._empty_outputs()
        for behavior in self._acting:
            try:
                behavior.compute(now, dt)
            except Exception as error:
                self._rest(behavior, now, error)

    def _empty_outputs(self) -> None:
        for output in self._outputs:
            output.value = None

    def _cycle(self, now: float, dt: float) -> float:
        """Let the behaviors compute; returns how long that took."""
        self._empty_outputs()
        if self._resting:
            self._wake(now)
        injected = self._insert_injected() if self._injected else ()
        self._ran = self._order
        if self.is_paused:
            self._ran = [one for one in self._order if one[0] not in self._acting]
        self._is_ticking = True
        faster = self._faster()
        begun = before = perf_counter()
        try:
            for behavior, timing, carrier in self._ran:
                try:
                    behavior.compute(now, dt)
                except Exception as error:
                    self._rest(behavior, now, error)
                if carrier is not None:
                    carrier.carry()
                after = perf_counter()
                # Written out, instead of `timing.add`: this is the inner loop of it all.
                timing.last = spent = after - before
                timing.count += 1
                timing.total += spent
                if spent > timing.longest:
                    timing.longest = spent
                before = after
                if faster:
                    for runner in faster:
                        runner.tick_if_due()
                    before = perf_counter()
                    begun += before - after
        finally:
            self._is_ticking = False
            for port, source in injected:
                port.sources.remove(source)
        self.statistics.ticks += 1
        self.statistics.recent.append(before - begun)
        return before - begun

    async def run(self, count: int | None = None, duration: float | None = None) -> None:
        """Tick until cancelled, `count` times, or for `duration` seconds."""
        clock, interval = self.context.clock, self.network.interval
        is_endless = count is None and duration is None
        self._begin, self._slot = clock.now(), 0
        while count is None or self.statistics.ticks < count:
            if duration is not None and (self._slot + 0.5) * interval > duration:
                break
            deadline = self._deadline()
            if is_endless and not clock.is_fake:
                self._due = deadline
            await clock.sleep_until(deadline)
            if deadline == self._deadline():  # else it ran amid a slower network
                self._tick_due()

    def _tick_due(self) -> None:
        """The tick that is due; those whose time is over after it are missed."""
        clock, deadline = self.context.clock, self._deadline()
        began = clock.now()
        now = deadline if clock.is_fake else began
        self.statistics.lateness.add(now - deadline)
        took = self.tick(now)
        log.debug("%s tick at %.3f s took %.1f us", self.network.name, now, took * 1e6)
        self._slot += 1
        ended = clock.now()
        if (late := ended - self._deadline()) > 0:
            skipped = int(late / self.network.interval) + 1
            self._slot += skipped
            began_late = began - deadline > ended - began
            self._report_missed(skipped, deadline if began_late else None)
        if self._due < math.inf:
            self._due = self._deadline()

    def _deadline(self) -> float:
        # From the beginning each time: sums of intervals would drift.
        return self._begin + self._slot * self.network.interval

    def _faster(self) -> list[Running]:
        """The networks that may run between two behaviors of this one, should they be due."""
        interval = self.network.interval
        runners = self.context.runners
        return [one for one in runners if one.network.interval < interval and one.may_interleave]

    @property
    def may_interleave(self) -> bool:
        """Whether it may be run in between: it ticks in real time, and without an end."""
        return self._due < math.inf and not self._is_ticking

    def tick_if_due(self) -> None:
        """Called between two behaviors of a slower network: the tick, if it is due."""
        if self._due <= self.context.clock.now() and self.may_interleave:
            self._tick_due()

    def _timed(self, behaviors: list[Behavior]) -> list[tuple[Behavior, Timing, _Carrier | None]]:
        """With each its timing, and its carrier where a relay's word may reach it."""
        timings = self.statistics.behaviors
        return [(one, timings[one.id], self._carriers.get(one)) for one in behaviors]

    def _name_of(self, behavior: Behavior) -> str:
        return f"{self.network.name}.{behavior.id}"

    def _insert_injected(self) -> list[tuple[InputPort[Any], OutputPort[Any]]]:
        """Make a link of each value that waits, ahead of the links of the network."""
        inserted = []
        counts: dict[int, int] = {}
        while self._injected:
            port, source = self._injected.popleft()
            at = counts.get(id(port), 0)
            port.sources.insert(at, source)
            counts[id(port)] = at + 1
            inserted.append((port, source))
        return inserted

    def _tell_watches(self, now: float) -> None:
        for watch in tuple(self._watches):
            if watch.port.value is not None:
                try:
                    watch.callback(watch.port.value, now)
                except Exception as error:
                    if not watch.has_failed:
                        what = "a watch on %s failed, logged once: %s"
                        log.error(what, self.network.name, error, exc_info=error)
                    watch.has_failed = True

    def _rest(self, behavior: Behavior, now: float, error: Exception) -> None:
        """Leave a behavior that failed out for a while."""
        self.statistics.failures += 1
        self._resting[behavior] = now + REST
        # A new list, since the tick still walks over the old one.
        self._order = [kept for kept in self._order if kept[0] is not behavior]
        name = self._name_of(behavior)
        # The first time with all that helps to fix it, then in a line.
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
            awake = [b for b in self.network.behaviors if b not in self._resting]
            self._order = self._timed(awake)

    def _report_missed(self, skipped: int, waited_since: float | None) -> None:
        """Count what was missed; report it at once, but not more often than a person can read.

        `waited_since`: the deadline of a tick that began late; None for one that took too long.
        """
        self.statistics.missed += skipped
        self.statistics.slowest, cause, what = "", "something else held the loop up", ""
        if waited_since is not None and self.context.held_up_at >= waited_since:
            what = self.context.held_up_by
            cause = f"{what} held the loop up"
        elif waited_since is None and self._ran:
            behavior, timing, _ = max(self._ran, key=lambda ran: ran[1].last)
            timing.missed += 1
            self.statistics.slowest, cause = behavior.id, f"slowest was {behavior.id}"
            what = behavior.id
        self.statistics.causes[what] += skipped
        now = self.context.clock.now()
        if now >= self._tell_after:
            self._tell_after = now + BETWEEN_REPORTS
            log.warning(
                "Missed desired interval.... (%s: %d so far, %s)",
                self.network.name,
                self.statistics.missed,
                cause,
            )

    _tell_after = -math.inf


def _carriers(network: Network) -> set[Behavior]:
    """The behaviors that a relay's word reaches, other than relays, which say their own times."""
    reached = {behavior for behavior in network.behaviors if behavior.is_relay}
    for behavior in network.behaviors:  # in dependency order
        if any(link.source in reached for link in network.links if link.target is behavior):
            reached.add(behavior)
    return {behavior for behavior in reached if not behavior.is_relay}


class _Carrier:
    """Gives what a behavior sends the time of the oldest word that it rests on."""

    def __init__(self, behavior: Behavior) -> None:
        self._inputs = [behavior.input_port(name) for name in behavior.inputs]
        self._outputs = [behavior.output_port(name) for name in behavior.outputs]
        self._keeps = behavior.keeps_inputs
        self._words: dict[InputPort[Any], float] = {}
        """By input, the oldest word among the values that came last."""

    def carry(self) -> None:
        """Called after the behavior computed."""
        for port in self._inputs:
            sent = [source for source in port.sources if source.value is not None]
            if sent or not self._keeps:
                self._words.pop(port, None)
                if words := [one.spoken for one in sent if one.spoken is not None]:
                    self._words[port] = min(words)
        if self._words:
            oldest = min(self._words.values())
            for output in self._outputs:
                output.spoken = oldest
