"""Timers under kills: `python -m benchmarks.conversation.timer_kills --tries 50`.

A robot with timers and alarms is killed at any of its system calls and started again, until all
have been said, while the clock on the wall is set back or forth by an hour now and then. Each must
be said to its end, and none a second time as if it were new.
"""

from __future__ import annotations

import argparse
import json
import mmap
import os
import random
import shutil
import tempfile
from collections import Counter
from dataclasses import dataclass
from datetime import timedelta
from functools import partial
from pathlib import Path
from typing import Any

import trio

from benchmarks.interruption import run_interrupted
from benchmarks.progress import progress
from hri.bench.figures import machine
from hri.conversation.alarm_file import alarm_file
from hri.conversation.alarm_keeper import AlarmKeeper
from hri.conversation.alarms import AlarmKind
from hri.core.clock import FakeClock, Uptime
from hri.core.errors import HriError
from hri.core.event_bus import EventBus

TRIES = 50
SEED = 2003
TIMERS = 4
LONGEST = 30.0
"""Seconds that a timer runs."""
SPEECH = 1.5
"""Seconds that it takes to say one."""
RUN = 20.0
"""Seconds of a run."""
MOST_RUNS = 12
JUMP = 3600.0


@dataclass
class Home:
    """What outlasts a kill: the time, and what a person has heard of each timer."""

    heard: mmap.mmap
    """At twice the id of a timer: how often it was said to its end as new; then how often again.
    A write to it is not a system call."""
    uptime: float = 0.0
    offset: float = 0.0
    """Seconds that the wall clock was set forth."""


class HomeClock(FakeClock):
    """Goes on from where the last robot was killed."""

    def __init__(self, home: Home) -> None:
        super().__init__()
        self._home = home

    def wall(self) -> Any:
        seconds = self._home.uptime + self._home.offset
        return super().wall() + timedelta(seconds=seconds)

    def uptime(self) -> Uptime:
        return Uptime(self._home.uptime + self.now(), "one boot")


def live(path: Path, home: Home, jump: float) -> None:
    """A robot until it has said all, or its time is over; the clock is set in the midst."""
    clock = HomeClock(home)

    async def job() -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(clock.drive)
            await _say_all(AlarmKeeper(path, clock, EventBus(clock)), clock, home, jump)
            nursery.cancel_scope.cancel()

    trio.run(job)


async def _say_all(keeper: AlarmKeeper, clock: HomeClock, home: Home, jump: float) -> None:
    if keeper.alarms.last_id == 0:
        for number in range(TIMERS):
            wall, length = keeper.instant().wall, LONGEST * (number + 1) / TIMERS
            keeper.alarms.add(AlarmKind.TIMER, wall + length, f"number {number}", length)
        await keeper.kept()
    while clock.now() < RUN:
        if jump and clock.now() > RUN / 2:
            home.offset, jump = home.offset + jump, 0.0
        keeper.poll()
        for alarm in keeper.alarms.due(keeper.instant(), AlarmKind.TIMER):
            is_new = await keeper.begin(alarm)
            await clock.sleep(SPEECH)
            home.heard[2 * alarm.id + (0 if is_new else 1)] += 1
            await keeper.end(alarm)
        await clock.sleep(0.2)


def measure(tries: int, folder: Path) -> dict[str, Any]:
    """Kill robots, in a folder of state for that alone. Raises HriError where processes cannot be
    traced.
    """
    os.environ["XDG_STATE_HOME"] = str(folder)
    path, chance = alarm_file(), random.Random(SEED)
    found: Counter[str] = Counter()
    kills = late = 0
    for _ in progress(range(tries), tries, "kills"):
        shutil.rmtree(path.parent, ignore_errors=True)
        home = Home(mmap.mmap(-1, 2 * TIMERS + 2))
        for number in range(MOST_RUNS):
            jump = chance.choice((0.0, JUMP, -JUMP))
            run = partial(live, path, home, jump)
            at = chance.randint(1, 600) if number < MOST_RUNS - 4 else None
            run_interrupted(run, at)
            kills += at is not None
            home.uptime += RUN
            home.offset += jump
        for id in range(1, TIMERS + 1):
            as_new, again = home.heard[2 * id], home.heard[2 * id + 1]
            found["lost" if as_new + again == 0 else "doubled" if as_new > 1 else "said"] += 1
            late += again
    return {
        "timers": tries * TIMERS,
        "kills": kills,
        **{key: found[key] for key in ("said", "lost", "doubled")},
        "said_once_more_with_a_notice": late,
        "is_safe": not found["lost"] and not found["doubled"],
        "machine": machine(),
    }


def main() -> None:
    """Raises SystemExit with 1 when a timer was lost or doubled."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.conversation.timer_kills", description=__doc__
    )
    parser.add_argument("--tries", type=int, default=TRIES, metavar="N", help=f"homes; {TRIES}")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        try:
            found = measure(options.tries, Path(folder))
        except HriError as error:
            raise SystemExit(str(error)) from error
    print(json.dumps(found, indent=1))
    raise SystemExit(not found["is_safe"])


if __name__ == "__main__":
    main()
