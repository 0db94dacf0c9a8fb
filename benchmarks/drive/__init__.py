"""Driving: faults that a base survives, rooms that it gets through, and odometry."""

from __future__ import annotations

import os

from benchmarks import faults
from benchmarks.drive import rooms, wheels
from hri.bench.table import Parts

PARTS: Parts = {
    "faults": faults.rows,
    "odometry": lambda quick: wheels.rows(),
    "rooms": lambda quick: rooms.rows(quick, max(1, os.cpu_count() or 1)),
}
"""What `hri bench drive` measures in a checkout beside its own; rooms take a process a core."""
