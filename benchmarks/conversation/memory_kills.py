"""The memory of people under kills: `python -m benchmarks.conversation.memory_kills --tries 200`.

Half of the tries kill a robot that is told one fact after another, at any of its system calls. Then
the file must open, and have all facts but at most the last one told. The other half kill
`hri forget` at work, and let it try again: then no file may have a byte of who was forgotten.
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
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.interruption import run_interrupted
from benchmarks.progress import progress
from hri.bench.figures import machine
from hri.conversation.memory import Memory
from hri.conversation.memory_file import Contents, change, keep, people_file, recall, without
from hri.conversation.memory_keeper import LATENCY, MemoryKeeper
from hri.conversation.relations import Relation
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus

TRIES = 200
SEED = 2003
FACTS = 6
"""Facts that a robot is told before it ends."""
NOW = datetime(2026, 5, 4, 9, 30)
RELATIONS = {"likes": Relation("likes", "You like {value}.", several=True)}
FORGOTTEN = ("Quillobrand", "klezmer")
"""A name and a value that nothing else has."""


def live(path: Path, told: mmap.mmap) -> None:
    """A robot that is told facts by someone who is known; `told` counts them without a call."""
    clock = FakeClock()
    keeper = MemoryKeeper(path, RELATIONS, clock, EventBus(clock))
    (anna,) = keeper.memory.named("Ann")
    for number in range(FACTS):
        keeper.memory.learn(anna.id, "likes", f"thing {number}", NOW)
        told[0] = number + 1
        for _ in range(2):  # begin to write, and take over what was written
            keeper.poll(clock.now())
            clock.advance(2 * LATENCY)
        keeper.poll(clock.now())


def forget(path: Path) -> None:
    """What `hri forget` does with the file."""
    change(path, partial(without, name=FORGOTTEN[0]))


def prepare(path: Path) -> None:
    """Two people in a new folder, one of whom is to be forgotten."""
    shutil.rmtree(path.parent, ignore_errors=True)
    memory = Memory(RELATIONS)
    for name in ("Ann", FORGOTTEN[0]):
        memory.allow(memory.introduce(name, NOW).id, NOW, "word")
    memory.learn(2, "likes", FORGOTTEN[1], NOW)
    keep(path, Contents(memory.remembered, memory.last_id))


def measure(tries: int, folder: Path) -> dict[str, Any]:
    """Kill robots and forgetters, in a folder of state for that alone.

    Raises HriError where processes cannot be traced.
    """
    os.environ["XDG_STATE_HOME"] = str(folder)
    path, chance = people_file(), random.Random(SEED)
    told = mmap.mmap(-1, 1)
    prepare(path)
    stops = run_interrupted(partial(live, path, told)), run_interrupted(partial(forget, path))
    lost: Counter[str] = Counter()
    left: Counter[str] = Counter()
    for number in progress(range(tries), tries, "kills"):
        prepare(path)
        told[0] = 0
        at = chance.randint(1, stops[number % 2])
        if number % 2 == 0:
            run_interrupted(partial(live, path, told), at)
            lost[_lost(path, told[0])] += 1
        else:
            run_interrupted(partial(forget, path), at)
            left[_left(path)] += 1
    return {
        "tries": tries,
        "facts_lost": dict(sorted(lost.items())),
        "left_after_forgetting": dict(sorted(left.items())),
        "system_calls": [number // 2 for number in stops],
        "is_safe": set(lost) <= {"0", "1"} and set(left) == {"nothing"},
        "machine": machine(),
    }


def _lost(path: Path, told: int) -> str:
    """How many of the facts are lost, or why none could be counted."""
    try:
        kept = recall(path)
    except HriError:
        return "does not open"
    if kept is None or 1 not in kept.people:
        return "everything"
    values = kept.people[1].values("likes")
    if list(values) != [f"thing {number}" for number in range(len(values))]:
        return "not in order"
    return str(told - len(values))


def _left(path: Path) -> str:
    """What is left of who was forgotten after a second try."""
    try:
        recall(path)
    except HriError:
        return "does not open"
    run_interrupted(partial(forget, path))
    data = b"".join(file.read_bytes() for file in path.parent.iterdir()).lower()
    found = [word for word in FORGOTTEN if word.lower().encode() in data]
    return " and ".join(found) or "nothing"


def main() -> None:
    """Raises SystemExit with 1 when a kill did harm."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.conversation.memory_kills", description=__doc__
    )
    parser.add_argument("--tries", type=int, default=TRIES, metavar="N", help=f"kills; {TRIES}")
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
