"""The companion for simulated hours: the visitor of its demo comes again and again.

Each visit must go like any other: every line said is heard or refused, and what begins to be said
ends. Memory is that of the whole process, as the system sees it, since the engines keep most of it
where Python does not look.
"""

from __future__ import annotations

import gc
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import psutil

from hri.core.clock import FakeClock
from hri.core.signals import Event
from hri.robot import Job, Robot
from hri.simulation.visit_script import load_visit
from hri.simulation.world import SimulatedWorld
from hri.task.context import TaskContext

BETWEEN = 10.0
"""Seconds from the end of a visit to the next one."""
WARM_UP = 0.25
"""Share of the visits after which memory must not grow."""
MOST_GROWTH = 20.0
"""MB; caches of phrases and frames fill slowly."""
FAILURES = ("behavior.failed", "task.failed", "vision.failed", "emotions.refused", "face.refused")
"""Events that never happen while all is well."""


@dataclass
class Verdict:
    """What came out."""

    hours: float
    visits: int = 0
    events: int = 0
    lines: int = 0
    """What visitors said."""
    answered: int = 0
    """What was heard or refused of it."""
    growth: float = 0.0
    """MB more than after the warm-up."""
    faults: list[str] = field(default_factory=list)
    """A sentence for each thing that went wrong; none when all is well."""


class CompanionSoak:
    """One run on the simulated robot; it repeats, but for its memory."""

    def __init__(self, hours: float, tell: Callable[[str], object]) -> None:
        self.verdict = Verdict(hours)
        self._tell = tell
        self.robot = Robot(config="simulated", clock=FakeClock(), notice=tell)
        self._visit = load_visit(self.robot.app.folder / "demo.toml")
        self._count = max(1, round(hours * 3600 / (self._visit.duration + BETWEEN)))
        self._settled = 0.0

    def run(self, *jobs: Job) -> Verdict:
        """Live through it all, with further tasks beside it."""
        try:
            self.robot.live_until_over(*self.robot.app.load_tasks(), self._receive, *jobs)
        finally:
            self.robot.close()
        return self.verdict

    async def _receive(self, context: TaskContext) -> None:
        """Let one visitor in after the other."""
        for number in range(self._count):
            self._judge(number, await self._visited(context))
            memory = _memory()
            if number <= self._count * WARM_UP:
                self._settled = memory
            self.verdict.growth = memory - self._settled
            self._tell(
                f"visit {number + 1} of {self._count}: {self.verdict.events} events,"
                f" {self.verdict.growth:+.1f} MB"
            )
        if self.verdict.growth > MOST_GROWTH:
            self.verdict.faults.append(f"memory grew by {self.verdict.growth:.1f} MB")
        self.robot.finish()

    async def _visited(self, context: TaskContext) -> Counter[str]:
        """One visit: how often each event came."""
        counts: Counter[str] = Counter()

        def count(event: Event) -> None:
            counts[event.name] += 1
            if event.name == "visitor.acted":
                counts[f"visitor {event.properties['deed']}"] += 1

        world = self.robot.resources.obtain("world", SimulatedWorld)
        subscription = context.events.subscribe("*", count)
        visit = self._visit.start(world, context.clock, context.events)
        await context.clock.sleep(self._visit.duration + BETWEEN)
        visit.cancel()
        subscription.cancel()
        self.robot.resources.release(world)
        return counts

    def _judge(self, number: int, counts: Counter[str]) -> None:
        verdict, faults = self.verdict, self.verdict.faults
        said, answered = counts["visitor say"], counts["speech.heard"] + counts["speech.rejected"]
        verdict.visits += 1
        verdict.events += counts.total()
        verdict.lines += said
        verdict.answered += answered
        if answered < said:
            faults.append(f"visit {number + 1}: {said - answered} of {said} lines were lost")
        begun, ended = counts["speech.said"], counts["speech.finished"]
        if begun != ended:
            faults.append(f"visit {number + 1}: {begun} sentences began, {ended} ended")
        faults += [f"visit {number + 1}: {name}" for name in FAILURES if counts[name]]


def _memory() -> float:
    """MB of this process."""
    gc.collect()
    return float(psutil.Process().memory_info().rss) / 1e6
