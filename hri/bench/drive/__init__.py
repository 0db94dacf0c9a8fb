"""Driving: how soon a base stops, faults it survives, rooms it gets through, and odometry."""

from __future__ import annotations

import os
from typing import Any

from hri.bench.drive import rooms, steering, stopping, wheels, world
from hri.bench.table import Parts, measured

PARTS: Parts = {
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
    return measured("drive", PARTS, quick, only)
