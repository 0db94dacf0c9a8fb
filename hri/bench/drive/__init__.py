"""Driving: how soon a base stops, faults it survives, rooms it gets through, and odometry."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from hri.bench.drive import rooms, steering, stopping, wheels, world
from hri.bench.table import Row, attempted, report
from hri.core.errors import HriError, did_you_mean

PARTS: Mapping[str, Callable[[bool], Iterator[Row]]] = {
    "stops": stopping.rows,
    "chain": stopping.chain,
    "steering": steering.rows,
    "faults": stopping.faults,
    "odometry": lambda quick: wheels.rows(),
    "simulated world": world.rows,
    "rooms": lambda quick: rooms.rows(quick, max(1, os.cpu_count() or 1)),
}
"""The parts of the bench in the order of the table; rooms use a process for each core."""


def measure(quick: bool = False, only: str | None = None) -> dict[str, Any]:
    """The rows of all parts, or of one of PARTS; progress is written to standard error.

    `quick` takes a tenth of the time. Raises HriError for an unknown part.
    """
    if only is not None and only not in PARTS:
        raise HriError(f'bench drive has no part "{only}" - {did_you_mean(only, PARTS)}')
    chosen = PARTS if only is None else {only: PARTS[only]}
    told = [row for name, rows in chosen.items() for row in attempted(name, _begun(rows, quick))]
    return report("drive", told, quick)


def _begun(rows: Callable[[bool], Iterator[Row]], quick: bool) -> Callable[[], Iterator[Row]]:
    return lambda: rows(quick)
