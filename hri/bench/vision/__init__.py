"""Seeing people, motion and colors: what it costs."""

from __future__ import annotations

from typing import Any

from hri.bench.table import Parts, measured
from hri.bench.vision import motion_and_color, picture_cost

PARTS: Parts = {
    "the chain on one core": picture_cost.rows,
    "motion and color": motion_and_color.rows,
}
"""The parts of the bench; those of `benchmarks.vision` follow."""


def measure(quick: bool = False, only: str | None = None) -> dict[str, Any]:
    """The rows of all parts, or of one, `quick` in a tenth of the time; see `measured`."""
    return measured("vision", PARTS, quick, only)
