"""Rooms in which people look at nothing: touches by cause, and whether trips arrive in time.

Fifty seeded rooms with three sensors, once without and once with a camera that sees people. Each
touch of the moving robot has a cause (`hri.simulation.collisions`): who walked, whether a sensor
covered the person in the last half second, and on which side.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from benchmarks.drive.rooms import QUICK_ROOMS, ROOMS, Case, driven
from hri.bench.table import Row, amount, at_least, at_most, report
from hri.simulation.collisions import Collision
from hri.simulation.navigation_trips import Trip

LONGER = 1.5
"""Times as long as before that trips may take at most."""


@dataclass(frozen=True)
class Before:
    """Figures of the 50 rooms before the robot heeded people who come to it."""

    reached: float
    """Share of the trips that arrived."""
    seconds: float
    """Median of the time of those."""


CASES = (
    (Case(heedful=False), Before(43 / 50, 34.9)),
    (Case(heedful=False, sees=True), Before(42 / 50, 48.7)),
)


def measure(quick: bool = False) -> dict[str, Any]:
    """All rows; rooms run in one process for each core. `quick` takes a tenth of the rooms."""
    count, workers = QUICK_ROOMS if quick else ROOMS, max(1, os.cpu_count() or 1)
    rows = [
        row
        for (case, trips), (_, before) in zip(
            driven([case for case, _ in CASES], count, workers), CASES, strict=True
        )
        for row in told(case.name, trips, before)
    ]
    return report("people", rows, quick)


def told(name: str, trips: Sequence[Trip], before: Before) -> Iterator[Row]:
    """The rows of one case."""
    collisions = [collision for trip in trips for collision in trip.collisions]
    covered = [c for c in collisions if c.is_moving and c.covered_by]
    what = f"{name}: collisions of the moving robot with someone a sensor covered"
    yield amount(
        what,
        len(covered),
        "collisions",
        at_most(0),
        longest_warning_s=round(max((c.warning for c in covered), default=0.0), 2),
        each=[_told(trip.seed, c) for trip in trips for c in trip.collisions if c in covered],
    )
    others = Counter(collision.cause for collision in collisions if collision not in covered)
    what, causes = f"{name}: all other collisions, by cause", dict(sorted(others.items()))
    yield amount(what, sum(others.values()), "collisions", None, causes=causes)
    times = [trip.time for trip in trips if trip.is_there]
    yield amount(
        f"{name}: trips that arrive",
        len(times) / len(trips),
        "share",
        at_least(before.reached),
        not_there=[trip.seed for trip in trips if not trip.is_there],
    )
    yield amount(
        f"{name}: time of those, median",
        float(np.median(times)) if times else 180.0,
        "s",
        at_most(LONGER * before.seconds),
        before=before.seconds,
        p95=round(float(np.percentile(times, 95)), 1) if times else None,
        max=round(max(times), 1) if times else None,
    )


def _told(seed: int, collision: Collision) -> dict[str, Any]:
    return {
        "room": seed,
        "at_s": round(collision.time, 2),
        "cause": collision.cause,
        "sensors": list(collision.covered_by),
        "warning_s": round(collision.warning, 2),
        "robot_m_s": round(collision.robot_speed, 3),
        "person_m_s": round(collision.person_speed, 2),
    }
