"""What is left of a file whose writer is interrupted: killed at any system call, or out of room.

Each try interrupts the writer of a new edition of a file that is there, or not there yet. Then the
old or the new edition must be there, whole; and the same writer, left alone, must bring the new one
and leave nothing else behind.
"""

from __future__ import annotations

import os
import random
import resource
import shutil
import tempfile
from collections import Counter
from collections.abc import Callable, Mapping
from functools import partial
from itertools import cycle, islice
from pathlib import Path
from typing import Any

from benchmarks.interruption import run_interrupted
from benchmarks.progress import progress
from benchmarks.writers import FOLDERS, WRITERS, Writer, content
from hri.bench.figures import machine
from hri.core.errors import HriError

TRIES, QUICK = 500, 56
"""Tries of each kind of interruption, over all writers."""
LAST = 70
"""Stops at system calls of a writer that has its new content ready."""
SEED = 2003
"""Seed of the calls at which writers are killed, and of the room that is left."""
Content = dict[str, bytes]


class Site:
    """A folder with the file of one writer, and how its editions look."""

    def __init__(self, folder: Path, name: str, writer: Writer) -> None:
        self.path = folder / name
        self.path.parent.mkdir(parents=True)
        self._writer = writer
        self.stops = 0
        """At system calls, that the writer makes when it is left alone."""
        self.editions = [self._edition(number) for number in range(2)]
        self._beside = self._names()

    def _edition(self, number: int) -> Content:
        self._clear()
        self.stops = run_interrupted(partial(self._writer, self.path, number))
        made = content(self.path)
        if not made:
            raise HriError(f"{self.path.name}: its writer writes nothing - fix the writer")
        return made

    def _clear(self) -> None:
        if self.path.is_dir():
            shutil.rmtree(self.path)
        self.path.unlink(missing_ok=True)

    def _names(self) -> set[str]:
        return set(os.listdir(self.path.parent))

    def interrupt(self, run: Callable[[Callable[[], object]], object], is_there: bool) -> str:
        """What is left when `run` runs the writer of the new edition: "old", "new" or "half".

        "litter" is what a writer that is left alone does not clean up.
        """
        self._clear()
        if is_there:
            run_interrupted(partial(self._writer, self.path, 0))
        old = content(self.path)
        run(partial(self._writer, self.path, 1))
        left = content(self.path)
        if left not in (old, self.editions[1]):
            return "half"
        if self.path.is_file():
            run_interrupted(partial(self._writer, self.path, 1))
            if content(self.path) != self.editions[1] or self._names() != self._beside:
                return "litter"
        return "old" if left == old else "new"


def measure(quick: bool = False) -> dict[str, Any]:
    """Interrupt every writer. Raises HriError where processes cannot be traced."""
    tries, chance = QUICK if quick else TRIES, random.Random(SEED)
    with tempfile.TemporaryDirectory() as folder:
        sites = {
            name: Site(Path(folder, str(number)), name, writer)
            for number, (name, writer) in enumerate({**WRITERS, **FOLDERS}.items())
        }
        return {
            "tries": tries,
            "killed": _tried(sites, tries, "killed", partial(_killed, chance)),
            "full_disk": _tried(sites, tries, "full disk", partial(_out_of_room, chance)),
            "stops": {name: site.stops for name, site in sites.items()},
            "machine": machine(),
        }


def _tried(
    sites: Mapping[str, Site], tries: int, what: str, left: Callable[[Site, bool], str]
) -> dict[str, Any]:
    """How often each thing was left, and which writers left what must not be left."""
    counts = Counter(old=0, new=0, half=0, litter=0)
    faults = []
    order = islice(cycle(sites.items()), tries)
    for number, (name, site) in enumerate(progress(order, tries, what)):
        found = left(site, name in WRITERS and number % 3 > 0)
        counts[found] += 1
        if found in ("half", "litter"):
            faults.append(f"{name}: {found}")
    return {**counts, "faults": faults}


def _killed(chance: random.Random, site: Site, is_there: bool) -> str:
    # Every other time among the last calls, which are those of the writing itself.
    calls = site.stops if chance.random() < 0.5 else min(site.stops, LAST)
    at = site.stops - chance.randrange(calls)
    return site.interrupt(lambda write: run_interrupted(write, at), is_there)


def _out_of_room(chance: random.Random, site: Site, is_there: bool) -> str:
    largest = max(map(len, site.editions[1].values()))
    room = chance.randint(0, largest - 1)
    return site.interrupt(lambda write: run_interrupted(partial(_within, room, write)), is_there)


def _within(room: int, write: Callable[[], object]) -> None:
    """Write while files cannot grow beyond a number of bytes; for a process that ends
    afterwards.
    """
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
    write()
