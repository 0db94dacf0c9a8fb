"""Visits to a robot that remembers the ones before: whether its replies become a routine."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from datetime import datetime, timedelta
from tempfile import TemporaryDirectory

from benchmarks.conversation.playing import DEVICES, EVERY, play
from benchmarks.conversation.talks import Talk, joined
from benchmarks.conversation.transcript import Line
from hri.bench.workers import variables
from hri.core.clock import FakeClock
from hri.emotion.persistence import memory_file
from hri.robot import Robot

SEED = 5
SECONDS = 300.0
"""That a visit lasts."""
APART = timedelta(hours=7)
"""From the beginning of one visit to that of the next."""


class LaterClock(FakeClock):
    """A fake clock of a later day."""

    def __init__(self, later: timedelta) -> None:
        super().__init__()
        self._later = later

    def wall(self) -> datetime:
        return super().wall() + self._later


def drawn(talks: Sequence[Talk], count: int, seed: int = SEED) -> list[Talk]:
    """Visits, each of enough different talks, drawn by the seed."""
    chance = random.Random(seed)
    return [_visit(number, chance.sample(talks, len(talks))) for number in range(1, count + 1)]


def _visit(number: int, talks: Sequence[Talk]) -> Talk:
    return Talk(f"visits/{number}", "visits", "", joined(talks)[: int(SECONDS / EVERY) + 1])


def lived(visits: Sequence[Talk]) -> Iterator[list[Line]]:
    """Play the visits one after the other; what the robot keeps of one is there in the next."""
    with TemporaryDirectory() as folder, variables(XDG_STATE_HOME=folder):
        for number, visit in enumerate(visits):
            robot = Robot(
                "companion",
                "simulated",
                clock=LaterClock(number * APART),
                seed=number + 1,
                devices=DEVICES,
                parameters={"emotion": {"memory": str(memory_file())}},
            )
            yield play(visit, robot, SECONDS)
