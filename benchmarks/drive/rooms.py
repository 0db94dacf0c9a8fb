"""Fifty seeded rooms with furniture and people who walk about, for each policy and robot."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from benchmarks.progress import progress
from hri.bench.table import Row, amount, at_least, at_most, share
from hri.bench.workers import worker_pool
from hri.simulation.navigation_trips import Journey, Trip
from hri.simulation.seeded_rooms import furnished

ROOMS, QUICK_ROOMS = 50, 5
CLEAN = 0.95
"""Share of the rooms in which the goal is reached without a collision."""


@dataclass(frozen=True)
class Case:
    """One way to drive through the rooms."""

    policy: str = "full"
    robot: str = "three sensors"
    heedful: bool = True
    """People look where they go."""
    sees: bool = False
    """The robot has a camera that sees people, too."""

    @property
    def name(self) -> str:
        others = (
            ("people seen as well", self.sees),
            ("people who look at nothing", not self.heedful),
        )
        return ", ".join([self.policy, self.robot, *(words for words, holds in others if holds)])


CASES = (
    Case(),
    Case(robot="nine sensors"),
    Case(sees=True),
    Case(heedful=False),
    Case(heedful=False, sees=True),
    Case("StopCrash only"),
    Case("none"),
)
"""The first has limits."""


def rows(quick: bool, workers: int) -> Iterator[Row]:
    """Success, time, collisions and the closest distance to a person, for each case."""
    count = QUICK_ROOMS if quick else ROOMS
    for number, (case, trips) in enumerate(driven(CASES, count, workers)):
        yield from told(case.name, trips, is_limited=number == 0)


def driven(
    cases: Sequence[Case], count: int, workers: int
) -> Iterator[tuple[Case, Sequence[Trip]]]:
    """The trips through the first `count` rooms for each case, in a number of processes."""
    with worker_pool(workers) as pool:
        for case in cases:
            drive = partial(through, case=case)
            yield case, list(progress(pool.map(drive, range(count)), count, case.name))


def through(seed: int, case: Case) -> Trip:
    """The trip through the room of a seed."""
    room = furnished(seed)
    return Journey(room, case.policy, case.robot, heedful=case.heedful, sees=case.sees).run()


def told(name: str, trips: Sequence[Trip], is_limited: bool) -> Iterator[Row]:
    """The rows of one case."""
    clean = sum(trip.is_clean for trip in trips)
    way = sum(trip.way for trip in trips)
    hits = sum(trip.hits for trip in trips)
    times = [trip.time for trip in trips if trip.is_there]
    row = share(
        f"{name}: goal reached without collision",
        clean,
        len(trips),
        at_least(CLEAN) if is_limited else None,
    )
    yield row | {
        "reached": sum(trip.is_there for trip in trips),
        "seconds_median": round(float(np.median(times)), 1) if times else None,
        "way_m": round(way, 1),
        "collisions": hits,
        "collisions_per_100_m": round(100 * hits / way, 2) if way else None,
        "closest_to_a_person_m": round(min(trip.person_gap for trip in trips), 3),
        "closest_while_it_moved_m": round(min(trip.person_gap_moving for trip in trips), 3),
        "closest_it_drove_on_to_somebody_seen_m": _finite(
            min(trip.person_gap_approached for trip in trips)
        ),
        "met_by_people_while_it_stood": sum(trip.people_met for trip in trips),
        "not_clean": [trip.seed for trip in trips if not trip.is_clean],
    }
    what = f"{name}: collisions with people while it moved"
    count = sum(trip.people_hit for trip in trips)
    yield amount(what, count, "collisions", at_most(0) if is_limited else None)


def _finite(value: float) -> float | None:
    return round(value, 3) if math.isfinite(value) else None
