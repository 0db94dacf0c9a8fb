"""Driving: how soon a base stops, faults it survives, rooms it gets through, and odometry."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

from hri.bench.drive import rooms, steering, stopping, wheels, world
from hri.bench.table import Row, attempted, report


def measure(quick: bool = False) -> dict[str, Any]:
    """All rows; what is being done is told on standard error. `quick` takes a tenth of the time."""
    told = list(rows(quick, max(1, os.cpu_count() or 1)))
    return report("drive", told, quick)


def rows(quick: bool, workers: int) -> Iterator[Row]:
    """All rows in the order of the table; rooms are driven through in so many processes."""
    yield from attempted("stops", lambda: stopping.rows(quick))
    yield from attempted("steering", lambda: steering.rows(quick))
    yield from attempted("faults", stopping.faults)
    yield from attempted("odometry", wheels.rows)
    yield from attempted("simulated world", lambda: world.rows(quick))
    yield from attempted("rooms", lambda: rooms.rows(quick, workers))
