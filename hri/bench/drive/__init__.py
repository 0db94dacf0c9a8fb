"""Driving: how soon a base stops, and how fast the simulated world runs."""

from __future__ import annotations

from typing import Any

from hri.bench.drive import leaving, simulated_world, steering, stopping
from hri.bench.table import Parts, measured

PARTS: Parts = {
    "stops": stopping.rows,
    "chain": stopping.chain,
    "leaving": leaving.rows,
    "steering": steering.rows,
    "simulated world": simulated_world.rows,
}
"""The parts of the bench in the order of the table; those of `benchmarks.drive` follow."""


def measure(quick: bool = False, only: str | None = None) -> dict[str, Any]:
    """The rows of all parts, or of one, `quick` in a tenth of the time; see `measured`."""
    return measured("drive", PARTS, quick, only)
