"""How soon a base stops when any program ends; see `hri.bench.stops` and `broken_links`."""

from __future__ import annotations

import os
from collections.abc import Iterator

from hri.bench import broken_links as links, stops
from hri.bench.table import Row, amount, at_most

TRIES, QUICK_TRIES = 100, 10
HAZARD_MS, PROGRAM_MS = 15.0, 250.0
CHAIN_TRIES, QUICK_CHAIN_TRIES = 20, 1
CHAIN_MS = 250.0
BUSY = 2
"""Busy processes for each core."""


def rows(quick: bool) -> Iterator[Row]:
    """Real processes and an emulated base behind a pseudo-terminal."""
    tries = QUICK_TRIES if quick else TRIES
    figures = stops.figures(tries)
    hazard, program = figures["hazard_to_zero_ms"], figures["program_to_zero_ms"]
    what = "hazard input to zero velocity on the port, p99"
    yield amount(what, hazard.pop("p99"), "ms", at_most(HAZARD_MS), tries=tries, **hazard)
    what = "program killed or frozen at 0.3 m/s to zero velocity on the port, max"
    yield amount(what, program.pop("max"), "ms", at_most(PROGRAM_MS), tries=tries, **program)


def chain(quick: bool) -> Iterator[Row]:
    """Each combination of program, supervisor and watchdog killed or frozen with one alive."""
    tries = QUICK_CHAIN_TRIES if quick else CHAIN_TRIES
    for busy in (0, BUSY * (os.cpu_count() or 1)):
        figures = links.figures(tries, busy)
        worst = figures["all"].pop("max")
        what = "links of the chain killed or frozen at 0.3 m/s to zero velocity on the port, max"
        if busy:
            what += f", beside {busy} busy processes"
        yield amount(what, worst, "ms", at_most(CHAIN_MS), **figures.pop("all"), **figures)
